"""Why we and the parsers of record may disagree: `verdicts.toml`, by rule of ours and by message of theirs."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

from testbed.mutated.verdicts import Verdict

_TABLES = tomllib.loads(Path(__file__).with_name("verdicts.toml").read_text(encoding="utf-8"))
_CONSEQUENCES = re.compile("|".join(f"(?:{pattern})" for pattern in _TABLES["consequences"]))
"""Objections that only follow from another one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reason:
    """A reason before one judge, or those that fit a pattern, and in one language, or before all and in both.

    Of ours, `rule` is the one that refuses, `text` is searched in the path and the message of the finding, `remark` in
    the judge's other remarks. Of theirs, `text` is searched in the objection. If there are any `rules`, one of them has
    a finding about the file.
    """

    why: str
    judge: str = ""
    kind: str = ""
    rule: str = ""
    text: str = ""
    remark: str = ""
    rules: tuple[str, ...] = ()

    @property
    def scope(self) -> str:
        """Where it holds, as text."""
        judge = self.judge.rstrip("*") or "both"
        return f"{judge}, {self.kind.upper()}" if self.kind and judge != "urdfdom" else judge

    def explains(self, verdict: Verdict, message: str, rule: str = "") -> bool:
        """Whether it is about a message of a rule of ours or of the judge."""
        return (
            fnmatch(verdict.question.judge, self.judge or "*")
            and self.kind in {"", verdict.question.kind}
            and self.rule == rule
            and bool(re.search(self.text, message))
            and (not self.remark or any(re.search(self.remark, remark) for remark in verdict.opinion.remarks))
            and (not self.rules or any(finding.rule.name in self.rules for finding in verdict.findings))
        )


def _reasons(table: str) -> list[Reason]:
    return [Reason(rules=tuple(row.pop("rules", ())), **row) for row in _TABLES[table]]


OURS = _reasons("ours")
"""Why a judge reads what a rule of ours refuses."""
THEIRS = _reasons("theirs")
"""Why we take what a judge refuses."""


def reasons(verdict: Verdict) -> tuple[Reason, ...]:
    """Why a judge disagrees; nothing where it does not, or where a part of the disagreement has no reason."""
    if verdict.accepted == verdict.opinion.accepts:
        return ()
    among = OURS if verdict.opinion.accepts else THEIRS
    found = [next((one for one in among if one.explains(verdict, *dispute)), None) for dispute in _disputed(verdict)]
    return () if None in found else tuple(dict.fromkeys(reason for reason in found if reason))


def _disputed(verdict: Verdict) -> Iterator[tuple[str, str]]:
    """The objections of either to the file, and the rule if it is one of ours."""
    if verdict.opinion.accepts:
        errors = (finding for finding in verdict.findings if finding.is_error)
        yield from ((f"{one.location.path} {one.message}", one.rule.name) for one in errors)
    else:
        objections = verdict.opinion.objections
        own = [one for one in objections if not _CONSEQUENCES.search(one)]
        yield from ((one, "") for one in own or objections)
