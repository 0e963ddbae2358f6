"""The report of `twinform check`: what it prints file by file, the exit code, and the baseline of known findings."""

import os
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Unusable, combine_options
from twinform.cli.config import settings_of
from twinform.cli.printing import locate, plural, print_document, print_line, show
from twinform.compiler import LoadResult
from twinform.diagnostics import Policy, Safety, Severity
from twinform.diagnostics.reporters import REPORTERS, FileFindings
from twinform.file_access import OutsideError, Readable

if TYPE_CHECKING:
    from twinform.compiler.input.source_files import SourceFiles
    from twinform.diagnostics.baseline import Baseline


baseline_options = combine_options(
    click.option(
        "--baseline",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="Findings that are known, and are not reported; else that of the configuration.",
    ),
    click.option(
        "--update-baseline", is_flag=True, help="Write what is found now into the baseline, and report none of it."
    ),
)
"""Gives a command `--baseline FILE` and `--update-baseline`."""


class BaselineFile:
    """The baseline of a run, and its file."""

    def __init__(self, file: Path, *, update: bool) -> None:
        """Read the file, which may be missing if it is to be updated.

        Raises:
            Unusable: it cannot be read, or is no baseline.
        """
        from twinform.diagnostics.baseline import BaselineRun  # noqa: PLC0415 - few runs have one

        self.file, self.update = file, update
        self.folder = os.path.abspath(file.parent)  # noqa: PTH100 - links stay links
        self.run = BaselineRun(_read_baseline(file, missing_ok=update), self._relative)

    def _relative(self, name: str) -> str:
        if name.startswith("<"):
            return name  # not a file
        return os.path.relpath(os.path.abspath(name), self.folder).replace(os.sep, "/")  # noqa: PTH100 - as above

    def write(self, *, complete: bool) -> str:
        """Update the file, if that was asked for and all files were read; return a message.

        Raises:
            Unusable: the file cannot be written.
        """
        if not self.update:
            return _count_gone(self.run.gone)
        if not complete:
            return f"{self.file} stays as it is, since not every file could be read"
        from twinform.compiler import write_atomically  # noqa: PLC0415 - few runs write one

        made = self.run.updated(lambda name: name.startswith("<") or _is_there(Path(self.folder, name)))
        try:
            write_atomically(self.file, made.to_json())
        except OSError as error:
            raise Unusable(f"cannot write {self.file}: {error.strerror}") from error
        return f"{self.file}: {plural(sum(made.counts.values()), 'finding')}"


def _is_there(path: Path) -> bool:
    """Whether there is a file; also True if that cannot be found out."""
    try:
        path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    except OSError:
        return True
    return True


def _count_gone(count: int) -> str:
    if not count:
        return ""
    entries = "1 entry of the baseline does" if count == 1 else f"{count} entries of the baseline do"
    return f"{entries} not occur any more: --update-baseline takes {'it' if count == 1 else 'them'} out"


def baseline_of(ctx: click.Context, file: Path | None, *, update: bool) -> BaselineFile | None:
    """Return the baseline of the option, or else of the project.

    Raises:
        click.UsageError: it is to be updated, and no file is named.
        Unusable: it cannot be read.
    """
    file = file or settings_of(ctx).baseline_file
    if file is None and update:
        raise click.UsageError("--update-baseline needs --baseline FILE, or a baseline in the configuration")
    return BaselineFile(file, update=update) if file else None


def _read_baseline(file: Path, *, missing_ok: bool) -> "Baseline":
    from twinform.diagnostics.baseline import Baseline, BaselineError  # noqa: PLC0415 - few runs have one

    try:
        return Baseline.parse(Readable.of(file).read(file).decode("utf-8-sig"))
    except FileNotFoundError as error:
        if missing_ok:
            return Baseline()
        raise Unusable(f"there is no baseline {file}: --update-baseline makes it") from error
    except OSError as error:
        advice = f"; {error.help}" if isinstance(error, OutsideError) else ""
        raise Unusable(f"cannot read {file}: {error.strerror}{advice}") from error
    except UnicodeDecodeError as error:
        raise Unusable(f"{file}: this is no baseline: it is not in UTF-8") from error
    except BaselineError as error:
        raise Unusable(f"{file}:{error.line}: {error}" if error.line else f"{file}: {error}") from error


_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_FOR_PEOPLE = frozenset({"text", "concise"})
_STREAMED = _FOR_PEOPLE | {"github"}
"""Formats that are printed file by file; the others are one document."""


class CheckReport:
    """The report of a run in one format; it keeps no models, since there may be thousands."""

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
        # the baseline of a file that cannot be read stays as it is
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
        self._print(FileFindings(loaded.path, new), _source_files(loaded) if new else None)

    def _print(self, findings: FileFindings, files: "SourceFiles | None") -> None:
        if self.style in _FOR_PEOPLE:
            short = self.style == "concise"
            show(findings, notes=self.notes, on_stderr=self.on_stderr, every=self.every, short=short, files=files)
        elif self.style in _STREAMED:
            print_document(REPORTERS[self.style]([locate(findings, files)]))
        else:
            self.kept.append(locate(findings, files))

    def end(self) -> int:
        """Print the rest and the summary; return the exit code."""
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
        found = ", ".join(plural(self.counts[severity], word) for severity, word in _WORDS.items())
        more = (
            (self.unreadable, "could not be read"),
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


def _source_files(loaded: LoadResult) -> "SourceFiles":
    """Return the texts of a file and of its includes."""
    from twinform.compiler.input.source_files import SourceFiles  # noqa: PLC0415 - only findings have places

    return SourceFiles.of(loaded)
