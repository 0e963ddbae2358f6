"""`assess`: what consumers make of a file, by what is found in it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum

from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.ir import Document, Format
from twinform.passes import NO_ASSETS, Assets
from twinform.profiles.detectors import DETECTORS
from twinform.profiles.profile import Effect, Profile, Row
from twinform.schemas import XmlElement


class Verdict(StrEnum):
    """Whether a consumer takes a file."""

    ACCEPTS = "accepts"
    WARNS = "warns"
    REFUSES = "refuses"


@dataclass(frozen=True, slots=True)
class Subject:
    """A file before consumers: its bytes, tree and document as far as it has them, and what `check` finds in it."""

    path: str
    format: Format | None
    document: Document | None = None
    tree: XmlElement | None = None
    content: bytes | None = field(default=None, repr=False)
    diagnostics: tuple[Diagnostic, ...] = ()
    assets: Assets = field(default=NO_ASSETS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Judgment:
    """A finding, and the row about it."""

    row: Row
    finding: Diagnostic


@dataclass(frozen=True, slots=True)
class Assessment:
    """What one consumer makes of a file. `reads` is whether it reads files of this format at all."""

    profile: Profile
    reads: bool
    judgments: tuple[Judgment, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """Whether the consumer takes the file."""
        effects = {each.row.effect for each in self.judgments}
        if not self.reads or Effect.REFUSES in effects:
            return Verdict.REFUSES
        return Verdict.WARNS if Effect.WARNS in effects else Verdict.ACCEPTS

    def by(self, effect: Effect) -> tuple[Judgment, ...]:
        """The judgments with this effect."""
        return tuple(each for each in self.judgments if each.row.effect is effect)


def assess(subject: Subject, profiles: Iterable[Profile]) -> tuple[Assessment, ...]:
    """What each consumer makes of a file; what detectors find is looked for once."""
    wanted = tuple(profiles)
    found = (*subject.diagnostics, *detected(subject, {row.rule for each in wanted for row in each.rows}))
    return tuple(_assessed(subject, each, found) for each in wanted)


def detected(subject: Subject, rules: Iterable[str]) -> list[Diagnostic]:
    """What the detectors of these rules find."""
    sink, wanted = DiagnosticSink(subject.path), frozenset(rules)
    for detector in DETECTORS:
        if wanted.intersection(rule.name for rule in detector.rules):
            detector.find(subject, sink)
    return [each for each in sink.diagnostics if each.rule.name in wanted]


def _assessed(subject: Subject, profile: Profile, found: tuple[Diagnostic, ...]) -> Assessment:
    reads = subject.format is None or subject.format in profile.formats
    return Assessment(profile, reads, tuple(_judgments(profile, found, subject.format)) if reads else ())


def _judgments(profile: Profile, found: Iterable[Diagnostic], format_: Format | None) -> Iterator[Judgment]:
    """The first row that minds a finding is the one about it."""
    for finding in found:
        row = next((row for row in profile.rows if row.minds(finding, format_)), None)
        if row is not None:
            yield Judgment(row, finding)
