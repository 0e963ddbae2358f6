"""Builds the robot that is compared from a model in the newest SDF version."""

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

from twinform.compiler.compare.compared_robot import (
    ComparedBody,
    ComparedRobot,
    JointView,
    Leaf,
    Leaves,
    LinkPart,
    Mass,
    NamedFrame,
)
from twinform.compiler.compare.compared_values import Numbers, Text, Value
from twinform.compiler.compare.leaves import THERE
from twinform.compiler.compare.part_reader import PartReader
from twinform.compiler.compare.readers import Memo
from twinform.compiler.kinematics import Degree, degrees_of
from twinform.ir import Axis, Element, Format, Frame, Inertial, Joint, Link, Model, Node, Pose
from twinform.ir.defaults import MULTIPLIER, UNLIMITED
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.motion import WITH_TWO_AXES, WITHOUT_AXIS
from twinform.ir.solids import placed, written_solid
from twinform.ir.transform import Transform
from twinform.ir.verify.verify_joints import useless_leader
from twinform.passes.carriers.annotations import is_synthesized
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.shared.flattening import flatten
from twinform.schemas import element_xml

View = TypeVar("View", ComparedBody, JointView)


def build_robot(model: Model, source: Model, format: Format, memo: Memo) -> ComparedRobot:
    """Build the robot of a model; `source` is the model as the file has it.

    `memo` shares links and joints that another reader of the file sees in the same way.
    """
    return memo.once("robot", (model, source), lambda: _read_robot(model, source, format, memo))


def _read_robot(model: Model, source: Model, format: Format, memo: Memo) -> ComparedRobot:
    shells: list[tuple[Frame, Model]] = []
    flat = _without_made_root(flatten(model, lambda frame, shell: _keep_shell(shells, frame, shell)))
    return _RobotReading(_without_useless_mimics(flat), format, memo).robot(source, shells)


def _keep_shell(shells: list[tuple[Frame, Model]], frame: Frame, shell: Model) -> Frame:
    shells.append((frame, shell))
    return frame


def _without_made_root(model: Model) -> Model:
    """Return the model without the massless link that a conversion made because URDF needs one, if it holds nothing."""
    link = model.links[0] if len(model.links) == 1 else None
    if link is None or not is_synthesized(link) or link.inertial is None or link.inertial.mass != 0:
        return model
    if model.joints or link.visuals or link.collisions or link.sensors or link.lights:  # it is a link like others
        return model
    return model.copy(links=(), frames=tuple(_on_model(each, link.name) for each in model.frames), canonical_link=None)


def _on_model(frame: Frame, link: str) -> Frame:
    """Return a frame that stands on the model, and no longer on a link that is in the place of the model."""
    pose = frame.pose
    if pose is not None and pose.relative_to == link:
        pose = pose.copy(relative_to=MODEL)
    return frame.copy(pose=pose, attached_to=MODEL if frame.attached_to == link else frame.attached_to)


def _without_useless_mimics(model: Model) -> Model:
    """Return the model without mimics whose leader is missing or does not move: readers leave such a joint free."""
    if not any(axis and axis.mimic for joint in model.joints for axis in (joint.axis, joint.axis2)):
        return model
    known = {joint.name: joint for joint in model.joints}

    def freed(joint: Joint, axis: Axis | None) -> Axis | None:
        is_useless = axis and axis.mimic and useless_leader(joint, axis.mimic, known)
        return axis.copy(mimic=None) if axis and is_useless else axis

    joints = (each.copy(axis=freed(each, each.axis), axis2=freed(each, each.axis2)) for each in model.joints)
    return model.copy(joints=tuple(joints))


class _PosePlacer:
    """Places poses in the model. `named_frame` becomes true when a pose names a frame.

    Such a result depends on more than its node. The reading refers to this object and not the other way around, so that
    no circle of references is left.
    """

    def __init__(self, graph: FrameGraph) -> None:
        self.graph = graph
        self.named_frame = False

    def resolve(self, pose: Pose, holder: Transform) -> Transform:
        """Place a pose in the model; it is relative to `holder` unless it names a frame."""
        if pose.relative_to:
            self.named_frame = True
            holder = self.graph.place(pose.relative_to, kind="joint")
        return holder.compose(Transform.from_pose(pose))


