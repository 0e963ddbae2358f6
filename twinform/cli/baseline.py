"""`--baseline` and `--update-baseline`."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from twinform.cli.config import settings_of
from twinform.cli.failure import Unusable
from twinform.file_access import OutsideError, Readable

if TYPE_CHECKING:
    from twinform.diagnostics.baseline import Baseline

Command = TypeVar("Command", bound=Callable[..., Any])


def baseline_options(command: Command) -> Command:
    """Give a command `--baseline FILE` and `--update-baseline`."""
    command = click.option(
        "--update-baseline", is_flag=True, help="Write what is found now into the baseline, and report none of it."
    )(command)
    return click.option(
        "--baseline",
        "baseline",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="FILE",
        help="Findings that are known, and are not reported; else that of the configuration.",
    )(command)


class BaselineFile:
    """The baseline of a run, in its file."""

    def __init__(self, file: Path, *, update: bool) -> None:
        """Read it; where it is to be updated, it need not be there.

        Raises:
            Unusable: it cannot be read, or is no baseline.
        """
        from twinform.diagnostics.baseline import BaselineRun  # noqa: PLC0415 - few runs have one

        self.file, self.update = file, update
        self.folder = os.path.abspath(file.parent)  # noqa: PTH100 - links stay links
        self.run = BaselineRun(_read(file, missing_ok=update), self._relative)

    def _relative(self, name: str) -> str:
        if name.startswith("<"):
            return name  # what is no file
        return os.path.relpath(os.path.abspath(name), self.folder).replace(os.sep, "/")  # noqa: PTH100 - as above

    def write(self, *, complete: bool) -> str:
        """Write what was found, if that was asked for and is complete; gives the news.

        Raises:
            Unusable: the file cannot be written.
        """
        if not self.update:
            return _gone(self.run.gone)
        if not complete:
            return f"{self.file} stays as it is, since not every file could be read"
        from twinform.compiler import write_atomically  # noqa: PLC0415 - few runs write one

        made = self.run.updated(lambda name: name.startswith("<") or _is_there(Path(self.folder, name)))
        try:
            write_atomically(self.file, made.to_json())
        except OSError as error:
            raise Unusable(f"cannot write {self.file}: {error.strerror}") from error
        count = sum(made.counts.values())
        return f"{self.file}: {count} finding{'' if count == 1 else 's'}"


def _is_there(path: Path) -> bool:
    """Whether there is a file, or something that keeps us from knowing."""
    try:
        path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    except OSError:
        return True
    return True


def _gone(count: int) -> str:
    if not count:
        return ""
    entries = "1 entry of the baseline does" if count == 1 else f"{count} entries of the baseline do"
    return f"{entries} not occur any more: --update-baseline takes {'it' if count == 1 else 'them'} out"


def baseline_of(ctx: click.Context, file: Path | None, *, update: bool) -> BaselineFile | None:
    """The baseline of a run, of the option or else of the project.

    Raises:
        click.UsageError: it is to be updated, and there is none.
        Unusable: it cannot be read.
    """
    file = file or settings_of(ctx).baseline_file
    if file is None and update:
        raise click.UsageError("--update-baseline needs --baseline FILE, or a baseline in the configuration")
    return BaselineFile(file, update=update) if file else None


def _read(file: Path, *, missing_ok: bool) -> "Baseline":
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
