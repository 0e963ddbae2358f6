"""Findings that are left out: allowed ones, by the caller or by comments, and those that only follow from an error.

An allowed finding is not reported, and an allowed error stops nothing, as long as there is a model in spite of it.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import field, replace
from pathlib import Path

from twinform.compiler.input.size_limits import Limits
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, LineOrigins, Location, Rule, rules
from twinform.diagnostics.rules import MALFORMED_SUPPRESSION, UNUSED_SUPPRESSION
from twinform.diagnostics.suppressions import NO_SUPPRESSIONS, Suppression, Suppressions
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern
from twinform.schemas.messages import StandIn

_MARKS = tuple(
    ("<!--".encode(code), "twinform".encode(code), "urn:twinform:".encode(code))
    for code in ("utf-8", "utf-16-le", "utf-16-be")
)
"""How a comment begins, the word that begins a suppression, and the namespace with that word, in each encoding."""
_WITHOUT_MODEL = "without this part there is no model"


@dataclass(slots=True)
class Allowances:
    """What is left out of the findings about one file.

    `files` has the suppressions of the file and of others, which are read when a finding is about them. `known` has the
    keys of findings that were left out, by which they are recognized at later stages, where their lines differ.

    Allowed warnings are always left out. Allowed errors are left out where the caller is `tolerant` and there is a
    model in spite of them; fatal and unsound ones only once the file is `checked`, when nothing will be made of it.
    """

    file: str
    rules: frozenset[str]
    limits: Limits
    tolerant: bool = False
    origins: Mapping[str, LineOrigins] = field(default_factory=dict[str, LineOrigins])
    files: dict[str, Suppressions] = field(default_factory=dict[str, Suppressions])
    known: set[tuple[str, str, str]] = field(default_factory=set[tuple[str, str, str]])
    checked: bool = False

    def __call__(self, diagnostic: Diagnostic) -> bool:
        """Whether a finding is allowed."""
        if diagnostic.is_error and not self._tolerates(diagnostic.rule):
            return False
        if diagnostic.rule.name in self.rules or self._key(diagnostic) in self.known:
            return True
        where = self._place_in_source(diagnostic.location)
        return self._suppressions_in(where.file).covers(diagnostic.rule.name, where.line)

    def in_conversion(self, diagnostic: Diagnostic) -> bool:
        """Whether a finding of a conversion is allowed; an error that reading did not find never is."""
        is_new = all(diagnostic.rule.name != rule for rule, _, _ in self.known)
        return not (diagnostic.is_error and is_new) and self(diagnostic)

    def _tolerates(self, rule: Rule) -> bool:
        # 55 case files with errors were converted with all of their rules allowed: some conversions
        # looked for a link that is not there, and one went round a loop forever. What is no tree
        # can therefore be silenced in `check` only. `load`, `diff` and `stats` are never tolerant:
        # their callers count on documents without errors.
        return self.tolerant and (self.checked or not (rule.unsound or rule.fatal))

    def read(self, text: bytes, sink: DiagnosticSink) -> None:
        """Read the suppressions of the file itself from its text, and report what is wrong with them."""
        found = self.files[self.file] = suppressions(text)
        for flaw in found.flaws:
            sink.report(MALFORMED_SUPPRESSION, flaw.message, Location(self.file, flaw.line), help=flaw.help)
        for entry in found.entries:
            for name in entry.rules:
                where = Location(self.file, entry.line)
                for message, help in _name_problems(name):
                    sink.report(MALFORMED_SUPPRESSION, message, where, found=name, help=help)

    def settle(self, sink: DiagnosticSink) -> None:
        """Remove what is allowed from the findings of a stage."""
        found = [each for each in sink.diagnostics if self(each)]
        if found:
            self.known.update(self._key(each) for each in found)
            sink.take_out(found)

    def put_back(self, sink: DiagnosticSink) -> None:
        """Report allowed errors after all, because there is no model."""
        self.tolerant = False
        errors = [each for each in sink.allowed if each.is_error]
        sink.allowed = [each for each in sink.allowed if not each.is_error]
        sink.extend(staying(errors, _WITHOUT_MODEL))

    def _key(self, diagnostic: Diagnostic) -> tuple[str, str, str]:
        where = diagnostic.location
        return diagnostic.rule.name, self._place_in_source(where).file, where.path or str(where.line)

    def _place_in_source(self, where: Location) -> Location:
        """Return the place in the file that the author has written, for a place in what it expands to."""
        origins = self.origins.get(where.file)
        return (origins.place(where.line) if origins else None) or where

    def _suppressions_in(self, file: str) -> Suppressions:
        file = file or self.file
        if file not in self.files:
            self.files[file] = suppressions(content_of(Path(file), self.limits))
        return self.files[file]


def staying(errors: Iterable[Diagnostic], reason: str) -> Iterator[Diagnostic]:
    """Yield allowed errors as errors that are reported nevertheless, with the reason."""
    for each in errors:
        help = f"it is allowed, and stays: {reason}"
        yield replace(each, help=f"{each.help}\n{help}" if each.help else help)


def suppressions(text: bytes) -> Suppressions:
    """Parse the suppressions in a file."""
    if not any(comment in text and text.count(mark) > text.count(namespace) for comment, mark, namespace in _MARKS):
        return NO_SUPPRESSIONS
    from twinform.diagnostics.suppressions import parse_suppressions  # noqa: PLC0415 - few files have any
    from twinform.text import SourceText, UndecodableError  # noqa: PLC0415 - as above
    from twinform.text.comments import comments  # noqa: PLC0415 - as above

    try:
        return parse_suppressions(comments(SourceText.of(text).text))
    except UndecodableError:
        return NO_SUPPRESSIONS  # the parser has said so, or knows better


def content_of(file: Path, limits: Limits) -> bytes:
    """Return the content of a file, or nothing where it cannot be read."""
    try:
        return Readable.of(file).read(file, limits.size)
    except (OSError, ValueError):
        return b""  # a name that stands for something that is no file


def _name_problems(name: str) -> Iterator[tuple[str, str | None]]:
    """Yield what is wrong with the name of a rule in a comment, and help."""
    from twinform.diagnostics import did_you_mean, rule_registry  # noqa: PLC0415 - few files have any

    try:
        found = rule_registry.find_rule(name)
        if found is None:
            yield (
                f"no rule is called {name!r}",
                did_you_mean(name, rule_registry.rules()) or "`twinform explain` lists the rules",
            )
    except rule_registry.RuleRegistryError as error:
        yield f"{name!r} is not known: {error}", None


_NAMES = """
    ambiguous-frame angle-in-degrees backslash-in-path bare-material blank-value conflicting-material
    continuous-in-sdf dangling-frame dangling-link defaulted-attribute deprecated-element dialect duplicate-name
    empty-dynamics empty-model empty-name frame-cycle gazebo-conflict gazebo-tag-without-target impossible-inertia
    indefinite-inertia inertia-from-nothing invalid-value kinematic-loop lower-above-upper mimic-cycle
    misplaced-sensor missing-attribute missing-axis missing-element missing-file missing-inertial missing-limit
    missing-part missing-shape no-links non-positive-mass old-root out-of-range outside-version repaired-xml
    repeated-element reserved-name self-joint sensor-mismatch several-at-top several-roots shared-name split-value
    stray-text tabbed-numbers transmission-without-joint two-parents unexpanded-xacro unknown-attribute
    unknown-canonical-link unknown-collision unknown-driven-joint unknown-element unknown-gripper-link
    unknown-leader unknown-material unknown-reference unknown-version unnamed-material unnormalised-axis
    unnormalised-quaternion unprintable-name unused-axis unused-limit world-child xacro-warning zero-axis zero-limit
    zero-size