class _RobotReading:
    """Reads one model, as one reader sees it."""

    def __init__(self, model: Model, format: Format, memo: Memo) -> None:
        self.model = model
        self.format = format
        self.memo = memo
        self.graph = FrameGraph(model)
        self.poses = _PosePlacer(self.graph)
        self.reader = PartReader(self.poses.resolve, format)

    def robot(self, source: Model, shells: Iterable[tuple[Frame, Model]]) -> ComparedRobot:
        """Return the whole robot; `shells` are its nested models without what was moved up from them."""
        model, identity = self.model, Transform()
        leaves, parts = self.reader.parts(model, identity)
        inner = [*(self._shell(shell, frame.name) for frame, shell in shells), *self._carried_shells()]
        of_urdf = source if self.format is Format.URDF else Model.unchecked(name="")
        links, joints = ({part.name for part in parts} for parts in (of_urdf.links, of_urdf.joints))
        return ComparedRobot(
            name=model.name,
            format=self.format,
            world=self.graph.place(WORLD, kind="world"),
            bodies={link.name: self._body(link) for link in model.links},
            joints={one.name: self._joint(one) for one in model.joints if not _is_made_for_static(one, model)},
            frames={frame.name: self._frame(frame, links, joints) for frame in model.frames},
            models=frozenset(part.name for part in inner),
            leaves=leaves,
            parts=(*parts, *inner),
            where=model.source,
        )

    def _body(self, link: Link) -> ComparedBody:
        frame = self.graph.place(link.name)
        return self._reuse("link", link.name, (link, frame), lambda: self._read_body(link, frame))

    def _joint(self, joint: Joint) -> JointView:
        frame, ends = (
            self.graph.place(joint.name, kind="joint"),
            (self._link_at(joint.parent), self._link_at(joint.child)),
        )
        degrees = tuple(degrees_of(joint, frame, Format.SDF, lambda name: self.graph.place(name, kind="frame")))
        given, make = (joint, frame, *ends, degrees), lambda: self._read_joint(joint, frame, ends, degrees)
        return self._reuse("joint", joint.name, given, make)

    def _reuse(self, group: str, name: str, given: object, make: Callable[[], View]) -> View:
        self.poses.named_frame = False
        return self.memo.once((group, name), given, make, lambda _: not self.poses.named_frame)

    def _read_body(self, link: Link, frame: Transform) -> ComparedBody:
        leaves, parts = self.reader.parts(link, frame)
        mass = self._mass(link.inertial, frame)
        return ComparedBody(link.name, frame, mass, leaves, parts, link.source)

    def _mass(self, inertial: Inertial | None, frame: Transform) -> Mass:
        inertial = inertial or Inertial.unchecked()
        pose = self.poses.resolve(inertial.pose or Pose.unchecked(), frame)
        solid = placed(written_solid(inertial, Format.SDF), pose)
        return Mass(solid, bool(inertial.auto), inertial.source)

    def _read_joint(
        self, joint: Joint, frame: Transform, ends: tuple[str, str], degrees: tuple[Degree, ...]
    ) -> JointView:
        leaves, parts = self.reader.parts(joint, frame)
        values = joint_leaves(joint, leaves)
        return JointView(joint.name, joint.type, *ends, frame, degrees, values, parts, joint.source)

    def _link_at(self, name: str | None) -> str:
        """Return the link that the parent or child frame of a joint is fixed to."""
        return self.graph.body(name or WORLD)

    def _frame(self, frame: Frame, links: Collection[str], joints: Collection[str]) -> NamedFrame:
        """Return a frame as it is compared; `links` and `joints` are the names of links and joints in a URDF file."""
        return NamedFrame(
            frame.name,
            self.graph.body(frame.name, kind="frame"),
            self.graph.place(frame.name, kind="frame"),
            was_link=frame.name in links,
            was_joint=frame.name in joints,
            where=frame.source,
        )

    def _shell(self, shell: Model, name: str) -> LinkPart:
        """Read a nested model without its links, joints and frames."""
        leaves, parts = self.reader.parts(shell, Transform())
        inside = {f"{part.kind}[{part.name}]": Leaf(THERE, where=part.where) for part in parts}
        inside |= {f"{part.kind}[{part.name}]/{path}": leaf for part in parts for path, leaf in part.leaves.items()}
        return LinkPart("model", name, {**leaves, **inside}, shell.source)

    def _carried_shells(self) -> Iterator[LinkPart]:
        """Yield the settings of nested models that travel in URDF, as parts of the robot."""
        for frame in self.model.frames:
            for element in _carried_elements(frame):
                if element.name == "model":
                    part = self.reader.element(element_xml(element), "model", frame.source, Transform())
                    yield LinkPart("model", frame.name, part.leaves, part.where, carried=True)


def _carried_elements(node: Node) -> Iterator[Element]:
    for part in node.opaque:
        if is_carrier(part, "sdf"):
            yield from (piece.element for piece in unpack(part) if piece.element)


def _is_made_for_static(joint: Joint, model: Model) -> bool:
    """Whether a joint holds a link of a static model to the world, where the link stands anyway."""
    return bool(model.static) and joint.type == "fixed" and WORLD in (joint.parent, joint.child)


