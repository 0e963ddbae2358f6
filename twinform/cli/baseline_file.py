"""The baselines of a run of `check`: findings that are known, of the option or of each project."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from twinform.cli.command import Unusable
from twinform.cli.flags import group
from twinform.dataclass import dataclass
from twinform.diagnostics.wording import plural
from twinform.file_access import OutsideError, Readable

if TYPE_CHECKING:
    from collections.abc import Callable

    from twinform.diagnostics.baseline import Baseline


class KnownOptions(NamedTuple):
    """The file of findings that are known, and whether it is written anew."""

    baseline: Path | None = None
    update_baseline: bool = False


baseline_options = group(
    "known",
    KnownOptions,
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
"""Gives a command `--baseline FILE` and `--update-baseline`, as `known`."""


@dataclass(frozen=True, slots=True)
class RelativeNames:
    """Gives the names of files relative to the folder of a baseline."""

    folder: str

    def __call__(self, name: str, /) -> str:
        """Return a name with `/` between its parts; that of a stream stays as it is."""
        if name.startswith("<"):
            return name
        return os.path.relpath(os.path.abspath(name), self.folder).replace(os.sep, "/")  # noqa: PTH100 - links stay links


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
        self.run = BaselineRun(_read_baseline(file, missing_ok=update), RelativeNames(self.folder))

    def write(self) -> str:
        """Update the file, if that was asked for; return a message.

        Raises:
            Unusable: the file cannot be written.
        """
        if not self.update:
            return _count_gone(self.run.gone)
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


class Baselines:
    """The baseline that counts for each file: the one that was named, or else that of its project."""

    def __init__(self, options: KnownOptions, of_project: "Callable[[str], Path | None]") -> None:
        self._named, self.update = options
        self._of_project = of_project
        self._known: dict[Path, BaselineFile] = {}

    def of(self, name: str) -> BaselineFile | None:
        """Return the baseline for a file.

        Raises:
            click.UsageError: it is to be updated, and there is none.
            Unusable: it cannot be read.
        """
        file = self._named or self._of_project(name)
        if file is None:
            if self.update:
                raise click.UsageError("--update-baseline needs --baseline FILE, or a baseline in the configuration")
            return None
        if file not in self._known:
            self._known[file] = BaselineFile(file, update=self.update)
        return self._known[file]

    def write(self) -> list[str]:
        """Update the files, if that was asked for; return messages.

        Raises:
            Unusable: a file cannot be written.
        """
        return [news for each in self._known.values() if (news := each.write())]


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
