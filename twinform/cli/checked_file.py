"""What `check` reports about one file, as a value that can be sent from another process and kept as JSON."""

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from twinform.cli.check_plan import OUTSIDE, with_outside_faults
from twinform.cli.command import Unusable
from twinform.cli.diagnostic_rows import diagnostic_of_row, row_of_diagnostic
from twinform.cli.inputs import InputSource, read_model
from twinform.compiler import LoadOptions, LoadResult, ReadOnlyPassError, as_refused, inspect
from twinform.compiler.input.load_options import XACRO, ReadingOptions
from twinform.compiler.input.root_names import may_be_mjcf
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Location, Policy, Rule, Severity, rules
from twinform.diagnostics.reporters import NO_TEXTS, FileFindings, FileTexts
from twinform.passes import PassError

if TYPE_CHECKING:
    from twinform.diagnostics.baseline import BaselineRun, KnownFinding
    from twinform.passes import Pipeline


@dataclass(frozen=True, slots=True)
class Reporting:
    """What is reported of the findings of a file.

    Fixes are made for findings from the severity `fixed` on, and columns for those from `shown` on, if any: with them a
    finding gets the line of the piece of text that it is about, while comments allow it at its element. Findings of the
    `baseline` are left out; with `updates` all that a baseline can have. Those in files that others include may have
    been reported before, so they stay, and whoever reports on all files decides about them.
    """

    policy: Policy
    fixed: Severity
    shown: Severity | None
    baseline: "BaselineRun | None" = None
    updates: bool = False

    def new(self, loaded: LoadResult, seen: tuple[Diagnostic, ...]) -> tuple[Diagnostic, ...]:
        """Return the findings that are not known from the baseline."""
        if self.baseline is None:
            return seen
        own = {id(each) for each in seen if not is_elsewhere(each, loaded.path)}
        new = {id(each) for each in self.baseline.unknown(loaded.path, (each for each in seen if id(each) in own))}
        if self.updates:
            new = {id(each) for each in seen if each.severity is Severity.INFO}
        return tuple(each for each in seen if id(each) in new or id(each) not in own)


def is_elsewhere(finding: Diagnostic, path: str) -> bool:
    """Whether a finding about a file is in another one, which that includes."""
    where = finding.location
    return bool(where.line and where.file) and where.file != path


@dataclass(frozen=True, slots=True)
class CheckedFile:
    """The findings of a file with columns and fixes, and the texts that they are about.

    `unusable` tells that the command was wrong: the file was named, and there is none. It `waits` where it could not be
    expanded for want of arguments or packages. `allowed` and `known` are the numbers of findings that are left out by
    the rules or comments, and by the baseline; `baselined` counts those that a baseline can have. `parts` are the files
    that it includes, and `unused` the arguments that it does not ask for, unless it is none that can be expanded.
    """

    findings: FileFindings
    unreadable: bool = False
    unusable: bool = False
    waits: bool = False
    allowed: int = 0
    known: int = 0
    baselined: "Mapping[KnownFinding, int]" = field(default_factory=dict["KnownFinding", int])
    parts: tuple[str, ...] = ()
    unused: tuple[str, ...] | None = None

    @classmethod
    def of(cls, loaded: LoadResult, reporting: Reporting, *, named: bool) -> "CheckedFile":
        """Make the report on a file that was read and inspected, and that was `named` or found in a folder."""
        unused = tuple(each.found or "" for each in loaded.diagnostics if each.rule is rules.UNUSED_ARGUMENT)
        found = [each for each in loaded.diagnostics if named or each.rule is not rules.UNUSED_ARGUMENT]
        waits = loaded.unreadable and any(each.rule in OUTSIDE for each in found)
        seen = reporting.policy.apply(found)
        new = reporting.new(loaded, seen)
        return cls(
            _locate(loaded, _with_fixes(loaded, new, reporting.fixed), reporting.shown),
            loaded.unreadable and not waits and any(each.is_error for each in (*found, *loaded.allowed)),
            is_unusable(loaded, named=named),
            waits,
            allowed=len(loaded.allowed) + len(found) - len(seen),
            known=len(seen) - len(new),
            baselined=dict(reporting.baseline.found) if reporting.baseline else {},
            parts=tuple(_parts_of(loaded)) if reporting.baseline else (),
            unused=unused if loaded.origins else None,
        )

    @classmethod
    def failed(cls, path: str, why: str) -> "CheckedFile":
        """Make the report on a file whose check has ended its process or did not come to an end."""
        found = Diagnostic(
            rules.UNREADABLE_FILE, f"the file could not be checked: {why}", Location(path), Severity.ERROR
        )
        return cls(FileFindings(path, (found,)), unreadable=True)

    def to_json(self) -> list[Any]:
        """Return the report as lists and texts, with the pieces of the files that reports quote."""
        found = self.findings.diagnostics
        return [
            self.findings.path,
            self.unreadable,
            self.unusable,
            self.waits,
            self.allowed,
            self.known,
            [[list(known), count] for known, count in self.baselined.items()],
            [row_of_diagnostic(each) for each in found],
            QuotedTexts.of(self.findings).to_json(),
            list(self.parts),
            None if self.unused is None else list(self.unused),
        ]

    @classmethod
    def from_json(cls, row: list[Any]) -> "CheckedFile":
        """Make a report of what `to_json` has returned.

        Raises:
            ValueError, TypeError, LookupError: it was something else.
        """
        path, unreadable, unusable, waits, allowed, known, baselined, found, texts, parts, unused = row
        counts = _known_findings(baselined) if baselined else {}
        findings = FileFindings(path, tuple(map(diagnostic_of_row, found)), QuotedTexts.from_json(texts))
        arguments = None if unused is None else tuple(unused)
        return cls(findings, unreadable, unusable, waits, allowed, known, counts, tuple(parts), arguments)