_OF_TYPES: Mapping[str, frozenset[str]] = {
    "gearbox_ratio": frozenset({"gearbox"}),
    "gearbox_reference_body": frozenset({"gearbox"}),
    "screw_thread_pitch": frozenset({"screw"}),
    "thread_pitch": frozenset({"screw"}),
}
"""The types of joints for which a value means something; others are for all types."""
_OF_BALLS = ("ball", "axis/dynamics/damping")
_SLIDES = frozenset({"prismatic"})
_UNITS: Mapping[str, tuple[str, str]] = {
    "limit/lower": ("rad", "m"),
    "limit/upper": ("rad", "m"),
    "limit/effort": ("N*m", "N"),
    "limit/velocity": ("rad/s", "m/s"),
    "limit/stiffness": ("N*m/rad", "N/m"),
    "limit/dissipation": ("N*m*s/rad", "N*s/m"),
    "dynamics/damping": ("N*m*s/rad", "N*s/m"),
    "dynamics/friction": ("N*m", "N"),
    "dynamics/spring_reference": ("rad", "m"),
    "dynamics/spring_stiffness": ("N*m/rad", "N/m"),
}
"""Units for joints that turn and for those that slide."""
_ENDS = frozenset({"limit/lower", "limit/upper"})
_STRENGTHS = frozenset({"limit/effort", "limit/velocity"})


def joint_type(joint: str) -> str:
    """Return the type of a joint, with continuous as revolute: SDF before 1.6 has no continuous joints."""
    return "revolute" if joint == "continuous" else joint


def joint_leaves(joint: Joint, leaves: Leaves) -> Leaves:
    """Return the values of a joint that its type uses, with units, and with infinity for no limit."""
    found = {path: _with_unit(path, leaf, joint.type) for path, leaf in leaves.items() if _is_used(path, joint.type)}
    if joint.type == "continuous":
        # A continuous joint turns without end, whatever its <limit> says; URDF cannot express such
        # ends, and they are carried.
        found = {path: leaf for path, leaf in found.items() if path.removeprefix("axis/") not in _ENDS}
    return _with_mimic(_with_pitch(found))


def _is_used(path: str, type: str) -> bool:
    if path in _OF_TYPES:
        return type in _OF_TYPES[path]
    if path.startswith("axis2"):
        return type in WITH_TWO_AXES
    # Drake and MuJoCo damp a ball, whose axis says nothing else
    return type not in WITHOUT_AXIS or not path.startswith("axis") or (type, path) == _OF_BALLS


def _with_unit(path: str, leaf: Leaf, type: str) -> Leaf:
    key = path.partition("/")[2]
    if not path.startswith("axis") or not isinstance(leaf.value, Numbers):
        return leaf
    unit = _UNITS.get(key, ("", ""))[type in _SLIDES]
    return replace(leaf, value=_scalar(key, leaf.value, unit), default=_scalar(key, leaf.default, unit))


def _scalar(key: str, value: Value | None, unit: str) -> Value | None:
    if not isinstance(value, Numbers) or len(value.values) != 1:
        return value
    (number,) = value.values
    if key in _ENDS and abs(number) >= UNLIMITED:
        number = math.copysign(math.inf, number)
    # SDF takes a negative effort or velocity for no limit.
    if key in _STRENGTHS and (number < 0 or number >= UNLIMITED):
        number = math.inf
    return Numbers((number,), unit or value.unit)


def _with_pitch(leaves: dict[str, Leaf]) -> dict[str, Leaf]:
    """Replace the older pitch of a screw, in rad/m and left-handed, by the newer one, in m/rev and right-handed."""
    old = leaves.pop("thread_pitch", None)
    if (
        old is not None
        and "screw_thread_pitch" not in leaves
        and isinstance(old.value, Numbers)
        and old.value.values[0]
    ):
        pitch = Numbers((-2 * math.pi / old.value.values[0],), "m/rev")
        leaves["screw_thread_pitch"] = replace(old, value=pitch, default=None)
    return leaves


def _with_mimic(leaves: dict[str, Leaf]) -> dict[str, Leaf]:
    """Make the reference of a mimic a part of its offset: m (q - r) + o is m q + (o - m r)."""
    for axis in ("axis", "axis2"):
        reference = leaves.pop(f"{axis}/mimic/reference", None)
        if f"{axis}/mimic/@joint" not in leaves:
            continue
        leaves.setdefault(f"{axis}/mimic/@axis", Leaf(Text("axis"), where=leaves[f"{axis}/mimic/@joint"].where))
        multiplier, offset = (leaves.get(f"{axis}/mimic/{name}") for name in ("multiplier", "offset"))
        total = number_of(offset, 0.0) - number_of(multiplier, MULTIPLIER) * number_of(reference, 0.0)
        where = (offset or reference or leaves[f"{axis}/mimic/@joint"]).where
        leaves[f"{axis}/mimic/offset"] = Leaf(Numbers((total,), floor=1.0), Numbers((0.0,)), where)
    return leaves


def number_of(leaf: Leaf | None, default: float) -> float:
    """Return the number of a leaf, or `default` where there is none."""
    return leaf.value.values[0] if leaf is not None and isinstance(leaf.value, Numbers) else default
