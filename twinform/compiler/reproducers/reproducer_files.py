"""Reproducer files: written where a pass fails, read by `twinform reproduce`."""

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from twinform import __version__
from twinform.compiler.reproducers.reproducer import Reproducer
from twinform.file_access import Readable
from twinform.passes import PassError
from twinform.storage.staging import temporary_folder
from twinform.storage.writing import write_new_file

_UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")
# Characters of a model's name in a file name: file systems take 255 bytes in all.
_LONGEST = 60
_MOST = 1000
"""Files of one name; more are somebody's mistake."""


def write_reproducer(error: PassError, source: str, folder: Path | None = None) -> Path:
    """Write a reproducer, and return its path.

    It goes into the folder, or the current one; where that cannot be written, into the one for temporary files. Nothing
    is overwritten.

    Raises:
        OSError: it cannot be written.
        TypeError: the pass has an option that the text of a pipeline cannot express.
        ValueError: what the pass was given is no document of the IR.
    """
    text = Reproducer.of(error, source, __version__).to_json()
    stem = f"twinform-{error.name}-{_stem(source)}"
    problem: OSError | None = None
    for each in _folders(folder):
        try:
            return _write_new(each, stem, text)
        except OSError as error_:
            problem = error_
    raise problem or FileNotFoundError(str(folder))


def _folders(folder: Path | None) -> Iterator[Path]:
    yield folder or Path()
    if folder is None:
        yield temporary_folder()


def _stem(source: str) -> str:
    """The name of the source without its endings, of what is no file `document`."""
    return _UNSAFE.sub("_", Path(source).name.partition(".")[0])[:_LONGEST].strip("_") or "document"


def _write_new(folder: Path, stem: str, text: str) -> Path:
    for path in _names(folder, stem):
        if os.path.lexists(path):
            continue
        with suppress(FileExistsError):  # another process was faster
            write_new_file(path, text)
            return path
    raise FileExistsError(f"there are {_MOST} files called {stem}")


def _names(folder: Path, stem: str) -> Iterator[Path]:
    yield folder / f"{stem}.json"
    yield from (folder / f"{stem}-{number}.json" for number in range(2, _MOST + 1))


def read_reproducer(path: Path) -> Reproducer:
    """The reproducer in a file.

    Raises:
        OSError: it cannot be read.
        ValueError: it is no reproducer.
    """
    return Reproducer.model_validate_json(Readable.of(path).read(path))
