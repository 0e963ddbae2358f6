"""The reference of the Python API: every name in it is there, and what is public is in it."""

import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

import twinform.ir
from twinform.ir import Node

_PAGES = sorted((Path(__file__).parents[1] / "docs/reference").glob("*.md"))
_NAMES = [name for page in _PAGES for name in re.findall(r"(?m)^::: ([\w.]+)$", page.read_text(encoding="utf-8"))]
_ELSEWHERE = {
    "twinform.report.WRITERS": "a table of two functions that are there",
    "twinform.report.Shown": "what `show` gives notebooks",
    "twinform.view.PortTakenError": "a ViewError",
    "twinform.view.ViewSubject": "what `read_subject` gives to the viewer",
    "twinform.view.ViewerMissingError": "a ViewError",
    "twinform.testing.CaseCheckOptions": "a part of a `Case`",
    "twinform.testing.Finding": "a part of a `Case`",
}


def _public(module: str) -> list[str]:
    return [f"{module}.{name}" for name in import_module(module).__all__]


def test_the_reference_names_nothing_twice() -> None:
    assert len(_NAMES) == len({*_NAMES}) > 80


@pytest.mark.parametrize("name", _NAMES)
def test_what_is_in_the_reference_is_there_and_documented(name: str) -> None:
    module, _, attribute = name.rpartition(".")
    found = import_module(name) if name == "twinform.testing.strategies" else getattr(import_module(module), attribute)
    assert inspect.getdoc(found)


@pytest.mark.parametrize("module", ["twinform", "twinform.report", "twinform.view", "twinform.testing"])
def test_what_a_package_offers_is_in_the_reference(module: str) -> None:
    documents = {"twinform.Document"}  # a node, on the page of nodes
    assert {*_public(module)} - {*_NAMES} - documents - _ELSEWHERE.keys() == set()


def test_every_node_is_in_the_reference() -> None:
    nodes = [name for name in twinform.ir.__all__ if isinstance(kind := getattr(twinform.ir, name), type)
             and issubclass(kind, Node) and kind is not Node]  # fmt: skip
    assert len(nodes) > 30
    assert [name for name in nodes if f"twinform.ir.{name}" not in _NAMES] == []
