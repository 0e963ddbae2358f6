"""Command line of generators: write a generated file or folder, or check that the committed one is up to date."""

import argparse
import sys
from collections.abc import Mapping, Sequence
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
    if given.file is None:
        sys.stdout.write(text)
        return 0
    if given.file.suffix == ".md":
        text = _marked(text)
    if given.check:
        return _check(given.file, text)
    write_atomically(given.file, text)
    return 0


def main_of_folder(pages: Mapping[str, str], arguments: Sequence[str]) -> int:
    """The command line of a generator of all Markdown files of a folder: write them, delete all others, or compare.

    Args:
        pages: The texts by the names of their files.
        arguments: The words of the command line.

    Returns:
        The exit code.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path, help="where to write")
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 where a file is out of date")
    given = parser.parse_args(arguments)
    folder: Path = given.folder
    pages = {name: _marked(text) for name, text in pages.items()}
    others = [file for file in folder.glob("*.md") if file.name not in pages]
    if given.check:
        for file in others:
            sys.stderr.write(f"{file} is not generated any more; run the generator without --check\n")
        return max([min(len(others), 1), *(_check(folder / name, text) for name, text in pages.items())])
    folder.mkdir(parents=True, exist_ok=True)
    for file in others:
        file.unlink()
    for name, text in pages.items():
        write_atomically(folder / name, text)
    return 0


def _marked(page: str) -> str:
    """Say to whoever opens the file of a page that it is made, and not to who reads the page."""
    title, _, rest = page.partition("\n")
    return f"{title}\n\n<!-- Made by `make generate`; do not edit. -->\n{rest}"


def _check(file: Path, text: str) -> int:
    if file.is_file() and file.read_text(encoding="utf-8") == text:
        return 0
    sys.stderr.write(f"{file} is out of date; run the generator without --check\n")
    return 1
