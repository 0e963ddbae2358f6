"""Why we and the parsers of record may disagree: `known.toml`, by rule of ours and by message of theirs."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NotRequired, TypedDict, cast

from reports.verdicts.judging import Judge, Question, Verdict
from tests.corpus.files import Kind
from twinform.diagnostics import Diagnostic

_FILE = Path(__file__).with_name("known.toml")


class _Row(TypedDict):
    judge: NotRequired[str]
    kind: NotRequired[str]
    why: str


class _OursRow(_Row):
    rule: str
    says: NotRequired[str]
    remark: NotRequired[str]


class _TheirsRow(_Row):
    says: str
    rules: NotRequired[list[str]]


class _Tables(TypedDict):
    consequences: list[str]
    ours: list[_OursRow]
    theirs: list[_TheirsRow]


@dataclass(frozen=True, slots=True)
class Scope:
    """Before which judge a reason holds, and in which language; None is both."""

    judge: Judge | None
    kind: Kind | None

    def __contains__(self, question: Question) -> bool:
        return self.judge in {None, question.judge} and self.kind in {None, question.kind}

    def __str__(self) -> str:
        judge = str(self.judge or "both")
        return f"{judge}, {self.kind.upper()}" if self.kind and self.judge is not Judge.URDFDOM else judge


@dataclass(frozen=True, slots=True)
class Ours:
    """Why a judge reads what a rule of ours refuses.

    `says` is searched in the path and the message of our finding, `remark` in what the judge writes beside.
    """

    scope: Scope
    rule: str
    says: str
    remark: str
    why: str

    def explains(self, finding: Diagnostic, verdict: Verdict) -> bool:
        """Whether it is about this finding."""
        return (
            verdict.question in self.scope
            and finding.rule.name == self.rule
            and bool(re.search(self.says, f"{finding.location.path} {finding.message}"))
            and (not self.remark or any(re.search(self.remark, remark) for remark in verdict.opinion.remarks))
        )


@dataclass(frozen=True, slots=True)
class Theirs:
    """Why we take what a judge refuses; one of the `rules` says something of it, if there are any."""

    scope: Scope
    says: str
    rules: tuple[str, ...]
    why: str

    def explains(self, objection: str, verdict: Verdict) -> bool:
        """Whether it is about this objection."""
        found = {finding.rule.name for finding in verdict.findings}
        return (
            verdict.question in self.scope
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
    tables = cast("_Tables", tomllib.loads(_FILE.read_text(encoding="utf-8")))
    ours = (
        Ours(_scope(row), row["rule"], row.get("says", ""), row.get("remark", ""), row["why"]) for row in tables["ours"]
    )
    theirs = (Theirs(_scope(row), row["says"], tuple(row.get("rules", ())), row["why"]) for row in tables["theirs"])
    return Reasons(tuple(tables["consequences"]), tuple(ours), tuple(theirs))


def _scope(row: _Row) -> Scope:
    return Scope(Judge(row["judge"]) if "judge" in row else None, Kind(row["kind"]) if "kind" in row else None)
