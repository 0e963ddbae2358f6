"""What the schemas of UsdPhysics, Newton, MuJoCo and PhysX say is compared with what the URDF says."""

import math
from pathlib import Path

import pytest

import twinform
from testbed.usd.losses import KINDS, losses
from twinform.compiler.compare import Comparison

pytest.importorskip("pxr", reason="usd-core is not installed")

_CASES = Path(__file__).parents[3] / "cases/diff"
_INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial>'
_BODY = """\
def Xform "{0}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{{
    float physics:mass = 1
    float3 physics:diagonalInertia = (1, 2, 2.5)
    {1}
}}
"""
_SIDES = "rel physics:body0 = </r/a>\nrel physics:body1 = </r/b>\npoint3f physics:localPos0 = (0, 0, 1)"
_ENDS = "float physics:lowerLimit = -90\nfloat physics:upperLimit = 90"
_DEGREE = math.pi / 180


def urdf(joint: str = "", type: str = "revolute", inside: str = "", inertial: str = _INERTIAL) -> bytes:
    """Two links and the joint between them; `joint` is what it has beside its ends."""
    return f"""<robot name="r"><link name="a">{_INERTIAL}</link><link name="b">{inertial}{inside}</link>
    <joint name="j" type="{type}"><origin xyz="0 0 1"/><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="{-math.pi / 2}" upper="{math.pi / 2}" effort="1e300" velocity="1e300"/>{joint}</joint></robot>
    """.encode()


def usd(
    joint: str = "", type: str = "PhysicsRevoluteJoint", inside: str = "", sides: str = _SIDES + "\n" + _ENDS
) -> bytes:
    """The same two links; `joint` is what the joint has beside its sides."""
    axis = 'uniform token physics:axis = "Z"'
    return (
        '#usda 1.0\n(\n    defaultPrim = "r"\n    upAxis = "Z"\n    metersPerUnit = 1\n)\ndef Xform "r"\n{\n'
        + _BODY.format("a", "")
        + _BODY.format(
            "b",
            f'double3 xformOp:translate = (0, 0, 1)\nuniform token[] xformOpOrder = ["xformOp:translate"]\n{inside}',
        )
        + f'def {type} "j"\n{{\n{axis}\n{sides}\n{joint}\n}}\n}}\n'
    ).encode()


def aspects(found: Comparison) -> set[str]:
    return {item.aspect for item in found.counted if item.group != "kinematics"}


@pytest.mark.parametrize(
    "written",
    [
        f"float newton:damping = {0.5 * _DEGREE}\nfloat newton:friction = 0.25",
        "float mjc:damping = 0.5\nfloat mjc:frictionloss = 0.25",
        f"float drive:angular:physics:damping = {0.5 * _DEGREE}\nfloat physxJoint:jointFriction = 0.25",
        f"float newton:damping = {0.5 * _DEGREE}\nfloat mjc:damping = 7\nfloat newton:friction = 0.25",
    ],
)
def test_damping_and_friction_are_read_from_each_schema(written: str) -> None:
    model = urdf('<dynamics damping="0.5" friction="0.25"/>')
    assert twinform.diff(model, usd(written)).same
    assert aspects(twinform.diff(model, usd())) == {"axis/dynamics/damping", "axis/dynamics/friction"}


def test_the_gain_of_a_controller_is_no_damping() -> None:
    drive = "float drive:angular:physics:damping = 3\nfloat drive:angular:physics:stiffness = 90"
    assert twinform.diff(urdf(), usd(drive)).same


def test_a_sliding_joint_has_no_degrees() -> None:
    model = urdf('<dynamics damping="0.5" friction="0.25"/>', "prismatic").replace(str(math.pi / 2).encode(), b"0.1")
    ends = "float physics:lowerLimit = -0.1\nfloat physics:upperLimit = 0.1"
    said = "float newton:damping = 0.5\nfloat newton:friction = 0.25"
    assert twinform.diff(model, usd(said, "PhysicsPrismaticJoint", sides=f"{_SIDES}\n{ends}")).same


