"""Two files as libsdformat sees them: do all their models stand, weigh and move in the same way?

Models are compared with fixed joints lumped, as the library's own reader of URDF does it, and with their place in the
world; every shape is compared by its kind, its geometry and its place there.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from twinform.testing.oracles.kinematics import EngineJoint, Motion, robot
from twinform.testing.oracles.libsdformat.library import RobotRow
from twinform.testing.oracles.libsdformat.libsdformat_robot import joint_of, link_of, pose_matrix
from twinform.testing.oracles.robot import WORLD, EngineRobot, Matrix, View
from twinform.testing.oracles.robot_comparison import judge, renamed

TOLERANCE = 1e-6
"""In m, kg and so on: urdfdom and the library's writer keep fewer digits than the files have."""
_Shape = tuple[str, int, Matrix]


def differences(before: Sequence[RobotRow], after: Sequence[RobotRow]) -> Iterator[str]:
    """What differs between the models of two files, as text; models are matched by name."""
    there = {row["name"]: row for row in after}
    for row in before:
        other = there.pop(row["name"], None)
        if other is None:
            yield f"model {row['name']!r} is missing"
            continue
        yield from (f"model {row['name']!r}: {what}" for what in _of_model(row, other))
    yield from (f"model {name!r} is new" for name in there)


def _of_model(before: RobotRow, after: RobotRow) -> Iterator[str]:
    if before["static"] != after["static"]:
        yield f"static {before['static']} became {after['static']}"
    first, second = _held(before, View()), _held(after, View())
    if names := renamed(first, second):
        second = _held(after, View(names))
    if _grounded(before) != _grounded(after):
        yield "other links are fixed to the world"
    if cause := judge(first, second, tolerance=TOLERANCE, lumped=True).cause:
        yield cause
    yield from _of_shapes(before, after)
    for kind, one, other in (
        ("sensors", sorted(map(_sensor, before["sensors"])), sorted(map(_sensor, after["sensors"]))),
        ("plugins", len(before["plugins"]), len(after["plugins"])),
    ):
        if one != other:
            yield f"{kind} {one} became {other}"


def _sensor(row: object) -> str:
    assert isinstance(row, dict)
    return f"{row['kind']} {row['name']}"


def _held(row: RobotRow, view: View) -> EngineRobot:
    """The model with its roots where they are in the world, whether they are fixed to it or not."""
    links, joints = [link_of(each) for each in row["links"]], [joint_of(each) for each in row["joints"]]
    loose = _tree([joint for joint in joints if joint.parent != WORLD or joint.motion is not Motion.FIXED])
    children = {joint.child for joint in loose}
    roots = (link for link in links if link.name not in children)
    held = [
        EngineJoint(f"{WORLD} {link.name}", Motion.OTHER, WORLD, link.name, link.pose, np.zeros(3), {})
        for link in roots
    ]
    return robot("libsdformat", links, [*loose, *held], pose_matrix(row["pose"]), view)


def _tree(joints: Sequence[EngineJoint]) -> list[EngineJoint]:
    """The joints without those that close a loop."""
    above: dict[str, EngineJoint] = {}
    for joint in joints:
        name = joint.parent
        while name in above and name != joint.child:
            name = above[name].parent
        if joint.child not in above and name != joint.child:
            above[joint.child] = joint
    return list(above.values())


def _grounded(row: RobotRow) -> set[str]:
    """The links that are fixed to the world, those of a static model aside."""
    fixed = (joint_of(each) for each in row["joints"] if not row["static"])
    return {joint.child for joint in fixed if joint.parent == WORLD and joint.motion is Motion.FIXED}


def _of_shapes(before: RobotRow, after: RobotRow) -> Iterator[str]:
    rest = list(_shapes(after))
    for kind, geometry, place in _shapes(before):
        found = next((n for n, one in enumerate(rest) if one[:2] == (kind, geometry) and _near(one[2], place)), None)
        if found is None:
            x, y, z = place[:3, 3]
            yield f"no {kind} of geometry {geometry} is at {x:.4g} {y:.4g} {z:.4g}"
            return
        del rest[found]
    if rest:
        yield f"{len(rest)} shapes are new"


def _near(one: Matrix, other: Matrix) -> bool:
    """Whether two places are the same; urdfdom turns what points straight up or down by up to 0.005 rad."""
    far = max(1.0, float(np.abs(one[:3, 3]).max()))
    moved, turned = np.abs(one - other)[:3, 3].max(), np.abs(one - other)[:3, :3].max()
    return bool(moved <= TOLERANCE * far and turned <= 5e-3)


def _shapes(row: RobotRow) -> Iterator[_Shape]:
    model = pose_matrix(row["pose"])
    for link in row["links"]:
        for shape in link["shapes"]:
            place = model @ pose_matrix(link["pose"]) @ pose_matrix(shape["place"])
            yield shape["kind"], shape["geometry"], place
