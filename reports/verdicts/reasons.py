"""Why we and the parsers of record may disagree: `known.toml`, by rule of ours and by message of theirs."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from reports.verdicts.judging import Question, Verdict
from twinform.diagnostics import Diagnostic


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """A reason before one judge and in one language, or before all and in both."""

    why: str
    judge: str = ""
    kind: str = ""

    def holds(self, question: Question) -> bool:
        """Whether it is about such documents and this judge."""
        return self.judge in {"", question.judge} and self.kind in {"", question.kind}

    @property
    def scope(self) -> str:
        """Where it holds, in words."""
        judge = self.judge or "both"
        return f"{judge}, {self.kind.upper()}" if self.kind and judge != "urdfdom" else judge


@dataclass(frozen=True, slots=True, kw_only=True)
class Ours(_Row):
    """Why a judge reads what a rule of ours refuses.

    `says` is searched in the path and the message of our finding, `remark` in what the judge writes beside.
    """

    rule: str
    says: str = ""
    remark: str = ""

    def explains(self, finding: Diagnostic, verdict: Verdict) -> bool:
        """Whether it is about this finding."""
        return (
            self.holds(verdict.question)
            and finding.rule.name == self.rule
            and bool(re.search(self.says, f"{finding.location.path} {finding.message}"))
            and (not self.remark or any(re.search(self.remark, remark) for remark in verdict.opinion.remarks))
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Theirs(_Row):
    """Why we take what a judge refuses; one of the `rules` says something of it, if there are any."""

    says: str
    rules: tuple[str, ...] = ()

    def explains(self, objection: str, verdict: Verdict) -> bool:
        """Whether it is about this objection."""
        found = {finding.rule.name for finding in verdict.findings}
        return (
            self.holds(verdict.question)
            and bool(re.search(self.says, objection))
            and (not self.rules or not found.isdisjoint(self.rules))
        )


Reason = Ours | Theirs


@dataclass(frozen=True, slots=True)
class Reasons:
    """All of them. `consequences` are objections that only follow from another one."""

    consequences: tuple[str, ...]
    ours: tuple[Ours, ...]
    theirs: tuple[Theirs, ...]

    def of(self, verdict: Verdict) -> tuple[Reason, ...]:
        """Why a judge disagrees; nothing where a part of the disagreement has no reason."""
        found = list(self._of_ours(verdict) if verdict.opinion.accepts else self._of_theirs(verdict))
        return () if None in found else tuple(dict.fromkeys(reason for reason in found if reason))

    def _of_ours(self, verdict: Verdict) -> Iterator[Reason | None]:
        for finding in verdict.findings:
            if finding.is_error:
                yield next((reason for reason in self.ours if reason.explains(finding, verdict)), None)

    def _of_theirs(self, verdict: Verdict) -> Iterator[Reason | None]:
        objections = verdict.opinion.objections
        for objection in [one for one in objections if not self._follows(one)] or objections:
            yield next((reason for reason in self.theirs if reason.explains(objection, verdict)), None)

    def _follows(self, objection: str) -> bool:
        return any(re.search(pattern, objection) for pattern in self.consequences)


@cache
def reasons() -> Reasons:
    """The tables of the file."""
    tables = tomllib.loads(Path(__file__).with_name("known.toml").read_text(encoding="utf-8"))
    ours = tuple(Ours(**row) for row in tables["ours"])
    theirs = tuple(Theirs(rules=tuple(row.pop("rules", ())), **row) for row in tables["theirs"])
    return Reasons(tuple(tables["consequences"]), ours, theirs)