@dataclass(frozen=True, slots=True)
class CheckTask:
    """The check of one file, with the options for it, and the `problem` because of which they are not its own."""

    source: InputSource
    load_options: LoadOptions
    passes: "Pipeline | None"
    expands_includes: bool
    reporting: Reporting
    role: str = "robot"
    named: bool = True
    problem: Diagnostic | None = None

    @property
    def name(self) -> str:
        """The path of the file."""
        return self.source.name

    @property
    def is_kept(self) -> bool:
        """Whether the result can be kept: passes of other packages may read what nobody knows of."""
        if not self.passes:
            return True
        from twinform.compiler.dependencies import owners_of  # noqa: PLC0415 - few runs have passes

        return owners_of(self.passes) <= {"twinform"}

    @property
    def seconds(self) -> float:
        """How long the check takes, as measured over the corpus: each expansion of xacro has a process of its own."""
        return 0.08 if self.load_options.xacro or self.name.lower().endswith(XACRO) else 0.005

    def with_unsaved(self, texts: Mapping[str, bytes]) -> "CheckTask":
        """Return the task for files that have other texts than on the disk."""
        return replace(self, load_options=self.load_options.with_unsaved(texts))

    def look(self) -> LoadResult:
        """Read the file and find what is wrong in it.

        Raises:
            click.UsageError: a pass changes the model.
            Unusable: a pass is at fault.
        """
        if self.role == "companion":
            from twinform.compiler.companions.check_companion import check_companion  # noqa: PLC0415 - few have any

            content = self.source.content if isinstance(self.source.content, bytes) else None
            found = check_companion(Path(self.source.name), self.load_options, content)
            return found if self.load_options.strict else with_outside_faults(found, named=self.named)
        if self.role != "part":
            loaded = self._look_at_robot()
            if self.role == "robot" or not loaded.unreadable:
                return loaded
        if may_be_mjcf(self.name):
            if self.named:
                return self._look_at_robot()
            from twinform.compiler.input.included_parts import check_mjcf_part  # noqa: PLC0415 - as below

            return check_mjcf_part(Path(self.name), self.load_options)
        from twinform.compiler.input.included_parts import check_part  # noqa: PLC0415 - few files are parts

        return check_part(Path(self.source.name), self.load_options)

    def _look_at_robot(self) -> LoadResult:
        reading: ReadingOptions = {"expand_includes": self.expands_includes}
        read = read_model(self.source, self.load_options, reading)
        if not self.load_options.strict:
            read = with_outside_faults(read, named=self.named)
        try:
            return as_refused(inspect(read, self.load_options, self.passes))
        except ReadOnlyPassError as error:
            raise click.UsageError(str(error)) from error
        except PassError as error:
            raise Unusable(str(error)) from error

    def do(self) -> CheckedFile:
        """Check the file."""
        loaded = self.look()
        if self.problem:
            loaded = replace(loaded, diagnostics=(self.problem, *loaded.diagnostics))
        return CheckedFile.of(loaded, self.reporting, named=self.named)


