"""`assess`: what consumers make of a file, judged by the findings about it, and `findings`: that as diagnostics."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from enum import StrEnum

from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, Severity, rules
from twinform.ir import Format
from twinform.profiles.detectors import DETECTORS, ProfiledFile
from twinform.profiles.features import shown_by
from twinform.profiles.profile import Effect, Profile, ProfileRow
from twinform.profiles.walking import Shortfall, read_as

_SHORTFALLS = {
    "value": rules.UNREAD_VALUE,
    "absent": rules.UNWRITTEN_PART,
    "unread": rules.UNREAD_PART,
    "tree": rules.UNTAKEN_TREE,
    "text": rules.UNREAD_TEXT,
}
"""The rules for demands of a consumer's table that are not met, by the kind of shortfall."""
_SEVERITIES = {
    Effect.REFUSES: Severity.ERROR,
    Effect.DROPS: Severity.WARNING,
    Effect.MISREADS: Severity.WARNING,
    Effect.WARNS: Severity.INFO,
}
_PLURALS = {Effect.REFUSES: "refuse", Effect.DROPS: "drop", Effect.MISREADS: "misread", Effect.WARNS: "warn"}
_ONCE = ("duplicate-name",)
_BODY = ("impossible-inertia", "indefinite-inertia", "non-positive-mass")
_WEIGHTLESS = ("missing-inertial", "non-positive-mass", "weightless-mover")
_LOOP = ("kinematic-loop", "two-parents", "no-links")
_MATERIAL = ("unknown-material", "bare-material", "unnamed-material", "conflicting-material")
# A consumer's table is about the text, and `check` about the model: both find a link that is there
# twice. Reported as the finding of `check`, it stands at the piece that is wrong, has its fixes,
# and a comment that allows it counts.
RULES_OF_FACTS: Mapping[str, tuple[str, ...]] = {
    "repeated-link": _ONCE,
    "repeated-link-but-world": _ONCE,
    "repeated-joint": _ONCE,
    "repeated-material": (*_ONCE, "conflicting-material"),
    "repeated-moving-joint": _ONCE,
    "repeated-shape": _ONCE,
    "repeated-collision": _ONCE,
    "reserved-name": ("reserved-name",),
    "shared-name": ("shared-name",),
    "empty-name": ("empty-name",),
    "self-joint": ("self-joint",),
    "unknown-leader": ("unknown-leader",),
    "stiff-mimic": ("unknown-leader",),
    "self-mimic": ("unknown-leader",),
    "idle-mimic": ("unknown-leader",),
    "idle-leader": ("unknown-leader",),
    "unknown-parent": ("dangling-link",),
    "unknown-child": ("dangling-link",),
    "unknown-parent-but-world": ("dangling-link",),
    "unknown-child-but-world": ("dangling-link",),
    "open-joint": ("missing-element", "missing-attribute"),
    "uncolored": _MATERIAL,
    "recolored": _MATERIAL,
    "nameless-color": _MATERIAL,
    "nowhere-material": _MATERIAL,
    "undefined-material": _MATERIAL,
    "plain-material": _MATERIAL,
    "unread-numbers": ("invalid-value",),
    "unknown-number": ("invalid-value",),
    "indefinite-inertia": _BODY,
    "unbalanced-inertia": _BODY,
    "unphysical-inertia": _BODY,
    "weightless-link": _WEIGHTLESS,
    "shapes-alone": _WEIGHTLESS,
    "weightless-body": _WEIGHTLESS,
    "weightless-branch": _WEIGHTLESS,
    "nothing-left": _WEIGHTLESS,
    "endless-moment": _BODY,
    "foreign-end": ("dangling-link",),
    "loop": _LOOP,
    "unread-color": ("invalid-value",),
    "misplaced-element": ("unknown-element",),
    "strange-attribute": ("unknown-attribute",),
    "reversed-limits": ("lower-above-upper",),
    "swapped-limits": ("lower-above-upper",),
    "equal-limits": ("empty-range",),
    "foreign-transmission": ("foreign-transmission", "transmission-without-joint", "unknown-driven-joint"),
    "several-roots": ("several-roots",),
    "second-tree": ("several-roots",),
    "lone-link": ("several-roots",),
    "circular-mimic": ("unknown-leader",),
    "unlike-mimic": ("unknown-leader",),
    "no-root": _LOOP,
    "no-root-of-joints": _LOOP,
    "two-parents": _LOOP,
    "circle": _LOOP,
    "no-links": ("no-links",),
}
"""The rules of `check` that find the same mistake, by the names of facts."""
_RULES_OF_KINDS = {
    "value": frozenset({"invalid-value", "out-of-range", "tabbed-numbers", "missing-file"}),
    "absent": frozenset({"missing-attribute", "missing-element", "missing-part", "missing-limit", "missing-shape"}),
    "unread": frozenset({"unknown-attribute", "unknown-element", "repeated-element", "outside-version", "dialect"}),
}
"""The rules of `check` that find the same mistake, by the kind of shortfall."""


