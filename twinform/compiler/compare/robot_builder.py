"""Builds the robot that is compared from a model in the syntax of the newest SDF version."""

from collections.abc import Callable, Collection, Iterable, Iterator
from typing import TypeVar

from twinform.compiler.compare.compared_robot import (
    ComparedBody,
    ComparedRobot,
    JointView,
    Leaf,
    LinkPart,
    Mass,
    NamedFrame,
)
from twinform.compiler.compare.joint_values import joint_leaves
from twinform.compiler.compare.leaves import THERE
from twinform.compiler.compare.memo import Memo
from twinform.compiler.compare.part_reader import PartReader
from twinform.compiler.kinematics import Degree, degrees_of
from twinform.ir import Axis, Element, Format, Frame, Inertial, Joint, Link, Model, Node, Pose
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.solids import placed, written_solid
from twinform.ir.transform import Transform
from twinform.ir.verify.verify_joints import useless_leader
from twinform.passes.carriers.annotations import is_synthesized
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.shared.flattening import flatten
from twinform.schemas import element_xml

View = TypeVar("View", ComparedBody, JointView)


def build_robot(model: Model, source: Model, format: Format, memo: Memo) -> ComparedRobot:
    """The robot of a model; `source` is the model as the file has it.

    `memo` has what another reader of the file has seen: what both see alike is one object.
    """
    return memo.once("robot", (model, source), lambda: _built(model, source, format, memo))


def _built(model: Model, source: Model, format: Format, memo: Memo) -> ComparedRobot:
    shells: list[tuple[Frame, Model]] = []
    flat = _without_made_root(flatten(model, lambda frame, shell: _noted(shells, frame, shell)))
    return _RobotReading(_without_useless_mimics(flat), format, memo).robot(source, shells)


def _noted(shells: list[tuple[Frame, Model]], frame: Frame, shell: Model) -> Frame:
    shells.append((frame, shell))
    return frame


def _without_made_root(model: Model) -> Model:
    """The model without the link that was synthesized because URDF needs one; it has 1 kg in SDF if none is written."""
    link = model.links[0] if len(model.links) == 1 else None
    if link is None or not is_synthesized(link) or link.inertial is None or link.inertial.mass != 0:
        return model
    name = link.name
    frames = (frame.copy(attached_to=MODEL) if frame.attached_to == name else frame for frame in model.frames)
    return model.copy(links=(), frames=tuple(frames), canonical_link=None)


def _without_useless_mimics(model: Model) -> Model:
    """The model without mimics of what does not move, or is not there: such a joint is free."""
    if not any(axis and axis.mimic for joint in model.joints for axis in (joint.axis, joint.axis2)):
        return model
    known = {joint.name: joint for joint in model.joints}

    def freed(joint: Joint, axis: Axis | None) -> Axis | None:
        is_useless = axis and axis.mimic and useless_leader(joint, axis.mimic, known)
        return axis.copy(mimic=None) if axis and is_useless else axis

    joints = (each.copy(axis=freed(each, each.axis), axis2=freed(each, each.axis2)) for each in model.joints)
    return model.copy(joints=tuple(joints))


class _PosePlacer:
    """Places poses in the model. `named_frame` is whether one of them was in a frame of another name.

    Then more than its node says where it is. A reading holds this and not the other way around: no circle is left.
    """

    def __init__(self, graph: FrameGraph) -> None:
        self.graph = graph
        self.named_frame = False

    def resolve(self, pose: Pose, holder: Transform) -> Transform:
        """Where a pose is in the model, which is in the frame that `holder` places unless it names another."""
        if pose.relative_to:
            self.named_frame = True
            holder = self.graph.place(pose.relative_to, kind="joint")
        return holder.compose(Transform.from_pose(pose))