def test_a_joint_of_six_degrees_with_one_left_is_that_joint() -> None:
    locked = "\n".join(
        f"float limit:{name}:physics:low = 1\nfloat limit:{name}:physics:high = -1"
        for name in ("transX", "transY", "transZ", "rotX", "rotY")
    )
    ends = "float limit:rotZ:physics:low = -90\nfloat limit:rotZ:physics:high = 90"
    assert twinform.diff(urdf(), usd(f"{locked}\n{ends}", "PhysicsJoint", sides=_SIDES)).same
    every = f"{locked}\nfloat limit:rotZ:physics:low = 1\nfloat limit:rotZ:physics:high = -1"
    assert twinform.diff(urdf(type="fixed"), usd(every, "PhysicsJoint", sides=_SIDES)).same


def test_a_planar_joint_is_the_chain_that_conversions_make() -> None:
    locked = "\n".join(
        f"float limit:{n}:physics:low = 1\nfloat limit:{n}:physics:high = -1" for n in ("transZ", "rotX", "rotY")
    )
    model = urdf(type="planar").replace(b"<limit", b"<unused").replace(b'velocity="1e300"/>', b'velocity="1e300"/>')
    model = model[: model.index(b"<unused")] + model[model.index(b"/>", model.index(b"<unused")) + 2 :]
    assert twinform.diff(model, usd(locked, "PhysicsJoint", sides=_SIDES)).same
    assert not twinform.diff(model, usd(sides=_SIDES)).same


def test_a_joint_to_the_world_holds_either_side() -> None:
    held = "rel physics:body0 = </r/b>\npoint3f physics:localPos1 = (0, 0, 1)\n" + _ENDS
    upside = held.replace("body0", "body1").replace("localPos1", "localPos0")
    (one, other) = (twinform.diff(urdf(), usd(sides=sides)) for sides in (held, upside))
    assert "parent" in aspects(one)
    assert "parent" in aspects(other)
    assert twinform.diff(usd(sides=upside), usd(sides=upside)).same
    assert aspects(twinform.diff(usd(sides=upside), usd(sides=held))) == {"axis/xyz"}  # seen from the other side


def test_where_a_body_is_at_the_moment_does_not_matter_and_where_its_joint_is_does() -> None:
    moved = usd().replace(b"(0, 0, 1)\nuniform", b"(0, 3, 1)\nuniform")
    assert moved != usd()
    assert twinform.diff(urdf(), moved).same
    assert "pose/position" in aspects(
        twinform.diff(urdf(), usd(sides=_SIDES.replace("0, 1)", "0, 1.001)") + "\n" + _ENDS))
    )


def test_a_disabled_part_is_not_there() -> None:
    assert "" in aspects(twinform.diff(urdf(), usd("bool physics:jointEnabled = 0")))
    assert not twinform.diff(
        urdf(), usd().replace(b"float physics:mass = 1", b"bool physics:rigidBodyEnabled = 0", 1)
    ).same


def test_a_joint_outside_of_the_articulation_places_nothing() -> None:
    loop = 'def PhysicsRevoluteJoint "loop"\n{\nuniform token physics:axis = "Z"\n'
    loop += "bool physics:excludeFromArticulation = 1\n"
    loop += "rel physics:body0 = </r/a>\nrel physics:body1 = </r/b>\npoint3f physics:localPos0 = (9, 9, 9)\n}\n"
    text = usd()
    joint = text.index(b"def PhysicsRevoluteJoint")
    found = twinform.diff(urdf(), text[:joint] + loop.encode() + text[joint:])
    assert {(item.name, item.aspect) for item in found.counted} == {("loop", "")}


