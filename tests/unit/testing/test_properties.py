"""A property that holds prints nothing, and one that does not gives the reason."""

from pathlib import Path
from typing import ClassVar

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import FILLED_LIMIT
from twinform.ir import Document, map_children
from twinform.passes import Pass
from twinform.passes.joints.fill_limits import FillLimits
from twinform.testing import assert_pass_contract, assert_round_trip, assert_same_robot, assert_valid
from twinform.testing.properties import ANOTHER_ROBOT, RoundTrip

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


@pytest.mark.parametrize("via", [None, "sdf", "mjcf", "json"])
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


URDF = """<robot name="r" version="1.1">
  <link name="a"/>
  <link name="b"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/></joint>
</robot>"""
MODEL = '<model name="{}"><link name="l"><pose>0 0 {} 0 0 0</pose></link></model>'
WORLD = f'<sdf version="1.6"><world name="w">{MODEL.format("m", 1)}{MODEL.format("n", 2)}</world></sdf>'


def _trip(text: str, model: str | None = None) -> RoundTrip:
    return RoundTrip.of(text.encode(), twinform.loads(text), model=model)


def test_what_comes_back_as_it_was_has_no_mismatch() -> None:
    assert list(_trip(URDF).mismatches(URDF.replace("1 0 0", "1.0 0 0"))) == []


def test_another_robot_is_found_first_and_then_the_parts_that_make_it() -> None:
    robot, place = _trip(URDF).mismatches(URDF.replace("1 0 0", "1 0 0.5"))
    assert robot.kind == ANOTHER_ROBOT
    assert "0.5" in robot.message
    assert (place.kind, place.path) == ("changed", "/robot[@name='r']/joint[@name='j']/origin")


def test_a_name_that_nobody_gave_is_found() -> None:
    (found,) = _trip(URDF).mismatches(
        URDF.replace('<link name="a"/>', '<link name="a"><tf:x xmlns:tf="urn:twinform:1"/></link>')
    )
    assert (found.kind, found.path) == ("left over", "/robot[@name='r']/link[@name='a']/tf:x")


def test_of_a_world_the_model_alone_has_to_come_back() -> None:
    text = _trip(WORLD, "w::n").text.decode()
    assert ['"n"' in text, '"m"' in text, "world" in text] == [True, False, False]
    assert list(_trip(WORLD, "n").mismatches(f'<sdf version="1.6">{MODEL.format("n", 2)}</sdf>')) == []


@pytest.mark.parametrize("version", ["1.4", "1.6", "1.9", "1.12"])
def test_it_comes_back_in_the_version_that_it_went_in(version: str) -> None:
    text = f'<sdf version="{version}">{MODEL.format("m", 1)}</sdf>'
    back = _trip(text).back(twinform.convert(text.encode(), to="urdf").text)
    assert twinform.loads(back).version == version


def test_urdf_comes_back_in_its_version_too() -> None:
    assert 'version="1.1"' in _trip(URDF).back(twinform.convert(URDF.encode(), to="sdf").text)


def test_what_does_not_come_back_as_it_was_fails_the_round_trip(monkeypatch: pytest.MonkeyPatch) -> None:
    assert_round_trip(URDF, via="sdf")

    def rename(*_: object) -> str:
        return URDF.replace('"j"', '"k"')

    monkeypatch.setattr(RoundTrip, "back", rename)
    with pytest.raises(AssertionError, match=r"as it was:(.|\n)*<joint name=\"j\" type=\"fixed\"> is not back"):
        assert_round_trip(URDF, via="sdf")


def test_what_is_refused_in_the_conversion_back_fails_the_round_trip(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> str:
        return twinform.convert(b"<robot/>", to="urdf").text

    monkeypatch.setattr(RoundTrip, "back", refuse)
    with pytest.raises(AssertionError, match="does not come back from sdf:"):
        assert_round_trip(URDF, via="sdf")
