"""What `twinform check` prints file by file, its summary, and its exit code."""

import os
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import click

from twinform.cli.baseline_file import Baselines
from twinform.cli.checked_file import CheckedFile, Reporting, is_elsewhere
from twinform.cli.command import FINDINGS, UNUSABLE
from twinform.cli.flags import group
from twinform.cli.printing import print_document, print_line, show
from twinform.diagnostics import Diagnostic, Policy, Safety, Severity, rules
from twinform.diagnostics.diagnostic import WORST_FIRST
from twinform.diagnostics.reporters import REPORTERS, FileFindings
from twinform.diagnostics.reporters.file_findings import cause_of
from twinform.diagnostics.wording import plural

_FOR_PEOPLE = frozenset({"text", "concise"})
_STREAMED = _FOR_PEOPLE | {"github"}
"""Formats that are printed file by file; the others are one document."""


class ExitOptions(NamedTuple):
    """What the exit code depends on besides errors, and whether the rules that were found are counted."""

    max_warnings: int | None = None
    exit_zero: bool = False
    statistics: bool = False


USUAL_EXIT = ExitOptions()
exit_options = group(
    "exit_options",
    ExitOptions,
    click.option("--max-warnings", type=click.IntRange(min=0), metavar="N", help="Exit code 1 with more warnings."),
    click.option("--exit-zero", is_flag=True, help="Exit code 0 whatever is found in the files."),
    click.option("--statistics", is_flag=True, help="Say how often each rule was found."),
)
"""Gives a command `--max-warnings`, `--exit-zero` and `--statistics`, as `exit_options`."""


class OnceInAllFiles:
    """Leaves out findings that were reported before, for another robot or call of a macro.

    These are findings about files that others include, and about packages, whichever files ask for them.
    """

    def __init__(self) -> None:
        self.repeated = 0
        """The number of findings that another robot had before."""
        self._first: dict[object, str] = {}

    def is_new(self, finding: Diagnostic, robot: str) -> bool:
        """Whether a finding that several robots may have was not asked about before."""
        where = finding.location
        cause = cause_of(replace(finding, help=None))  # advice may name the robot
        place = (os.path.abspath(where.file), where.line, cause)  # noqa: PTH100 - many strings
        key = (finding.rule, finding.found) if finding.rule is rules.MISSING_PACKAGE else place
        is_new = key not in self._first
        self.repeated += self._first.setdefault(key, robot) != robot
        return is_new


