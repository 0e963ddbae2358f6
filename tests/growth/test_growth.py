"""The work of each command grows in proportion to its file, whatever the file has many of."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from testbed.growth.documents import GrowingDocument, growing_documents, write_folder
from testbed.growth.work import COMMANDS, count_bytes, count_calls, growth
from tests.profile import DEEP

_STEEPEST = 1.15
"""The largest exponent that still counts as linear; sorting, which takes the logarithm more, is below it."""
_LINE_ENDS = {"on lines": "\n", "on one line": ""}


_DEAR = ("contact sensors", "numbers with tabs")
"""Documents for which something was copied in C once for each part of them."""


def _some() -> Iterator[tuple[GrowingDocument, str, str]]:
    """Each document with `check` and one more command."""
    for number, document in enumerate(growing_documents()):
        other = list(COMMANDS)[1:][number % (len(COMMANDS) - 1)]
        yield from ((document, command, list(_LINE_ENDS)[number % 2]) for command in ("check", other))


def _all() -> Iterator[tuple[GrowingDocument, str, str]]:
    """Each document with each command, on lines and on one line."""
    documents = growing_documents()
    return ((document, command, layout) for document in documents for command in COMMANDS for layout in _LINE_ENDS)


def _few() -> Iterator[tuple[GrowingDocument, str, str]]:
    return ((document, "check", "on one line") for document in growing_documents() if document.name in _DEAR)


def _name(tried: tuple[GrowingDocument, str, str]) -> str:
    document, command, layout = tried
    return f"{command}: {document.format}, {document.name}, {layout}"


@pytest.mark.parametrize("tried", [*(_all() if DEEP else _some())], ids=_name)
def test_work_is_linear(tried: tuple[GrowingDocument, str, str], tmp_path: Path):
    document, command, layout = tried
    assert growth(command, document, tmp_path, _LINE_ENDS[layout]) <= _STEEPEST


@pytest.mark.parametrize("tried", [*(_some() if DEEP else _few())], ids=_name)
def test_memory_that_is_allocated_is_linear(tried: tuple[GrowingDocument, str, str], tmp_path: Path):
    """What C copies for each part counts as one call, but needs memory; to count that takes ten times as long."""
    document, command, layout = tried
    assert growth(command, document, tmp_path, _LINE_ENDS[layout], count_bytes) <= _STEEPEST


def test_work_of_a_folder_is_linear(tmp_path: Path):
    _check_folder(tmp_path / "first", 1)  # imports and caches
    small, large = (_check_folder(tmp_path / str(size), size) for size in (40, 160))
    assert large / small <= (160 / 40) ** _STEEPEST


def _check_folder(folder: Path, size: int) -> int:
    # what other processes do would not be counted
    return count_calls("check", "--jobs", "1", "--no-cache", str(write_folder(folder, size)))