class ConsumerVerdict(StrEnum):
    """Whether a consumer accepts a file."""

    ACCEPTS = "accepts"
    WARNS = "warns"
    REFUSES = "refuses"


@dataclass(frozen=True, slots=True)
class Judgment:
    """A finding, and the row of the profile that is about it."""

    row: ProfileRow
    finding: Diagnostic


@dataclass(frozen=True, slots=True)
class Assessment:
    """What one consumer makes of a file; `reads` is false where it does not read files of this format at all."""

    profile: Profile
    reads: bool
    judgments: tuple[Judgment, ...] = ()

    @property
    def verdict(self) -> ConsumerVerdict:
        """Whether the consumer accepts the file."""
        effects = {each.row.effect for each in self.judgments}
        if not self.reads or Effect.REFUSES in effects:
            return ConsumerVerdict.REFUSES
        return ConsumerVerdict.WARNS if Effect.WARNS in effects else ConsumerVerdict.ACCEPTS

    def by(self, effect: Effect) -> tuple[Judgment, ...]:
        """The judgments with an effect."""
        return tuple(each for each in self.judgments if each.row.effect is effect)


def assess(subject: ProfiledFile, profiles: Iterable[Profile]) -> tuple[Assessment, ...]:
    """What each consumer makes of a file; detectors run once for all of them."""
    wanted = tuple(profiles)
    # Rows name rules instead of checking by themselves: classes with checks of their own would
    # report one number five times for five consumers, and their findings could not be suppressed or
    # go into a baseline.
    found = (*subject.diagnostics, *run_detectors(subject, {row.rule for each in wanted for row in each.rows}))
    shortfalls = Shortfalls(subject)
    return tuple(_assess_for(subject, each, found, shortfalls) for each in wanted)


def run_detectors(subject: ProfiledFile, rules: Iterable[str]) -> list[Diagnostic]:
    """The findings of the detectors for these rules."""
    sink, wanted = DiagnosticSink(subject.path), frozenset(rules)
    for detector in DETECTORS:
        if wanted.intersection(rule.name for rule in detector.rules):
            detector.find(subject, sink)
    return [each for each in sink.diagnostics if each.rule.name in wanted]


def _assess_for(
    subject: ProfiledFile, profile: Profile, found: tuple[Diagnostic, ...], shortfalls: "Shortfalls"
) -> Assessment:
    if subject.format is not None and subject.format not in profile.formats:
        return Assessment(profile, reads=False)
    if subject.format is Format.MJCF:  # rows are about what URDF and SDF say, and MuJoCo reads MJCF as it is
        return Assessment(profile, reads=True)
    judgments = (*_judge(profile, found, subject.format), *shortfalls.of(profile))
    return Assessment(profile, reads=True, judgments=judgments)


def _judge(profile: Profile, found: Iterable[Diagnostic], format_: Format | None) -> Iterator[Judgment]:
    """Pair each finding with the first row that is about it; other findings are left out."""
    for finding in found:
        row = next((row for row in profile.rows if row.minds(finding, format_)), None)
        if row is not None:
            yield Judgment(row, finding)


