"""Dependency files for make and Ninja: which files a result was made of."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar

from twinform.compiler.observing import observed

Result = TypeVar("Result")
_ESCAPES = str.maketrans({" ": "\\ ", "#": "\\#", "$": "$$"})


def read_by(work: Callable[[], Result]) -> tuple[Result, list[str]]:
    """Do some work; return its result, and the files that were read for it."""
    with observed() as seen:
        result = work()
    return result, sorted(path for path, status in seen.merged().read.items() if status is not None)


def depfile_text(target: Path, sources: Iterable[str | Path]) -> str:
    """Return a rule that says which files a result is made of, all by their absolute paths."""
    # make has no way to write the end of a line in a name, and Ninja none for what is no UTF-8
    names = [str(Path(each).absolute()) for each in dict.fromkeys(sources)]
    written = [each.translate(_ESCAPES) for each in names if each.isprintable()]
    return f"{str(target.absolute()).translate(_ESCAPES)}: {' '.join(written)}\n"
