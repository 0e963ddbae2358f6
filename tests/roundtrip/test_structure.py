"""What holds for every change of a model's structure, tried on models that Hypothesis makes up."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import twinform
from tests.profile import examples
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Model, Pose
from twinform.ir.frames import MODEL, FrameGraph
from twinform.ir.solids import combined, placed
from twinform.ir.transform import Transform
from twinform.ir.verify import verify
from twinform.passes import Pass
from twinform.passes.shared.link_shapes import body_of
from twinform.passes.structure.flatten_models import FlattenModels
from twinform.passes.structure.lump_fixed_joints import LumpFixedJoints
from twinform.passes.structure.prefix_names import PrefixNames
from twinform.passes.structure.rename import Rename
from twinform.passes.structure.reroot import Reroot
from twinform.testing import strategies

_SETTINGS = examples(0.7)
_MODELS = strategies.robots() | strategies.sdf_models()
_TOLERANCE = 1e-9


def run(one: Pass, document: Document) -> Document:
    """The document after a pass, which must leave a valid one and have no errors."""
    sink, found = DiagnosticSink(), DiagnosticSink()
    made = one.run(document, sink)
    assert not sink.has_errors
    verify(made, found)
    assert not found.has_errors
    return made


def text(document: Document) -> bytes:
    return emit(document, DiagnosticSink()).encode()


def differences(one: Document, other: Document) -> list[str]:
    return [item.message for item in twinform.diff(text(one), text(other), carriers=True).differences]


def weight(document: Document) -> npt.NDArray[np.float64]:
    """Mass, first moments and inertia about the origin of the model."""
    model = document.models[0]
    graph = FrameGraph(model)
    parts = [placed(body_of(link, graph, document.format), place(graph, link.name)) for link in model.links]
    whole = combined(parts)
    return np.array([whole.mass, *(whole.mass * x for x in whole.center), *whole.inertia])


def place(graph: FrameGraph, name: str) -> Transform:
    return graph.pose(name, MODEL, base="model")


def places(model: Model, names: list[str]) -> npt.NDArray[np.float64]:
    graph = FrameGraph(model)
    found = [place(graph, name) for name in names]
    return np.array([[*each.translation, *each.rotation] for each in found])


def close(one: npt.NDArray[np.float64], other: npt.NDArray[np.float64]) -> bool:
    return bool(np.allclose(one, other, rtol=_TOLERANCE, atol=_TOLERANCE * max(1.0, float(np.abs(one).max()))))


@_SETTINGS
@given(_MODELS)
def test_lumping_keeps_mass_center_inertia_and_every_frame(model: Document) -> None:
    names = [link.name for link in model.models[0].links]
    lumped = run(LumpFixedJoints(), model)
    assert close(weight(model), weight(lumped))
    assert close(places(model.models[0], names), places(lumped.models[0], names))


@_SETTINGS
@given(_MODELS)
def test_a_lumped_robot_is_the_same_robot(model: Document) -> None:
    assert differences(model, run(LumpFixedJoints(), model)) == []


@_SETTINGS
@given(_MODELS)
def test_lumping_again_changes_nothing(model: Document) -> None:
    lumped = run(LumpFixedJoints(), model)
    assert LumpFixedJoints().run(lumped, DiagnosticSink()) is lumped


@_SETTINGS
@given(strategies.robots())
def test_lumping_as_libsdformat_does_keeps_mass_center_and_inertia(robot: Document) -> None:
    lumped = run(LumpFixedJoints(compat="libsdformat"), robot)
    left = {link.name for link in lumped.models[0].links}
    assert close(weight(robot), weight(lumped))
    assert close(places(robot.models[0], sorted(left)), places(lumped.models[0], sorted(left)))
    assert not [joint for joint in lumped.models[0].joints if joint.type == "fixed"]


@_SETTINGS
@given(_MODELS, st.integers(0, 7))
def test_reroot_and_back_is_the_same_robot(model: Document, pick: int) -> None:
    links = [link.name for link in model.models[0].links]
    new = links[pick % len(links)]
    sink = DiagnosticSink()
    rerooted = Reroot(link=new).run(model, sink)
    assume(not sink.has_errors)  # a joint with two axes on the way
    assert relative_places(model, new) == approximately(relative_places(rerooted, new))
    back = run(Reroot(link=root_of(model, new)), rerooted)
    assert [link.name for link in back.models[0].links] == links
    assert differences(model, back) == []


def root_of(document: Document, link: str) -> str:
    above = {joint.child: joint.parent for joint in document.models[0].joints}
    while link in above:
        link = above[link] or ""
    return link


def relative_places(document: Document, link: str) -> list[float]:
    """Where the links of the old robot are, seen from one of them."""
    model = document.models[0]
    graph = FrameGraph(model)
    names = sorted(each.name for each in model.links if "reversed" not in each.name)
    found = [graph.pose(name, link) for name in names]
    return [number for each in found for number in (*each.translation, *each.rotation)]


def approximately(numbers: list[float]) -> object:
    return pytest.approx(numbers, rel=_TOLERANCE, abs=1e-7)


@_SETTINGS
@given(_MODELS)
def test_renaming_by_a_bijection_and_back_is_the_identity(model: Document) -> None:
    there, back = Rename(names=("link_*:part_*", "joint_*:hinge_*")), Rename(names=("part_*:link_*", "hinge_*:joint_*"))
    assume(len(model.models[0].joints) > 0)
    assert run(back, run(there, model)) == model


@_SETTINGS
@given(_MODELS)
def test_a_prefix_changes_names_alone(model: Document) -> None:
    prefixed = run(PrefixNames(prefix="left_"), model)
    names = [link.name for link in model.models[0].links]
    assert close(places(model.models[0], names), places(prefixed.models[0], [f"left_{name}" for name in names]))
    assert run(Rename(names=("left_*:*",)), prefixed) == model


@pytest.mark.parametrize("separator", ["_", "::"])
@_SETTINGS
@given(
    outer=strategies.sdf_models(max_links=4),
    inner=strategies.sdf_models(max_links=4),
    pose=strategies.poses(whole=True),
)
def test_flattening_keeps_every_link_where_it_is(separator: str, outer: Document, inner: Document, pose: Pose) -> None:
    nested = inner.models[0].copy(name="inner", pose=pose)
    document = outer.copy(models=(outer.models[0].copy(models=(nested,)),))
    flat = run(FlattenModels(separator=separator), document)
    names = [f"inner::{link.name}" for link in nested.links]
    there = places(document.models[0], names)
    assert close(there, places(flat.models[0], [name.replace("::", separator) for name in names]))