def is_unusable(loaded: LoadResult, *, named: bool) -> bool:
    """Whether a file was named that is none, or xacro is not installed: then the command was wrong, and not a file."""
    reasons = {each.rule for each in loaded.diagnostics} if loaded.unreadable else set[Rule]()
    is_none = named and loaded.content is None and not os.path.isfile(loaded.path)  # noqa: PTH113 - is_file raises for a long name
    return rules.XACRO_MISSING in reasons or (is_none and rules.UNREADABLE_FILE in reasons)


def _parts_of(loaded: LoadResult) -> set[str]:
    return {place.file for origins in loaded.origins.values() for place in origins.places} - {loaded.path}


def _known_findings(rows: list[Any]) -> "dict[KnownFinding, int]":
    from twinform.diagnostics.baseline import KnownFinding  # noqa: PLC0415 - few runs have a baseline

    return {KnownFinding(*known): count for known, count in rows}


def _with_fixes(loaded: LoadResult, found: tuple[Diagnostic, ...], least: Severity) -> tuple[Diagnostic, ...]:
    if not any(each.rule.fix and each.severity >= least for each in found):
        return found
    from twinform.compiler.fixing import with_fixes  # noqa: PLC0415 - clean files need none

    return with_fixes(replace(loaded, diagnostics=found), lambda each: each.severity >= least)


def _locate(loaded: LoadResult, found: tuple[Diagnostic, ...], least: Severity | None) -> FileFindings:
    """Add columns to the findings that are shown, and the texts of the files; others come last, and are counted."""
    shown = tuple(each for each in found if least is not None and each.severity >= least)
    if least is None or not shown:
        return FileFindings(loaded.path, found)
    # only findings have places
    from twinform.compiler.input.finding_spans import SourceFiles, with_columns  # noqa: PLC0415 - see above

    files = SourceFiles.of(loaded)
    others = tuple(each for each in found if each.severity < least)
    return FileFindings(loaded.path, (*with_columns(shown, files), *others), files)


@dataclass(frozen=True, slots=True)
class QuotedTexts:
    """The lines of files that reports quote, and the lines and columns of the edits of fixes."""

    lines: Mapping[tuple[str, int], str]
    places: Mapping[tuple[str, int], tuple[int, int]]

    @classmethod
    def of(cls, findings: FileFindings) -> "QuotedTexts":
        """Collect what a report may quote for some findings."""
        texts, path = findings.texts, findings.path
        if texts is NO_TEXTS:
            return cls({}, {})
        lines = {(name, each.location.line) for each in findings.diagnostics for name in [each.location.file or path]}
        offsets = {
            (edit.file or path, offset)
            for each in findings.diagnostics
            for edit in (each.fix.edits if each.fix else ())
            for offset in edit.span
        }
        return cls(dict(_known(lines, texts.line)), dict(_known(offsets, texts.place)))

    def line(self, file: str, number: int, /) -> str | None:
        """Return a line, from 1, without its end; None if unknown."""
        return self.lines.get((file, number))

    def place(self, file: str, offset: int, /) -> tuple[int, int] | None:
        """Return the line and column of an offset; None if unknown."""
        return self.places.get((file, offset))

    def to_json(self) -> list[Any]:
        """Return the texts as lists."""
        lines = [[*key, line] for key, line in sorted(self.lines.items())]
        return [lines, [[*key, *place] for key, place in sorted(self.places.items())]]

    @classmethod
    def from_json(cls, rows: list[Any]) -> FileTexts:
        """Return the texts that `to_json` has written."""
        lines, places = rows
        return cls(
            {(file, number): line for file, number, line in lines},
            {(file, offset): (line, column) for file, offset, line, column in places},
        )


def _known(keys: Iterable[tuple[str, int]], ask: Any) -> Iterator[tuple[tuple[str, int], Any]]:
    """Yield the keys about which something is known, with that."""
    for key in sorted(keys):
        found = ask(*key)
        if found is not None:
            yield key, found