@pytest.mark.parametrize(
    ("shape", "element"),
    [
        ('def Cube "c" (A)\n{\ndouble size = 0.5\n}', '<box size="0.5 0.5 0.5"/>'),
        ('def Cube "c" (A)\n{\n}', '<box size="2 2 2"/>'),
        ('def Sphere "c" (A)\n{\ndouble radius = 0.5\n}', '<sphere radius="0.5"/>'),
        ('def Cylinder "c" (A)\n{\n}', '<cylinder radius="1" length="2"/>'),
        (
            'def Cylinder_1 "c" (A)\n{\ndouble radiusBottom = 0.3\ndouble radiusTop = 0.3\n}',
            '<cylinder radius="0.3" length="2"/>',
        ),
        ('def Mesh "c" (A)\n{\n}', '<mesh filename="m.stl"/>'),
        ('def Xform "held" (A)\n{\ndef Cube "c"\n{\n}\n}', '<box size="2 2 2"/>'),
        ('def Cube "c" (A)\n{\nbool physics:collisionEnabled = 0\n}', ""),
        ('def Cube "c"\n{\n}', ""),
    ],
)
def test_shapes_are_colliders_where_the_schema_is_applied(shape: str, element: str) -> None:
    text = shape.replace("(A)", '(prepend apiSchemas = ["PhysicsCollisionAPI"])')
    collision = f"<collision><geometry>{element}</geometry></collision>" if element else ""
    assert twinform.diff(urdf(inside=collision), usd(inside=text)).same
    assert bool(element) != twinform.diff(urdf(), usd(inside=text)).same


def test_a_mass_that_is_left_out_is_one_that_engines_compute() -> None:
    shape = 'def Cube "c" (prepend apiSchemas = ["PhysicsCollisionAPI"])\n{\n}'
    box = '<collision><geometry><box size="2 2 2"/></geometry></collision>'
    text = usd(inside=shape)
    last = text.rindex(b"float physics:mass = 1")
    without = text[:last] + text[last:].replace(b"float physics:mass = 1", b"")
    assert aspects(twinform.diff(urdf(inside=box), without)) == {"inertial/auto"}
    assert twinform.diff(urdf(inside=box, inertial=""), without).same  # USD has no word for no mass


@pytest.mark.parametrize(
    "written",
    [
        "rel newton:mimicJoint = </r/j>\nfloat newton:mimicCoef0 = 90\nfloat newton:mimicCoef1 = 2",
        "rel {0}:referenceJoint = </r/j>\nfloat {0}:gearing = -2\nfloat {0}:offset = -90".format(
            "physxMimicJoint:rotZ"
        ),
    ],
)
def test_mimics_are_read_from_each_schema(written: str) -> None:
    second = urdf().replace(b"</robot>", f"""<link name="c">{_INERTIAL}</link><joint name="k" type="continuous">
        <parent link="b"/><child link="c"/><axis xyz="0 0 1"/><limit effort="1e300" velocity="1e300"/>
        <mimic joint="j" multiplier="2" offset="{math.pi / 2}"/></joint></robot>""".encode())  # fmt: skip
    joint = 'def PhysicsRevoluteJoint "k"\n{\nuniform token physics:axis = "Z"\n'
    joint += "rel physics:body0 = </r/b>\nrel physics:body1 = </r/c>\n"

    def stage(more: str) -> bytes:
        return usd().removesuffix(b"}\n") + f"{_BODY.format('c', '')}{joint}{more}\n}}\n}}\n".encode()

    assert twinform.diff(second, stage(written)).same
    assert {"axis/mimic/@joint"} <= aspects(twinform.diff(second, stage("")))
    assert aspects(twinform.diff(second, stage(written.replace("90", "80")))) == {"axis/mimic/offset"}


@pytest.mark.slow
def test_every_planted_loss_is_found() -> None:
    folder = _CASES / "carried_usd_attributes"
    model, text = folder / "a.urdf", (folder / "b.usda").read_text()
    before = twinform.diff(model, text.encode())
    planted = [loss for seed in range(3) for loss in losses(text, str(seed))]
    assert len({loss.kind for loss in planted}) > len(KINDS) // 2
    missed = [loss.kind for loss in planted if not loss.found_by(twinform.diff(model, loss.text.encode()), before)]
    assert missed == []
