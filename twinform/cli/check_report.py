"""What `twinform check` prints, file by file, and the exit code that follows."""

from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING

from twinform.cli.baseline import BaselineFile
from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.print_findings import placed, show
from twinform.cli.printing import print_document, print_line
from twinform.compiler import LoadResult
from twinform.diagnostics import Policy, Safety, Severity
from twinform.diagnostics.reporters import REPORTERS, FileFindings

if TYPE_CHECKING:
    from twinform.compiler.input.source_files import SourceFiles

_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_FOR_PEOPLE = frozenset({"text", "concise"})
_STREAMED = _FOR_PEOPLE | {"github"}
"""Formats that are printed file by file; the others are one document."""


class CheckReport:
    """The report of a run in one format. Of models it keeps nothing: there may be thousands."""

    def __init__(self, style: str, *, notes: bool, every: bool = False, baseline: BaselineFile | None = None) -> None:
        self.style, self.notes, self.every, self.baseline = style, notes, every, baseline
        self.on_stderr, self.fixed = False, 0
        self.fixes: Counter[Safety] = Counter()
        self.kept: list[FileFindings] = []
        self.counts: Counter[Severity] = Counter()
        self.files = self.unreadable = self.unopened = self.allowed = self.known = 0

    def add(self, loaded: LoadResult, policy: Policy) -> None:
        """Report on one file."""
        seen = policy.apply(loaded.diagnostics)
        self.allowed += len(loaded.allowed) + len(loaded.diagnostics) - len(seen)
        # what is known of a file that cannot be read stays known
        new = self.baseline.run.unknown(loaded.path, seen) if self.baseline and not loaded.unreadable else seen
        if self.baseline and self.baseline.update:
            new = tuple(each for each in new if each.rule.fatal or each.severity is Severity.INFO)
        self.known += len(seen) - len(new)
        self.files += 1
        self.unreadable += loaded.unreadable
        self.unopened += loaded.unreadable and loaded.content is None
        self.counts.update(each.severity for each in new)
        least = Severity.INFO if self.notes else Severity.WARNING
        if any(each.rule.fix and each.severity >= least for each in new):
            from twinform.compiler.fixing import with_fixes  # noqa: PLC0415 - clean files need none

            new = with_fixes(replace(loaded, diagnostics=new), lambda each: each.severity >= least)
            self.fixes.update(each.fix.safety for each in new if each.fix)
        self._print(FileFindings(loaded.path, new), _files(loaded) if new else None)

    def _print(self, findings: FileFindings, files: "SourceFiles | None") -> None:
        if self.style in _FOR_PEOPLE:
            short = self.style == "concise"
            show(findings, notes=self.notes, on_stderr=self.on_stderr, every=self.every, short=short, files=files)
        elif self.style in _STREAMED:
            print_document(REPORTERS[self.style]([placed(findings, files)]))
        else:
            self.kept.append(placed(findings, files))

    def end(self) -> int:
        """Print what is left, and the summary; gives the exit code."""
        if self.style not in _STREAMED:
            print_document(REPORTERS[self.style](self.kept))
        news = self.baseline.write(complete=not self.unopened) if self.baseline else ""
        print_line(self._summary(), err=True)
        if news:
            print_line(news, err=True)
        if self.unreadable:
            return UNUSABLE
        return FINDINGS if self.counts[Severity.ERROR] else 0

    def _summary(self) -> str:
        found = ", ".join(_count(self.counts[severity], word) for severity, word in _WORDS.items())
        more = (
            (self.unreadable, "could not be read"),
            (self.allowed, "allowed"),
            (self.known, "in the baseline"),
            (self.fixed, "fixed"),
        )
        counts = "".join(f"; {count} {what}" for count, what in more if count)
        return f"{_count(self.files, 'file')}: {found}{counts}{self._fixable() if not self.fixed else ''}"

    def _fixable(self) -> str:
        """How many findings `--fix` would fix at most."""
        safe, unsafe = self.fixes[Safety.SAFE], self.fixes[Safety.UNSAFE]
        if safe and unsafe:
            return f"; {safe} fixable with --fix, {unsafe} more with --unsafe-fixes"
        if safe:
            return f"; {safe} fixable with --fix"
        return f"; {unsafe} fixable with --fix --unsafe-fixes" if unsafe else ""


def _files(loaded: LoadResult) -> "SourceFiles":
    """The files that the findings about one are about."""
    from twinform.compiler.input.source_files import SourceFiles  # noqa: PLC0415 - only findings have places

    return SourceFiles.of(loaded)


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
