"""What holds for every model, tried on models that Hypothesis makes up."""

from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.profile import examples
from twinform.compiler import check
from twinform.compiler.audit import audit
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Axis, Document, Format, Joint, Link, Mesh
from twinform.ir.frames import FrameGraph
from twinform.request_options import URDF_VERSIONS, UrdfVersion
from twinform.schemas import table
from twinform.testing import assert_round_trip, strategies

_SETTINGS = examples()


_OTHER: dict[Format, Literal["urdf", "sdf"]] = {Format.URDF: "sdf", Format.SDF: "urdf"}


def text_of(document: Document) -> str:
    sink = DiagnosticSink()
    text = emit(document, sink)
    assert sink.diagnostics == []
    return text


@_SETTINGS
@given(strategies.robots())
def test_urdf_to_ir_to_urdf_is_identity(robot: Document) -> None:
    assert twinform.loads(text_of(robot)) == robot


@_SETTINGS
@given(strategies.sdf_models())
def test_sdf_to_ir_to_sdf_is_identity(model: Document) -> None:
    assert twinform.loads(text_of(model)) == model


@_SETTINGS
@given(strategies.worlds())
def test_a_world_is_itself_once_read_again(world: Document) -> None:
    assert_round_trip(world)


@_SETTINGS
@given(strategies.robots())
def test_a_robot_comes_back_from_sdf(robot: Document) -> None:
    assert_round_trip(robot, via="sdf")


@_SETTINGS
@given(strategies.sdf_models())
def test_a_model_comes_back_from_urdf(model: Document) -> None:
    assert_round_trip(model, via="urdf")


@pytest.mark.parametrize("version", URDF_VERSIONS[1:])
def test_a_robot_of_a_newer_version_comes_back_from_sdf(version: UrdfVersion) -> None:
    @examples(0.4)
    @given(strategies.robots(version=version))
    def comes_back(robot: Document) -> None:
        assert twinform.loads(text_of(robot)) == robot
        assert_round_trip(robot, via="sdf")

    comes_back()


@pytest.mark.parametrize("version", table("sdf").versions)
def test_a_robot_comes_back_from_every_version_of_sdf(version: str) -> None:
    @examples(0.2)
    @given(strategies.robots(max_links=5))
    def comes_back(robot: Document) -> None:
        assert_round_trip(robot, via="sdf", sdf_version=version)

    comes_back()


@pytest.mark.parametrize("version", [each for each in table("sdf").versions if len(each) > 3 or each >= "1.8"])
def test_every_version_with_the_same_frames_is_itself_once_read_again(version: str) -> None:
    @examples(0.2)
    @given(strategies.sdf_models(version=version, max_links=5))
    def is_itself(model: Document) -> None:
        assert_round_trip(model)

    is_itself()


@examples(0.3)
@given(strategies.robots(max_links=5) | strategies.sdf_models(max_links=5), st.booleans())
def test_the_ledger_and_the_output_account_for_every_part(model: Document, carriers: bool) -> None:
    made = twinform.convert(text_of(model).encode(), to=_OTHER[model.format], carriers=carriers)
    assert made.source is not None
    assert [part.text for part in audit(made.source, made.text, made.ledger).unaccounted] == []


@_SETTINGS
@given(strategies.robots())
def test_json_is_the_same_document(robot: Document) -> None:
    assert twinform.loads(twinform.convert(text_of(robot).encode(), to="json").text) == robot


@_SETTINGS
@given(strategies.robots())
def test_every_robot_becomes_sdf_that_is_accepted_strictly(robot: Document) -> None:
    made = twinform.convert(text_of(robot).encode(), to="sdf")
    assert [each.message for each in check(made.text.encode(), strict=True).diagnostics if each.is_error] == []


@_SETTINGS
@given(strategies.sdf_models())
def test_every_model_becomes_urdf_that_is_accepted(model: Document) -> None:
    made = twinform.convert(text_of(model).encode(), to="urdf")
    assert [each.message for each in check(made.text.encode()).diagnostics if each.is_error] == []


def _places(document: Document, root: str) -> list[tuple[str, tuple[float, ...]]]:
    """The visuals of a model and where they are: link frames may move, shapes may not."""
    model = document.models[0]
    graph = FrameGraph(model)
    found: list[tuple[str, tuple[float, ...]]] = []
    for link in model.links:
        for visual in link.visuals:
            where = graph.resolve(visual.pose, link.name, root)
            shape = visual.geometry.shape if visual.geometry else None
            if isinstance(shape, Mesh):
                continue  # its URI is another one in SDF
            corners = (*where.apply((0, 0, 0)), *where.apply((1, 2, 3)))
            found.append((repr(shape), corners))
    return sorted(found)


@_SETTINGS
@given(strategies.robots())
def test_shapes_stay_where_they_are_on_the_way_to_sdf(robot: Document) -> None:
    made = twinform.convert(text_of(robot).encode(), to="sdf").document
    before, after = _places(robot, "link_0"), _places(made, "__model__")
    assert [shape for shape, _ in before] == [shape for shape, _ in after]
    for (_, place), (_, moved) in zip(before, after, strict=True):
        assert moved == pytest.approx(place, abs=1e-9)


@_SETTINGS
@given(strategies.robots())
def test_links_and_joints_come_back_by_name(robot: Document) -> None:
    sdf = twinform.convert(text_of(robot).encode(), to="sdf").text
    again = twinform.convert(sdf.encode(), to="urdf").document.models[0]

    def names(parts: tuple[Link, ...] | tuple[Joint, ...]) -> set[str]:
        return {part.name for part in parts}

    assert names(robot.models[0].links) <= names(again.links)


@_SETTINGS
@given(strategies.sdf_models())
def test_joints_of_sdf_come_back_with_their_axes(model: Document) -> None:
    urdf = twinform.convert(text_of(model).encode(), to="urdf").text
    again = twinform.convert(urdf.encode(), to="sdf").document.models[0]
    joints = {joint.name: joint for joint in again.joints}
    for joint in model.models[0].joints:
        if joint.type == "fixed":
            continue  # a link without mass on one is a frame
        back = joints[joint.name]
        assert (back.type, back.parent, back.child) == (joint.type, joint.parent, joint.child)
        assert [_direction(back.axis), _direction(back.axis2)] == [_direction(joint.axis), _direction(joint.axis2)]
        assert (back.screw_thread_pitch, back.thread_pitch) == (joint.screw_thread_pitch, joint.thread_pitch)


def _direction(axis: Axis | None) -> tuple[float, float, float] | None:
    return axis.xyz if axis else None