class _RobotReading:
    """The robot of one model, as one reader sees it."""

    def __init__(self, model: Model, format: Format, memo: Memo) -> None:
        self.model = model
        self.format = format
        self.memo = memo
        self.graph = FrameGraph(model)
        self.poses = _PosePlacer(self.graph)
        self.reader = PartReader(self.poses.resolve, format)

    def robot(self, source: Model, shells: Iterable[tuple[Frame, Model]]) -> ComparedRobot:
        """All of it."""
        model, identity = self.model, Transform()
        leaves, parts = self.reader.parts(model, identity)
        inner = [*(self._shell(shell, frame.name) for frame, shell in shells), *self._carried_shells()]
        of_urdf = source if self.format is Format.URDF else Model(name="")
        links, joints = ({part.name for part in parts} for parts in (of_urdf.links, of_urdf.joints))
        return ComparedRobot(
            name=model.name,
            format=self.format,
            world=self.graph.place(WORLD, kind="world"),
            bodies={link.name: self._known_body(link) for link in model.links},
            joints={one.name: self._known_joint(one) for one in model.joints if not _is_made_for_static(one, model)},
            frames={frame.name: self._frame(frame, links, joints) for frame in model.frames},
            models=frozenset(part.name for part in inner),
            leaves=leaves,
            parts=(*parts, *inner),
            where=model.source,
        )

    def _known_body(self, link: Link) -> ComparedBody:
        frame = self.graph.place(link.name)
        return self._once("link", link.name, (link, frame), lambda: self._body(link, frame))

    def _known_joint(self, joint: Joint) -> JointView:
        frame, ends = self.graph.place(joint.name, kind="joint"), (self._end(joint.parent), self._end(joint.child))
        degrees = tuple(degrees_of(joint, frame, Format.SDF, lambda name: self.graph.place(name, kind="frame")))
        given, make = (joint, frame, *ends, degrees), lambda: self._joint(joint, frame, ends, degrees)
        return self._once("joint", joint.name, given, make)

    def _once(self, group: str, name: str, given: object, make: Callable[[], View]) -> View:
        self.poses.named_frame = False
        return self.memo.once((group, name), given, make, lambda _: not self.poses.named_frame)

    def _body(self, link: Link, frame: Transform) -> ComparedBody:
        leaves, parts = self.reader.parts(link, frame)
        mass = self._mass(link.inertial, frame)
        return ComparedBody(link.name, frame, mass, leaves, parts, link.source)

    def _mass(self, inertial: Inertial | None, frame: Transform) -> Mass:
        inertial = inertial or Inertial()
        pose = self.poses.resolve(inertial.pose or Pose(), frame)
        solid = placed(written_solid(inertial, Format.SDF), pose)
        return Mass(solid, bool(inertial.auto), inertial.source)

    def _joint(self, joint: Joint, frame: Transform, ends: tuple[str, str], degrees: tuple[Degree, ...]) -> JointView:
        leaves, parts = self.reader.parts(joint, frame)
        values = joint_leaves(joint, leaves)
        return JointView(joint.name, joint.type, *ends, frame, degrees, values, parts, joint.source)

    def _end(self, name: str | None) -> str:
        """The link that an end of a joint moves with."""
        return self.graph.body(name or WORLD)

    def _frame(self, frame: Frame, links: Collection[str], joints: Collection[str]) -> NamedFrame:
        """The frame; `links` and `joints` are the names of those that the file had as URDF."""
        return NamedFrame(
            frame.name,
            self.graph.body(frame.name, kind="frame"),
            self.graph.place(frame.name, kind="frame"),
            was_link=frame.name in links,
            was_joint=frame.name in joints,
            where=frame.source,
        )

    def _shell(self, shell: Model, name: str) -> LinkPart:
        """A nested model without its links, joints and frames."""
        leaves, parts = self.reader.parts(shell, Transform())
        inside = {f"{part.kind}[{part.name}]": Leaf(THERE, where=part.where) for part in parts}
        inside |= {f"{part.kind}[{part.name}]/{path}": leaf for part in parts for path, leaf in part.leaves.items()}
        return LinkPart("model", name, {**leaves, **inside}, shell.source)

    def _carried_shells(self) -> Iterator[LinkPart]:
        """Yield the settings of nested models that travel in URDF, as parts of the robot."""
        for frame in self.model.frames:
            for element in _carried(frame):
                if element.name == "model":
                    part = self.reader.element(element_xml(element), "model", frame.source, Transform())
                    yield LinkPart("model", frame.name, part.leaves, part.where, carried=True)


def _carried(node: Node) -> Iterator[Element]:
    for part in node.opaque:
        if is_carrier(part, "sdf"):
            yield from (piece.element for piece in unpack(part) if piece.element)


def _is_made_for_static(joint: Joint, model: Model) -> bool:
    """Whether it holds a link of a static model to the world, where it stands anyway."""
    return bool(model.static) and joint.type == "fixed" and WORLD in (joint.parent, joint.child)
