"""Allowed findings: rules that the caller allows, and comments in the files that findings lead to.

What is allowed is no finding: an allowed error stops nothing, as long as there is a model in spite of it.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from twinform.compiler.input.size_limits import Limits
from twinform.diagnostics import Diagnostic, DiagnosticSink, LineOrigins, Location, Rule
from twinform.diagnostics.rules import MALFORMED_SUPPRESSION
from twinform.diagnostics.suppressions import NO_SUPPRESSIONS, Suppressions
from twinform.file_access import Readable

_MARKS = tuple(("twinform".encode(code), "urn:twinform:".encode(code)) for code in ("utf-8", "utf-16-le", "utf-16-be"))
"""What stands in a comment that allows something, and where else it stands, in each encoding."""
_WITHOUT_MODEL = "without this part there is no model, and nothing else could be checked"


@dataclass(slots=True)
class Allowances:
    """What may be left out of the findings about one file.

    `file` is that file, and `files` are the suppressions of it and of others, which are read when a finding leads
    there. `known` are the findings that were left out, by what they are known by at later stages, where lines differ.

    Warnings are always left out. Errors are where the caller is `tolerant`, if there is a model in spite of them; those
    that are unsound once it is `checked`, and nothing more is to be made of it.
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
        if diagnostic.rule.fatal or (diagnostic.is_error and not self._tolerates(diagnostic.rule)):
            return False
        if diagnostic.rule.name in self.rules or self._key(diagnostic) in self.known:
            return True
        where = self._place_in_source(diagnostic.location)
        return self._suppressions_in(where.file).covers(diagnostic.rule.name, where.line)

    def in_conversion(self, diagnostic: Diagnostic) -> bool:
        """Whether a finding of a conversion is allowed; errors that reading did not find never are."""
        is_new = all(diagnostic.rule.name != rule for rule, _, _ in self.known)
        return not (diagnostic.is_error and is_new) and self(diagnostic)

    def _tolerates(self, rule: Rule) -> bool:
        # 55 case files with errors were converted with all of their rules allowed: some conversions
        # looked for a link that is not there, and one went round a loop forever. What is no tree
        # can therefore be silenced in `check` only. `load`, `diff` and `stats` are never tolerant:
        # their callers count on documents without errors.
        return self.tolerant and (self.checked or not rule.unsound)

    def read(self, text: bytes, sink: DiagnosticSink) -> None:
        """Take the suppressions of the file itself from its text, and report what is wrong with them."""
        found = self.files[self.file] = suppressions(text)
        for flaw in found.flaws:
            sink.report(MALFORMED_SUPPRESSION, flaw.message, Location(self.file, flaw.line), help=flaw.help)
        for entry in found.entries:
            for name in entry.rules:
                where = Location(self.file, entry.line)
                for message, help in _problems(name):
                    sink.report(MALFORMED_SUPPRESSION, message, where, found=name, help=help)

    def settle(self, sink: DiagnosticSink) -> None:
        """Take what is allowed out of the findings of a stage."""
        found = [each for each in sink.diagnostics if self(each)]
        if found:
            self.known.update(self._key(each) for each in found)
            sink.take_out(found)

    def put_back(self, sink: DiagnosticSink) -> None:
        """Report the errors again that were allowed, since there is no model."""
        self.tolerant = False
        errors = [each for each in sink.allowed if each.is_error]
        sink.allowed = [each for each in sink.allowed if not each.is_error]
        sink.extend(staying(errors, _WITHOUT_MODEL))

    def _key(self, diagnostic: Diagnostic) -> tuple[str, str, str]:
        where = diagnostic.location
        return diagnostic.rule.name, self._place_in_source(where).file, where.path or str(where.line)

    def _place_in_source(self, where: Location) -> Location:
        """The place in the file that somebody has written, of one in what that expands to."""
        origins = self.origins.get(where.file)
        return (origins.place(where.line) if origins else None) or where

    def _suppressions_in(self, file: str) -> Suppressions:
        file = file or self.file
        if file not in self.files:
            self.files[file] = suppressions(content_of(Path(file), self.limits))
        return self.files[file]


def staying(errors: Iterable[Diagnostic], reason: str) -> Iterator[Diagnostic]:
    """Errors that are allowed, and have to be reported for a reason."""
    for each in errors:
        help = f"it is allowed, and stays: {reason}"
        yield replace(each, help=f"{each.help}\n{help}" if each.help else help)


def suppressions(text: bytes) -> Suppressions:
    """The suppressions in a file."""
    if not any(text.count(mark) > text.count(namespace) for mark, namespace in _MARKS):
        return NO_SUPPRESSIONS
    from twinform.diagnostics.suppressions import parse_suppressions  # noqa: PLC0415 - few files have any
    from twinform.text import SourceText, UndecodableError  # noqa: PLC0415 - as above
    from twinform.text.comments import comments  # noqa: PLC0415 - as above

    try:
        return parse_suppressions(comments(SourceText.of(text).text))
    except UndecodableError:
        return NO_SUPPRESSIONS  # the parser has said so, or knows better


def content_of(file: Path, limits: Limits) -> bytes:
    """What is in a file; nothing where it cannot be read."""
    try:
        return Readable.of(file).read(file, limits.size)
    except (OSError, ValueError):
        return b""  # a name that stands for something that is no file


def _problems(name: str) -> Iterator[tuple[str, str | None]]:
    """What is wrong with the name of a rule in a comment, and help."""
    from twinform.diagnostics import did_you_mean  # noqa: PLC0415 - few files have any
    from twinform.diagnostics.rule_registry import RuleRegistryError, find_rule, rules  # noqa: PLC0415 - as above

    try:
        found = find_rule(name)
        if found is None:
            yield f"no rule is called {name!r}", did_you_mean(name, rules()) or "`twinform explain` lists the rules"
        elif found.rule.fatal:
            yield f"{name} is fatal, and cannot be allowed", None
    except RuleRegistryError as error:
        yield f"{name!r} is not known: {error}", None
