"""Command line of generators: write a generated file, or check that the committed one is up to date."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from twinform.storage.writing import write_atomically


def main(text: str, arguments: Sequence[str]) -> int:
    """The command line of a generator: print the text, write it to a file or compare it with one.

    Returns:
        The exit code.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path, nargs="?", help="where to write; standard output where it is not given")
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where the file is out of date")
    given = parser.parse_args(arguments)
    if given.check and given.file is None:
        parser.error("--check needs a file")
    if given.check:
        return _check(given.file, text)
    if given.file is None:
        sys.stdout.write(text)
    else:
        write_atomically(given.file, text)
    return 0


def _check(file: Path, text: str) -> int:
    if file.is_file() and file.read_text(encoding="utf-8") == text:
        return 0
    sys.stderr.write(f"{file} is out of date; run the generator without --check\n")
    return 1
