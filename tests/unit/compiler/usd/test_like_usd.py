"""Bodies, joints and shapes are where USD's own parser of physics finds them."""

import math
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler.usd.joints import joints_of
from twinform.compiler.usd.shapes import collisions_of
from twinform.compiler.usd.stage import Stage, stage_of
from twinform.ir import Box, Capsule, Cylinder, Pose, Shape, Sphere
from twinform.ir.transform import Transform
from twinform.passes.mesh_jobs.job import MeshJob

pytest.importorskip("pxr", reason="usd-core is not installed")
Usd: Any = import_module("pxr.Usd")
UsdPhysics: Any = import_module("pxr.UsdPhysics")

_CASES = Path(__file__).parents[3] / "cases/diff"
_SCALED = """#usda 1.0
(
    defaultPrim = "r"
    metersPerUnit = 0.5
    upAxis = "Z"
)
def Xform "r"
{
    double3 xformOp:translate = (1, 2, 3)
    float3 xformOp:rotateXYZ = (10, 20, 30)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    def Xform "a" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        float3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["xformOp:scale"]
        def Xform "flange"
        {
            double3 xformOp:translate = (0, 1, 0)
            float xformOp:rotateX = 90
            uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
            def Cylinder "rod" (prepend apiSchemas = ["PhysicsCollisionAPI"])
            {
                uniform token axis = "Y"
                double height = 3
                double radius = 0.25
            }
        }
    }
    def Xform "b" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        def Capsule "tip" (prepend apiSchemas = ["PhysicsCollisionAPI"])
        {
            uniform token axis = "X"
            double height = 3
            double radius = 0.25
            float3 xformOp:rotateXYZ = (10, 20, 30)
            uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
        }
    }
    def PhysicsRevoluteJoint "j"
    {
        uniform token physics:axis = "Y"
        rel physics:body0 = </r/a/flange>
        rel physics:body1 = </r/b>
        point3f physics:localPos0 = (0.1, 0.2, 0.3)
        point3f physics:localPos1 = (0, 0, -0.5)
        quatf physics:localRot0 = (0.5, 0.5, 0.5, 0.5)
        float physics:lowerLimit = -30
        float physics:upperLimit = 60
    }
}
"""


def _parsed(text: str) -> dict[str, Any]:
    """What USD's parser says of each body, joint and shape, by its path."""
    layer: Any = import_module("pxr.Sdf").Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    parse = getattr(UsdPhysics, "UsdPhysicsLoadStageFromPrimRange", None) or UsdPhysics.LoadUsdPhysicsFromRange
    found = parse(Usd.Stage.Open(layer), ["/"])
    described = ((kind, each) for kind, (_, listed) in found.items() for each in listed)
    return {str(each.primPath): each for kind, each in described if str(kind) != "Articulation"}


@pytest.fixture(params=["same_usd_units", "carried_usd_attributes", "different_usd_losses", ""])
def text(request: pytest.FixtureRequest) -> str:
    if not request.param:
        return _SCALED
    return Usd.Stage.Open(str(_CASES / request.param / "b.usda")).Flatten().ExportToString()


def _stage(text: str) -> Stage:
    jobs = import_module("twinform.passes.mesh_jobs.usd_jobs")
    return stage_of(jobs.stage(MeshJob("stage", {"links": []}, "usda", text.encode())).facts, "")


def _pose(position: Any, rotation: Any, stage: Stage) -> Transform:
    x, y, z = (number * stage.meters for number in position)
    w, (qx, qy, qz) = rotation.GetReal(), rotation.GetImaginary()
    return Transform.from_pose(Pose.unchecked(xyz=(x, y, z), quat_xyzw=(qx, qy, qz, w)))


def _near(one: Transform, other: Transform) -> bool:
    return math.dist(one.translation, other.translation) < 1e-5 and math.dist(one.rotation, other.rotation) < 1e-5


def test_bodies_are_the_same_and_stand_where_they_do(text: str) -> None:
    stage, parsed = _stage(text), _parsed(text)
    bodies = {path: each for path, each in parsed.items() if str(each.type).endswith("RigidBody")}
    assert {*bodies} == stage.bodies
    for path, each in bodies.items():
        assert _near(stage.prims[path].place, stage.root.compose(_pose(each.position, each.rotation, stage)))


def test_joints_connect_the_same_bodies_at_the_same_places(text: str) -> None:
    stage, parsed = _stage(text), _parsed(text)
    joints = {each.prim.path: each for each in joints_of(stage)}
    assert {*joints} == {path for path, each in parsed.items() if str(each.type).endswith("Joint")}
    for path, joint in joints.items():
        sides = ((joint.parent, "0"), (joint.child, "1"))
        for side, number in sides:
            body = str(getattr(parsed[path], f"body{number}"))
            assert (side.body or "") == body
            point, turn = (getattr(parsed[path], f"localPose{number}{what}") for what in ("Position", "Orientation"))
            if body:
                assert _near(side.frame, _pose(point, turn, stage))


def test_shapes_are_as_large(text: str) -> None:
    stage, parsed = _stage(text), _parsed(text)
    found = {one.source.path if one.source else "": (body, one) for body, one in collisions_of(stage)}
    shapes = {path: each for path, each in parsed.items() if str(each.type).endswith("Shape")}
    assert {*found} == {*shapes}
    for path, (body, collision) in found.items():
        assert str(shapes[path].rigidBody) == body
        assert collision.geometry is not None
        assert _lengths(collision.geometry.shape) == pytest.approx(
            [each * stage.meters for each in _said(shapes[path])]
        )


def _lengths(shape: Shape | None) -> list[float]:
    match shape:
        case Box(size=size) if size:
            return list(size)
        case Sphere(radius=radius) if radius:
            return [radius]
        case Cylinder(radius=radius, length=length) | Capsule(radius=radius, length=length) if radius and length:
            return [radius, length]
        case _:
            raise ValueError(shape)


def _said(shape: Any) -> list[float]:
    if hasattr(shape, "halfExtents"):
        return [2 * each for each in shape.halfExtents]
    return [shape.radius, 2 * shape.halfHeight] if hasattr(shape, "halfHeight") else [shape.radius]