class Shortfalls:
    """What consumers cannot read in a text, by their tables; consumers share the finding about one thing."""

    def __init__(self, subject: ProfiledFile) -> None:
        self._subject = subject
        self._findings: dict[tuple[str, str, int], Diagnostic] = {}
        self._known = CheckFindings(subject.diagnostics)

    def of(self, profile: Profile) -> Iterator[Judgment]:
        """The judgments about what one consumer cannot read."""
        # Tables of reads are about the text of URDF. An engine of Gazebo sees SDF only, made by
        # libsdformat or by us, and has rows instead; `reads/gazebo.reads` says what libsdformat
        # makes of URDF.
        if not profile.reads or self._subject.content is None or self._subject.format in {Format.SDF, Format.MJCF}:
            return
        for each in read_as(profile.reads, self._subject.content, self._subject.has_file):
            finding = self._merge_findings(each, profile)
            words = {"rule": finding.rule.name, "effect": each.effect, "about": each.about, "pass": each.pipeline}
            yield Judgment(ProfileRow.model_validate(words), finding)

    def _merge_findings(self, each: Shortfall, profile: Profile) -> Diagnostic:
        rule = _SHORTFALLS[each.kind]
        key = (rule.name, each.message, each.line)
        if key not in self._findings:
            place = Location(self._subject.path, each.line, each.path or "/")
            of_version = profile.release.urdf is not None and place.path.endswith("/@version")
            advice = f"twinform convert --to urdf --for {profile.consumer}" if of_version else None
            new = Diagnostic(rule, each.message, place, rule.severity, each.found, each.expected, help=advice)
            self._findings[key] = self._known.of(each) or new
        return self._findings[key]


_Minded = list[tuple[Assessment, Judgment]]


def findings(assessments: Iterable[Assessment]) -> tuple[Diagnostic, ...]:
    """One finding for each thing that consumers object to, as severe as the worst effect on any of them."""
    minded: dict[int, _Minded] = {}
    for assessment in assessments:
        for judgment in assessment.judgments:
            minded.setdefault(id(judgment.finding), []).append((assessment, judgment))
    return tuple(_merge_findings(each) for each in minded.values())


def _merge_findings(minded: _Minded) -> Diagnostic:
    finding = minded[0][1].finding
    worst = max(_SEVERITIES[judgment.row.effect] for _, judgment in minded)
    passes = dict.fromkeys(judgment.row.pipeline for _, judgment in minded if judgment.row.pipeline)
    advice = [f"--passes '{','.join(passes)}'"] if passes else [finding.help] if finding.help else []
    message = f"{finding.message}; {'; '.join(_describe_effects(minded))}"
    help_ = "\n".join([*advice, *_point_to_feature(minded)]) or None
    return replace(finding, message=message, severity=max(worst, finding.severity), help=help_)


def _point_to_feature(minded: _Minded) -> Iterator[str]:
    """The command that shows what all consumers make of the same thing, where a feature shows it."""
    rows = ((judgment.row, judgment.finding.location.path) for _, judgment in minded)
    if feature := next(filter(None, (shown_by(row.about, path, row.rule) for row, path in rows)), ""):
        yield f"`twinform explain {feature}` says who reads it"


def _describe_effects(minded: _Minded) -> Iterator[str]:
    """Clauses such as `Drake 1.51.1 and urdfdom 3.0.1 refuse: links need names of their own`, the worst first."""
    who: dict[tuple[Effect, str], dict[str, None]] = {}
    for assessment, judgment in minded:
        key = (judgment.row.effect, judgment.row.about)
        who.setdefault(key, {})[assessment.profile.label] = None
    order = list(_SEVERITIES)
    for (effect, about), labels in sorted(who.items(), key=lambda item: order.index(item[0][0])):
        *others, last = labels
        verb = _PLURALS[effect] if others else effect
        yield f"{', '.join(others)} and {last} {verb}: {about}" if others else f"{last} {verb}: {about}"


class CheckFindings:
    """The findings of `check` about a file, by their XML paths."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self._at_or_below: dict[str, list[Diagnostic]] = {}
        for each in diagnostics:
            path = each.location.path
            for end in (*(at.start() for at in re.finditer("/", path) if at.start()), len(path)):
                self._at_or_below.setdefault(path[:end], []).append(each)

    def of(self, shortfall: Shortfall) -> Diagnostic | None:
        """The finding about the same mistake, at the same path or, for a fact, below the element."""
        known = self._at_or_below.get(shortfall.path, ())
        return next((each for each in known if _is_same_mistake(each, shortfall)), None)


def _is_same_mistake(finding: Diagnostic, shortfall: Shortfall) -> bool:
    name = finding.rule.name
    if shortfall.fact:
        return name in RULES_OF_FACTS.get(shortfall.fact, ())
    if name not in _RULES_OF_KINDS.get(shortfall.kind, ()) or finding.location.path != shortfall.path:
        return False
    return shortfall.kind != "absent" or (shortfall.expected or "") in finding.message
