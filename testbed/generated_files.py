"""Files that are committed and made by a program: how they are written, or compared with what they should be."""

import sys
from collections.abc import Mapping
from pathlib import Path

from twinform.storage.writing import write_all_atomically

_MARK = "<!-- Made by `make generate`; do not edit. -->"
"""Says to whoever opens the file of a page that it is made, and not to who reads the page."""


def marked(texts: Mapping[Path, str]) -> dict[Path, str]:
    """Return the texts of files, pages with a mark below their titles."""
    return {file: _with_mark(text) if file.suffix == ".md" else text for file, text in texts.items()}


def write(texts: Mapping[Path, str]) -> None:
    """Write the files, and delete pages beside them that are not made any more."""
    for file in _left_over(texts):
        file.unlink()
    for file in texts:
        file.parent.mkdir(parents=True, exist_ok=True)
    write_all_atomically(texts)


def out_of_date(texts: Mapping[Path, str]) -> list[Path]:
    """Return the files that `write` would change or delete, and name them on standard error."""
    changed = [file for file, text in texts.items() if not file.is_file() or file.read_text(encoding="utf-8") != text]
    found = [*_left_over(texts), *changed]
    for file in found:
        sys.stderr.write(f"{file} is out of date; run `make generate`\n")
    return found


def _left_over(texts: Mapping[Path, str]) -> list[Path]:
    """Return the pages that were made, in folders in which several are, and are not among the texts."""
    pages = [file for file in texts if file.suffix == ".md"]
    folders = dict.fromkeys(file.parent for file in pages) if len(pages) > 1 else {}
    beside = (file for folder in folders for file in sorted(folder.glob("*.md")) if file not in texts)
    return [file for file in beside if _MARK in file.read_text(encoding="utf-8")]


def _with_mark(page: str) -> str:
    title, _, rest = page.partition("\n")
    return f"{title}\n\n{_MARK}\n{rest}"
