"""A file of MJCF in the terms of SDF: world or model, names, remainders, and nothing that is forgotten."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import pytest
from lxml import etree

import twinform
from twinform.compiler.input.load_options import FileOptions, LoadOptions
from twinform.compiler.input.mjcf.lower import FileLowering
from twinform.compiler.input.mjcf.model_trees import WrittenModels
from twinform.compiler.input.mjcf.normalize import normalize
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Document, Element, Model, Node
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.legalise.to_mjcf.kept_mjcf import ROOT
from twinform.schemas import Context

_CASES = sorted((Path(__file__).parents[4] / "cases/from_mjcf").glob("*.mjcf"))
_INERTIAL = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
_BODY = f'<body name="a">{_INERTIAL}</body>'
_FLOOR = '<geom name="floor" type="plane" size="1 1 0.1"/>'


def lowered(content: str, model: str = "m") -> Document:
    """The document of a file with something in `worldbody`, or with other sections behind it."""
    worldbody, _, rest = content.partition("|")
    text = f'<compiler angle="radian"/><worldbody>{worldbody}</worldbody>{rest}'
    return twinform.loads(f'<mujoco model="{model}">{text}</mujoco>')


def robot(content: str) -> Model:
    """The first model of a file that is no scenery."""
    document = lowered(content)
    models = [*document.models, *(each for world in document.worlds for each in world.models)]
    return next(each for each in models if each.name != "worldbody")


def kept(node: Node) -> Iterator[Element]:
    """What a node keeps of MJCF, beside the note that it was read of it."""
    for part in node.opaque:
        if part.element is not None and part.element.name == f"{{{NAMESPACE}}}mjcf":
            yield from (each for each in part.element.children if each.name != ROOT)


@pytest.mark.parametrize("content", [_BODY, f'{_BODY}<light name="sun"/>', f'{_BODY}<site name="s"/>'])
def test_a_file_with_one_tree_alone_is_a_model_of_its_name(content: str) -> None:
    document = lowered(content)
    assert [(each.name, each.static) for each in document.models] == [("m", True)]
    assert not document.worlds


def test_what_a_model_has_no_place_for_is_kept() -> None:
    (model,) = lowered(f'{_BODY}<light name="sun"/>').models
    assert [child.name for each in kept(model) for child in each.children] == ["light"]


@pytest.mark.parametrize(
    ("content", "models"),
    [
        (f"{_FLOOR}{_BODY}", ["worldbody", "m"]),
        (f'{_BODY}<body name="b">{_INERTIAL}</body>', ["a", "b"]),
        (_FLOOR, ["worldbody"]),
        ("", []),
    ],
)
def test_any_other_file_is_a_world(content: str, models: list[str]) -> None:
    (world,) = lowered(content).worlds
    assert world.name == "m"
    assert [each.name for each in world.models] == models


def test_the_floor_is_no_robot() -> None:
    text = f'<mujoco model="m"><worldbody>{_FLOOR}{_BODY}</worldbody></mujoco>'
    assert twinform.convert(text.encode(), to="urdf").document.models[0].name == "m"


def test_gravity_and_time_step_of_a_world_are_those_of_mujoco() -> None:
    (world,) = lowered(_FLOOR).worlds
    assert world.gravity == (0.0, 0.0, -9.81)
    texts = [each.element.children[0].text for each in world.opaque if each.element and each.element.name == "physics"]
    assert texts == ["0.002"]


@pytest.mark.parametrize(
    ("joint", "parent", "static"),
    [("", None, True), ("<freejoint/>", None, None), ('<joint type="free"/>', None, None), ("<joint/>", "world", None)],
)
def test_a_root_is_fixed_free_or_on_a_joint(joint: str, parent: str | None, static: bool | None) -> None:
    model = robot(f'{_FLOOR}<body name="a">{joint}{_INERTIAL}</body>')
    assert [each.parent for each in model.joints] == ([parent] if parent else [])
    assert model.static is static


def test_a_root_without_joint_is_fixed_to_the_world_where_something_moves() -> None:
    model = robot(f'<body name="a">{_INERTIAL}<body name="b"><joint/>{_INERTIAL}</body></body>')
    assert [(each.type, each.parent) for each in model.joints] == [("fixed", "world"), ("revolute", "a")]


def test_several_joints_are_a_chain_in_their_order() -> None:
    joints = '<joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/><joint name="z"/>'
    model = robot(f'<body name="a">{joints}{_INERTIAL}</body>')
    ends = [(each.name, each.parent, each.child) for each in model.joints]
    assert ends == [("x", "world", "x_link"), ("y", "x_link", "y_link"), ("z", "y_link", "a")]


@pytest.mark.parametrize(
    ("written", "lower", "upper"),
    [
        ('limited="true" range="-1 2"', -1.0, 2.0),
        ('range="-1 2"', -1.0, 2.0),
        ('limited="false" range="-1 2"', None, None),
        ('limited="true" range="-1 2" ref="0.5"', -1.5, 1.5),
        ("", None, None),
    ],
)
def test_a_range_counts_from_the_drawn_position(written: str, lower: float | None, upper: float | None) -> None:
    (joint,) = robot(f'<body name="a"><joint {written}/>{_INERTIAL}</body>').joints
    limit = joint.axis.limit if joint.axis else None
    assert ((limit.lower, limit.upper) if limit else (None, None)) == (lower, upper)


@pytest.mark.parametrize(
    ("actuator", "effort"),
    [
        ('<motor joint="j" gear="10" ctrllimited="true" ctrlrange="-1 0.5"/>', 10.0),
        ('<position joint="j" forcelimited="true" forcerange="-3 4"/>', 4.0),
        (
            (
                '<motor joint="j" ctrllimited="true" ctrlrange="-1 1"/>'
                '<motor joint="j" ctrllimited="true" ctrlrange="0 2"/>'
            ),
            3.0,
        ),
        ('<motor joint="j" ctrllimited="true" ctrlrange="-1 1"/><motor joint="j"/>', None),
        ('<motor joint="j"/>', None),
    ],
)
def test_actuators_limit_the_effort_of_a_joint_which_has_no_limit_itself(actuator: str, effort: float | None) -> None:
    (joint,) = robot(f'<body name="a"><joint name="j"/>{_INERTIAL}</body>|<actuator>{actuator}</actuator>').joints
    limit = joint.axis.limit if joint.axis else None
    assert (limit.effort if limit else None) == effort
    says_so = [each.get("actuatorfrclimited") for each in kept(joint)]
    assert says_so == (["false"] if effort else [])


@pytest.mark.parametrize(
    ("equality", "follows"),
    [
        ('<joint joint1="j" joint2="i" polycoef="1 2 0 0 0"/>', (2.0, 1.0)),
        ('<joint joint1="j" joint2="i"/>', (1.0, None)),
        ('<joint joint1="j" joint2="i" polycoef="0 1 0.5 0 0"/>', None),
        ('<joint joint1="j" joint2="i" active="false"/>', None),
        ('<joint joint1="j"/>', None),
    ],
)
def test_a_linear_equality_is_a_mimic_and_any_other_is_kept(
    equality: str, follows: tuple[float, float | None] | None
) -> None:
    bodies = f'<body name="a"><joint name="i"/>{_INERTIAL}<body name="b"><joint name="j"/>{_INERTIAL}</body></body>'
    model = robot(f"{bodies}|<equality>{equality}</equality>")
    axis = model.joint("j").axis
    mimic = axis.mimic if axis else None
    assert ((mimic.multiplier, mimic.offset) if mimic else None) == follows
    assert [each.name for each in kept(model)] == ([] if follows else ["equality"])


def test_a_program_moves_what_a_weld_holds_to_a_mocap_body() -> None:
    bodies = f'<body name="hand" mocap="true">{_INERTIAL}</body><body name="b"><freejoint/>{_INERTIAL}</body>'
    (world,) = lowered(f'{bodies}|<equality><weld body1="hand" body2="b"/></equality>').worlds
    assert not any(each.joints for each in world.models)
    assert [each.name for each in kept(world)] == ["equality"]


@pytest.mark.parametrize("section", ["actuator", "sensor"])
def test_what_is_about_one_tree_is_kept_in_its_model(section: str) -> None:
    what = '<motor joint="j"/>' if section == "actuator" else '<jointpos joint="j"/>'
    bodies = f'<body name="a"><joint name="j"/>{_INERTIAL}</body><body name="b">{_INERTIAL}</body>'
    (world,) = lowered(f"{bodies}|<{section}>{what}</{section}>").worlds
    assert [each.name for model in world.models for each in kept(model)] == [section]


@pytest.mark.parametrize("case", _CASES, ids=lambda case: case.stem)
def test_each_attribute_is_expressed_or_kept(case: Path) -> None:
    root = etree.fromstring(case.read_bytes(), etree.XMLParser(remove_comments=True))
    context = Context(DiagnosticSink(str(case)), str(case), "mjcf", (4, 0))
    canonical = normalize(root, context, LoadOptions.of(FileOptions()))
    assert canonical is not None
    piece = Piece(canonical, str(case))
    FileLowering(piece, context, LoadOptions.of(FileOptions()), root, WrittenModels()).document()
    forgotten = [(each.tag, name) for each in piece.walk() for name in each.forgotten]
    assert forgotten == []
    assert [each.tag for each in piece.walk() if not each.is_settled] == []


def test_the_ledger_has_each_part_with_a_reason_and_its_place() -> None:
    body = f'<body name="a"><joint armature="1" solreflimit="0.1 1"/>{_INERTIAL}</body>'
    text = f'<mujoco model="m">\n<worldbody>\n{body}</worldbody></mujoco>'
    entries = twinform.convert(text.encode(), to="sdf").ledger.entries
    kept_parts = [each for each in entries if each.fate is Fate.CARRIED]
    paths = [each.location.path.rpartition("/")[2] for each in kept_parts]
    assert sorted(paths) == ["@armature", "@solreflimit"]
    assert {each.location.line for each in kept_parts} == {3}
    assert all(": " in each.message and each.weight == 1 for each in kept_parts)


@pytest.mark.parametrize("to", ["sdf", "urdf"])
def test_without_carriers_nothing_of_ours_is_written_and_the_ledger_says_dropped(to: Literal["sdf", "urdf"]) -> None:
    body = f'<body name="a"><joint armature="1"/>{_INERTIAL}<site name="s"/></body>'
    made = twinform.convert(f"<mujoco><worldbody>{body}</worldbody></mujoco>".encode(), to=to, carriers=False)
    assert "urn:twinform:1" not in made.text
    assert Fate.CARRIED not in {each.fate for each in made.ledger.entries}
    assert any(each.location.path.endswith("@armature") for each in made.ledger.entries if each.fate is Fate.DROPPED)
