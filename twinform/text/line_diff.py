"""The difference of two texts as a unified diff, which `patch` and `git apply` read."""

from collections.abc import Iterator
from difflib import unified_diff

from twinform.diagnostics.reporters import printable

_NO_END = "\n\\ No newline at end of file\n"


def line_diff(name: str, before: str, after: str) -> Iterator[str]:
    """The lines of the diff, with their line ends; none where both texts are equal."""
    if before != after:
        for line in unified_diff(_lines(before), _lines(after), printable(name), printable(name)):
            yield line if line.endswith("\n") else line + _NO_END


def _lines(text: str) -> list[str]:
    r"""The lines, ended by `\n` alone, as those programs see them."""
    lines = [f"{line}\n" for line in text.split("\n")]
    return [*lines[:-1], lines[-1][:-1]] if lines[-1] != "\n" else lines[:-1]