class CheckReport:
    """The report of a run in one format; it keeps no models, since there may be thousands."""

    def __init__(
        self,
        style: str,
        *,
        notes: bool,
        baselines: Baselines,
        every: bool = False,
        arguments: Iterable[str] = (),
        exit_options: ExitOptions = USUAL_EXIT,
    ) -> None:
        self.style, self.notes, self.every, self.baselines = style, notes, every, baselines
        self.shown: Severity | None = Severity.INFO if notes or style not in _FOR_PEOPLE else Severity.WARNING
        """The severity from which on findings have columns; None if none has any."""
        self.exit, self.by_rule = exit_options, Counter[str]()
        self.unused, self.once = {*arguments}, OnceInAllFiles()
        self.on_stderr, self.fixed = False, 0
        self.fixes: Counter[Safety] = Counter()
        self.kept: list[FileFindings] = []
        self.counts: Counter[Severity] = Counter()
        self.files = self.unreadable = self.unusable = self.waiting = self.allowed = self.known = 0

    def reporting(self, name: str, policy: Policy) -> Reporting:
        """Return what is to be reported of the findings of a file."""
        baseline = self.baselines.of(name)
        return Reporting(
            policy,
            fixed=Severity.INFO if self.notes else Severity.WARNING,
            shown=self.shown,
            baseline=baseline and baseline.run.of_file(name),
            updates=self.baselines.update,
        )

    def new_findings(self, findings: FileFindings) -> list[Diagnostic]:
        """Return the findings about a file that are printed, with the name of the file in each."""
        least = Severity.INFO if self.notes else Severity.WARNING
        shown = [each for each in self._without_known(findings).diagnostics if each.severity >= least]
        where = [each.location._replace(file=each.location.file or findings.path) for each in shown]
        return [replace(each, location=place) for each, place in zip(shown, where, strict=True)]

    def add(self, checked: CheckedFile) -> None:
        """Report on one file."""
        findings = self._without_known(checked.findings)
        self.allowed += checked.allowed
        self.known += checked.known
        self.files += 1
        self.unreadable += checked.unreadable
        self.unusable += checked.unusable
        self.waiting += checked.waits
        if checked.unused is not None:
            self.unused &= {*checked.unused}
        self.counts.update(each.severity for each in findings.diagnostics)
        least = Severity.INFO if self.notes else Severity.WARNING
        self.by_rule.update(each.rule.name for each in findings.diagnostics if each.severity >= least)
        self.fixes.update(each.fix.safety for each in findings.diagnostics if each.fix)
        baseline = self.baselines.of(findings.path)
        if baseline:
            is_whole = not (checked.unreadable or checked.waits)
            baseline.run.add((findings.path, *checked.parts) if is_whole else (), checked.baselined)
        if self.style in _FOR_PEOPLE:
            short = self.style == "concise"
            show(findings, notes=self.notes, on_stderr=self.on_stderr, every=self.every, short=short)
        elif self.style in _STREAMED:
            print_document(REPORTERS[self.style]([findings]))
        else:
            self.kept.append(findings)

    def _without_known(self, findings: FileFindings) -> FileFindings:
        """Leave out what is known of files that others include: from another one of these, or from the baseline."""
        kept = tuple(each for each in findings.diagnostics if not self._is_known(each, findings.path))
        return findings if len(kept) == len(findings.diagnostics) else findings._replace(diagnostics=kept)

    def _is_known(self, finding: Diagnostic, path: str) -> bool:
        is_of_others = is_elsewhere(finding, path)
        if not is_of_others and finding.rule is not rules.MISSING_PACKAGE:
            return False
        if not self.once.is_new(finding, path):
            return True
        if not is_of_others:
            return False
        baseline = self.baselines.of(path)
        if baseline is None or baseline.run.unknown(path, [finding]):
            return bool(baseline) and self.baselines.update and finding.severity is not Severity.INFO
        self.known += 1
        return True

    def end(self) -> int:
        """Print the rest and the summary; return the exit code."""
        if self.style not in _STREAMED:
            print_document(REPORTERS[self.style](self.kept))
        news = self.baselines.write()
        print_line(self._summary(), err=True)
        for rule, count in self.by_rule.most_common() if self.exit.statistics else ():
            print_line(f"{count:>6}  {rule}", err=True)
        for name in sorted(self.unused):
            print_line(f"no file has the argument {name!r}", err=True)
        for line in news:
            print_line(line, err=True)
        if self.unusable:
            return UNUSABLE
        excess = self.exit.max_warnings is not None and self.counts[Severity.WARNING] > self.exit.max_warnings
        if excess:
            print_line(f"more warnings than --max-warnings {self.exit.max_warnings}", err=True)
        return FINDINGS if (self.counts[Severity.ERROR] or excess) and not self.exit.exit_zero else 0

    def _summary(self) -> str:
        found = ", ".join(plural(self.counts[each], each.word) for each in WORST_FIRST)
        more = (
            (self.unreadable, "could not be read"),
            (self.waiting, "not checked, for want of arguments or packages"),
            (self.once.repeated, "in other files too"),
            (self.allowed, "allowed"),
            (self.known, "in the baseline"),
            (self.fixed, "fixed"),
        )
        counts = "".join(f"; {count} {what}" for count, what in more if count)
        return f"{plural(self.files, 'file')}: {found}{counts}{self._fixable() if not self.fixed else ''}"

    def _fixable(self) -> str:
        """Say how many findings `--fix` would fix at most."""
        safe, unsafe = self.fixes[Safety.SAFE], self.fixes[Safety.UNSAFE]
        if safe and unsafe:
            return f"; {safe} fixable with --fix, {unsafe} more with --unsafe-fixes"
        if safe:
            return f"; {safe} fixable with --fix"
        return f"; {unsafe} fixable with --fix --unsafe-fixes" if unsafe else ""