"""
ALWAYS_SOUGHT = frozenset(_NAMES.split())
"""The rules that every check looks for; others are looked for by passes, conversions, or where includes are read."""


def report_unused(allowances: Allowances, sink: DiagnosticSink) -> None:
    """Report each suppression in the file itself that suppresses nothing."""
    own = allowances.files.get(allowances.file)
    for entry, rule in own.unused() if own else ():
        if rule in ALWAYS_SOUGHT:
            where = _describe_lines(entry)
            message = f"no {rule} is found {where}, so nothing has to be allowed"
            help = f"delete {rule} from the comment" if len(entry.rules) > 1 else "delete the comment"
            sink.report(UNUSED_SUPPRESSION, message, Location(allowances.file, entry.line), found=rule, help=help)


def _describe_lines(entry: Suppression) -> str:
    """Say in words on which lines an entry allows its rules."""
    if not entry.last:
        return "in this file"
    return f"on line {entry.first}" if entry.first == entry.last else f"on the lines {entry.first} to {entry.last}"


_OF_LIMITS = frozenset({rules.MISSING_LIMIT, rules.PARTIAL_LIMIT})
_OF_NAMES = frozenset({rules.EMPTY_NAME, rules.DUPLICATE_NAME, rules.SHARED_NAME})
_OF_THE_TREE = frozenset({rules.SEVERAL_ROOTS, rules.EMPTY_MODEL})
_REFERENCES = frozenset(
    {
        rules.DANGLING_FRAME,
        rules.DANGLING_LINK,
        rules.UNKNOWN_CANONICAL_LINK,
        rules.UNKNOWN_DRIVEN_JOINT,
        rules.UNKNOWN_GRIPPER_LINK,
        rules.UNKNOWN_LEADER,
        rules.UNKNOWN_REFERENCE,
    }
)
OF_OTHER_PARTS = _REFERENCES | _OF_THE_TREE
"""The rules of findings about parts that another part of the file should have made."""
_JOINT = lazy_pattern(r"/joint(?=[\[/]|$)")
_PREDICATE_END = lazy_pattern(r"\](?=/|$)")
_ENDS = ("/parent", "/child")


def without_consequences(
    found: Iterable[Diagnostic], errors: Iterable[Diagnostic], stand_ins: Collection[StandIn]
) -> list[Diagnostic]:
    """Return the findings about a document that do not merely follow from errors of reading, or from stand-ins."""
    paths = [each.location.path for each in errors if each.is_error]
    follows = [*_of_errors(paths), *_of_stand_ins(stand_ins)] if paths else []
    return [each for each in found if not any(rule(each) for rule in follows)]


def _of_errors(paths: Iterable[str]) -> Iterator[Callable[[Diagnostic], bool]]:
    places = [(joint, path.removeprefix(joint)) for path in paths if (joint := _joint_of(path))]
    without_limits = {joint for joint, rest in places if "/limit" in rest}
    yield lambda each: each.rule in _OF_LIMITS and _joint_of(each.location.path) in without_limits
    if any(not rest or rest.startswith(_ENDS) for _, rest in places):
        yield lambda each: each.rule in _OF_THE_TREE
    if any("/material" in path for path in paths):
        yield lambda each: each.rule is rules.UNKNOWN_MATERIAL


def _of_stand_ins(stand_ins: Iterable[StandIn]) -> Iterator[Callable[[Diagnostic], bool]]:
    untyped = {each.path: each.name for each in stand_ins if each.field == "type"}
    yield lambda each: _joint_of(each.location.path) in untyped and not each.location.path.endswith(_ENDS)
    yield lambda each: each.rule is rules.UNKNOWN_LEADER and each.found in untyped.values()
    if any(each.field == "name" for each in stand_ins):
        yield lambda each: each.rule in _REFERENCES or each.rule in _OF_THE_TREE
        yield lambda each: each.rule in _OF_NAMES and not each.found


def _joint_of(path: str) -> str:
    """Return the path of the joint that a path leads into; empty if it leads into none."""
    step = max(_JOINT.finditer(path), key=lambda found: found.end(), default=None)
    if step is None or path[step.end() :][:1] != "[":
        return path[: step.end()] if step else ""
    end = _PREDICATE_END.search(path, step.end())
    return path[: end.end()] if end else ""
