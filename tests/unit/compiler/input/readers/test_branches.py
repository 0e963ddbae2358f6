"""Branches of generated readers, and their guards on the version."""

import pytest

from twinform.compiler.input.readers.branches import Branch, chain, guard, merged
from twinform.schemas import Version

KNOWN: list[Version] = [(1, 0), (1, 1), (1, 2), (1, 3)]


@pytest.mark.parametrize(
    ("versions", "expected"),
    [
        ([(1, 0), (1, 1)], "reading.version <= (1, 1)"),
        ([(1, 2), (1, 3)], "reading.version >= (1, 2)"),
        ([(1, 1), (1, 2)], "(1, 1) <= reading.version <= (1, 2)"),
        ([(1, 0), (1, 3)], "(reading.version <= (1, 0) or reading.version >= (1, 3))"),
    ],
)
def test_a_guard_names_the_ends_of_what_it_lets_through(versions: list[Version], expected: str) -> None:
    assert guard(versions, KNOWN) == expected


def test_branches_that_are_alike_are_one() -> None:
    old, new = (Branch(("a",), "do()", frozenset(KNOWN[part])) for part in (slice(2), slice(2, None)))
    other = Branch(("b", "c"), "be()", frozenset(KNOWN[2:]))
    together = merged([old, other, new])
    assert chain(together, KNOWN) == "if a:\n    do()\nelif b and reading.version >= (1, 2) and c:\n    be()"
