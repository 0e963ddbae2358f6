"""The page about xacro lists what expressions may use, and what is refused, as it is."""

import re
from importlib import import_module
from pathlib import Path
from typing import Any

from twinform.compiler.input.xacro import budget, data_files, interpreter
from twinform.compiler.input.xacro.budget import Budget
from twinform.compiler.input.xacro.operations import METHODS
from twinform.compiler.input.xacro.vocabulary import math_functions, python_functions

_PAGE = Path(__file__).parents[5] / "docs" / "how-to" / "xacro.md"
_NAME = re.compile(r"`(\w+)`")
_LATER = frozenset({"cbrt", "exp2", "fma", "sumprod"})
"""Functions of `math` that not every version of Python has."""


def _cells(row: str) -> list[str]:
    (line,) = (line for line in _PAGE.read_text(encoding="utf-8").splitlines() if line.startswith(f"| {row} |"))
    return re.split(r"(?<!\\)\|", line)[2:]


def _names(text: str, after: str, until: str = "$") -> set[str]:
    match = re.search(f"{after}(.*?)(?:{until})", text)
    assert match
    return set(_NAME.findall(match[1]))


def test_the_methods_are_those_of_the_page() -> None:
    offered = _cells("methods")[0]
    assert _names(offered, "of texts:", "of lists") - {"name"} == set(METHODS[str])
    assert _names(offered, "of lists:", "of dictionaries") == set(METHODS[list])
    assert _names(offered, "of dictionaries:") == set(METHODS[dict])


def test_the_functions_are_those_of_the_page() -> None:
    offered, refused, *_ = _cells("functions")
    python, math = set(python_functions(Budget())), set(math_functions(Budget()))
    assert _names(offered, "of Python:", "of `math`") == python
    symbols: Any = vars(import_module("xacro"))["_global_symbols"]
    of_xacro = {name for space in ("math", "python") for name, value in symbols[space].items() if callable(value)}
    assert set(_NAME.findall(refused)) - _LATER == of_xacro - python - math - _LATER


def test_the_limits_are_those_of_the_page() -> None:
    page = _PAGE.read_text(encoding="utf-8")
    for number in (budget.MOST_STEPS, budget.MOST_BITS, budget.LONGEST_TEXT, budget.MOST_ITEMS, interpreter.LONGEST):
        assert f" {number:,} " in page
    assert data_files.LARGEST == 2**20
    assert budget.LARGEST_OUTPUT == 64 * 2**20
