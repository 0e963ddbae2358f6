"""A property that holds prints nothing, and one that does not gives the reason."""

from pathlib import Path
from typing import ClassVar

import pytest

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import FILLED_LIMIT
from twinform.ir import Document, map_children
from twinform.passes import Pass
from twinform.passes.limits.fill_limits import FillLimits
from twinform.testing import assert_pass_contract, assert_round_trip, assert_same_robot, assert_valid

ROVER = Path(__file__).parents[3] / "examples/rover.urdf"


class _Broken(Pass):
    name: ClassVar[str] = "broken"
    seen: ClassVar[list[int]] = []


class _Forgets(_Broken):
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        return map_children(document, lambda node: node.copy(links=()))


class _Counts(_Broken):
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        self.seen.append(1)
        return map_children(document, lambda node: node.copy(name=f"r{len(self.seen)}"))


class _Talks(_Broken):
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        self.seen.append(1)
        sink.report(FILLED_LIMIT, f"the {len(self.seen)}th time")
        return document


class _Grows(_Broken):
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        return map_children(document, lambda node: node.copy(name=f"{getattr(node, 'name', None)}x"))


FAULTS: dict[type[_Broken], str] = {
    _Forgets: "not valid",
    _Counts: "something else of the same document",
    _Talks: "reports something else",
    _Grows: "changes what it has made",
}


@pytest.mark.parametrize("broken", FAULTS)
def test_a_pass_that_breaks_its_contract_is_found(broken: type[_Broken]) -> None:
    with pytest.raises(AssertionError, match=FAULTS[broken]):
        assert_pass_contract(broken(), ROVER, idempotent=True)


def test_a_pass_that_keeps_it_gives_its_document() -> None:
    assert assert_pass_contract(FillLimits(), ROVER, idempotent=True) == assert_valid(ROVER)


@pytest.mark.parametrize("via", [None, "sdf", "json"])
def test_a_robot_comes_back(via: str | None) -> None:
    assert_round_trip(ROVER, via=via)  # pyright: ignore[reportArgumentType] - they are literals
    assert_round_trip(ROVER.read_text(), via=via)  # pyright: ignore[reportArgumentType] - as above


def test_another_robot_is_distinguished_from_it() -> None:
    assert_same_robot(ROVER, ROVER.read_bytes())
    with pytest.raises(AssertionError, match="not the same robot"):
        assert_same_robot(ROVER, ROVER.read_text().replace('radius="', 'radius="1'))


def test_a_model_with_an_error_is_reported() -> None:
    with pytest.raises(AssertionError, match="duplicate-name"):
        assert_valid('<robot name="r"><link name="a"/><link name="a"/></robot>')
