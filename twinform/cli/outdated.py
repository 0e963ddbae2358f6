"""`--check`: whether the files that a command would write are what it would write."""

from collections.abc import Sequence
from pathlib import Path

import click

from twinform.cli.failure import FINDINGS, Unusable
from twinform.cli.printing import print_line
from twinform.file_access import Readable
from twinform.text.source_text import line_diff

_MOST_LINES = 400
"""Lines of a difference that are printed."""


def report_outdated(texts: Sequence[tuple[Path, str | bytes]], *, to_stdout: bool) -> int:
    """Print how files differ from these texts; gives the exit code.

    Raises:
        click.UsageError: something goes to standard output, where nothing is to compare.
        Unusable: a file cannot be read.
    """
    if to_stdout:
        raise click.UsageError("--check compares files: name one with -o")
    outdated = [path for path, text in texts if _differs(path, text)]
    for path in outdated:
        why = "is not what it is made to be" if path.exists() else "is not there"
        print_line(f"{path} {why}; run the command without --check", err=True)
    if not outdated:
        print_line(f"{_count(len(texts), 'file')} up to date", err=True)
    return FINDINGS if outdated else 0


def _differs(path: Path, text: str | bytes) -> bool:
    new = text.encode() if isinstance(text, str) else text
    try:
        old = Readable.of(path).read(path)
    except FileNotFoundError:
        return True
    except OSError as error:
        raise Unusable(f"cannot read {path}: {error.strerror}") from error
    if old == new:
        return False
    lines = list(line_diff(str(path), old.decode(errors="replace"), new.decode(errors="replace")))
    for line in lines[:_MOST_LINES]:
        print_line(line.rstrip())
    if len(lines) > _MOST_LINES:
        print_line(f"... and {len(lines) - _MOST_LINES} lines more")
    return True


def _count(number: int, word: str) -> str:
    return f"{number} {word}{' is' if number == 1 else 's are'}"
