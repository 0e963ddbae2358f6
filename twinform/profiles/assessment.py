"""`assess`: what consumers make of a file, by what is found in it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum

from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, rules
from twinform.ir import Format
from twinform.profiles.counterparts import Counterparts
from twinform.profiles.detectors import DETECTORS
from twinform.profiles.profile import Effect, Profile, ProfileRow
from twinform.profiles.reading import Shortfall, read_as
from twinform.profiles.subject import ProfiledFile

_SHORTFALLS = {
    "value": rules.UNREAD_VALUE,
    "absent": rules.UNWRITTEN_PART,
    "unread": rules.UNREAD_PART,
    "tree": rules.UNTAKEN_TREE,
    "text": rules.UNREAD_TEXT,
}
"""The rules about what a consumer's table of reads demands, by the kind of shortfall."""


class ConsumerVerdict(StrEnum):
    """Whether a consumer takes a file."""

    ACCEPTS = "accepts"
    WARNS = "warns"
    REFUSES = "refuses"


@dataclass(frozen=True, slots=True)
class Judgment:
    """A finding, and the row about it."""

    row: ProfileRow
    finding: Diagnostic


@dataclass(frozen=True, slots=True)
class Assessment:
    """What one consumer makes of a file. `reads` is whether it reads files of this format at all."""

    profile: Profile
    reads: bool
    judgments: tuple[Judgment, ...] = ()

    @property
    def verdict(self) -> ConsumerVerdict:
        """Whether the consumer takes the file."""
        effects = {each.row.effect for each in self.judgments}
        if not self.reads or Effect.REFUSES in effects:
            return ConsumerVerdict.REFUSES
        return ConsumerVerdict.WARNS if Effect.WARNS in effects else ConsumerVerdict.ACCEPTS

    def by(self, effect: Effect) -> tuple[Judgment, ...]:
        """The judgments with this effect."""
        return tuple(each for each in self.judgments if each.row.effect is effect)


def assess(subject: ProfiledFile, profiles: Iterable[Profile]) -> tuple[Assessment, ...]:
    """What each consumer makes of a file; what detectors find is looked for once."""
    wanted = tuple(profiles)
    # Rows name rules instead of checking by themselves: classes with checks of their own would
    # report one number five times for five consumers, and their findings could not be suppressed or
    # go into a baseline.
    found = (*subject.diagnostics, *detected(subject, {row.rule for each in wanted for row in each.rows}))
    shortfalls = Shortfalls(subject)
    return tuple(_assessed(subject, each, found, shortfalls) for each in wanted)


def detected(subject: ProfiledFile, rules: Iterable[str]) -> list[Diagnostic]:
    """What the detectors of these rules find."""
    sink, wanted = DiagnosticSink(subject.path), frozenset(rules)
    for detector in DETECTORS:
        if wanted.intersection(rule.name for rule in detector.rules):
            detector.find(subject, sink)
    return [each for each in sink.diagnostics if each.rule.name in wanted]


def _assessed(
    subject: ProfiledFile, profile: Profile, found: tuple[Diagnostic, ...], shortfalls: "Shortfalls"
) -> Assessment:
    if subject.format is not None and subject.format not in profile.formats:
        return Assessment(profile, reads=False)
    judgments = (*_judgments(profile, found, subject.format), *shortfalls.of(profile))
    return Assessment(profile, reads=True, judgments=judgments)


def _judgments(profile: Profile, found: Iterable[Diagnostic], format_: Format | None) -> Iterator[Judgment]:
    """The first row that minds a finding is the one about it."""
    for finding in found:
        row = next((row for row in profile.rows if row.minds(finding, format_)), None)
        if row is not None:
            yield Judgment(row, finding)


class Shortfalls:
    """What consumers cannot read of a text, by their tables: one finding for the same thing of all of them."""

    def __init__(self, subject: ProfiledFile) -> None:
        self._subject = subject
        self._findings: dict[tuple[str, str, int], Diagnostic] = {}
        self._known = Counterparts(subject.diagnostics)

    def of(self, profile: Profile) -> Iterator[Judgment]:
        """What one of them cannot read."""
        # Tables of reads are about the text of URDF. An engine of Gazebo sees SDF only, made by
        # libsdformat or by us, and has rows instead; `reads/gazebo.reads` says what libsdformat
        # makes of URDF.
        if not profile.reads or self._subject.content is None or self._subject.format is Format.SDF:
            return
        for each in read_as(profile.reads, self._subject.content, self._subject.has_file):
            finding = self._finding(each)
            words = {"rule": finding.rule.name, "effect": each.effect, "about": each.about, "pass": each.pipeline}
            yield Judgment(ProfileRow.model_validate(words), finding)

    def _finding(self, each: Shortfall) -> Diagnostic:
        rule = _SHORTFALLS[each.kind]
        key = (rule.name, each.message, each.line)
        if key not in self._findings:
            place = Location(self._subject.path, each.line, each.path or "/")
            new = Diagnostic(rule, each.message, place, rule.severity, each.found, each.expected)
            self._findings[key] = self._known.of(each) or new
        return self._findings[key]
