"""What USD can say of a robot: where a file is USD, nothing else of the other one is compared."""

from collections.abc import Mapping
from dataclasses import replace

from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView, Leaves, LinkPart, Mass
from twinform.compiler.compare.compared_values import Text

# USD has single precision for most numbers, and frames that are composed along a chain of links
# add up what each of them was rounded by.
SINGLE_PRECISION = 1e-5
"""The share of a value up to which a difference from a number of USD is rounding."""
OF_JOINTS = ("axis/limit/lower", "axis/limit/upper", "axis/limit/effort", "axis/limit/velocity",
              "axis/dynamics/damping", "axis/dynamics/friction", "axis/mimic/")  # fmt: skip
"""How the paths of the values of joints begin that USD has attributes for."""
_OF_SHAPES = ("pose", "geometry")
_MESH = Text("mesh")


def in_common_terms(a: ComparedRobot, b: ComparedRobot) -> tuple[ComparedRobot, ComparedRobot]:
    """Return two robots with what USD can say of them, or as they are where neither comes from USD."""
    if not (a.of_usd or b.of_usd):
        return a, b
    a, b = _sayable(a), _sayable(b)
    return (_fitted(a, b) if a.of_usd else a), (_fitted(b, a) if b.of_usd else b)


def _sayable(robot: ComparedRobot) -> ComparedRobot:
    return replace(
        robot,
        bodies={name: _sayable_body(body) for name, body in robot.bodies.items()},
        joints={name: _sayable_joint(joint) for name, joint in robot.joints.items()},
        frames={name: frame for name, frame in robot.frames.items() if not frame.was_joint},
        models=frozenset(),
        leaves={},
        parts=(),
    )


def _sayable_body(body: ComparedBody) -> ComparedBody:
    parts = tuple(_sayable_shape(part) for part in body.parts if part.kind == "collision")
    return replace(body, leaves={}, parts=parts)


def _sayable_shape(part: LinkPart) -> LinkPart:
    """Return a shape without its surface; of a mesh only that there is one, since converters bake its pose into it."""
    kind = part.leaves.get("geometry")
    is_mesh = kind is not None and kind.value == _MESH
    kept = {path: leaf for path, leaf in part.leaves.items() if path.startswith(_OF_SHAPES)}
    return replace(part, leaves={"geometry": kept["geometry"]} if is_mesh else kept)


def _sayable_joint(joint: JointView) -> JointView:
    return replace(joint, leaves=_starting_with(joint.leaves, OF_JOINTS), parts=())


def _starting_with(leaves: Leaves, beginnings: tuple[str, ...]) -> Leaves:
    return {path: leaf for path, leaf in leaves.items() if path.startswith(beginnings)}


def _fitted(robot: ComparedRobot, other: ComparedRobot) -> ComparedRobot:
    """Return a robot from USD in the words of the other one, where USD has none of its own."""
    bodies = {name: _with_mass(body, other.bodies) for name, body in robot.bodies.items()}
    return replace(robot, bodies=bodies, joints=_with_names_of_fixed(robot, other))


def _with_mass(body: ComparedBody, others: Mapping[str, ComparedBody]) -> ComparedBody:
    """Return a link without mass where the other has none: what USD leaves out is computed from the shapes."""
    other = others.get(body.name)
    has_none = body.mass.automatic and (other is None or not (other.mass.automatic or other.mass.solid.mass))
    return replace(body, mass=Mass(where=body.mass.where)) if has_none else body


def _with_names_of_fixed(robot: ComparedRobot, other: ComparedRobot) -> dict[str, JointView]:
    """Return the joints, with fixed ones named as those between the same links: some converters make up names."""
    free = {name: joint for name, joint in other.joints.items() if joint.type == "fixed" and name not in robot.joints}
    between = {(joint.parent, joint.child): name for name, joint in free.items()}
    found: dict[str, JointView] = {}
    for name, joint in robot.joints.items():
        is_made_up = joint.type == "fixed" and name not in other.joints
        written = between.get((joint.parent, joint.child), name) if is_made_up else name
        found[written] = replace(joint, name=written)
    return found
