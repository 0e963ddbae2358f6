"""Builds the robot that is compared from a model in the syntax of the newest SDF version."""

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import partial

from twinform.compiler.compare.joint_values import joint_leaves
from twinform.compiler.compare.leaves import THERE
from twinform.compiler.compare.part_reader import PartReader
from twinform.compiler.compare.robot import Body, JointView, Leaf, Mass, NamedFrame, Part, Robot
from twinform.diagnostics import Origins
from twinform.ir import Element, Format, Frame, Inertial, Joint, Link, Model, Node, Pose, Vector3
from twinform.ir.defaults import direction
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.motion import axes_of, unit
from twinform.ir.solids import placed, written_solid
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import is_synthesized
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.transforms.flattening import flatten
from twinform.schemas import element_xml


def build_robot(model: Model, source: Model, format: Format, origins: Mapping[str, Origins]) -> Robot:
    """The robot of a model; `source` is the model as the file has it."""
    shells: list[tuple[Frame, Model]] = []
    model = _without_made_root(flatten(model, lambda frame, shell: _noted(shells, frame, shell)))
    return _RobotBuilder(model, format, origins).robot(source, shells)


def _noted(shells: list[tuple[Frame, Model]], frame: Frame, shell: Model) -> Frame:
    shells.append((frame, shell))
    return frame


def _without_made_root(model: Model) -> Model:
    """The model without the link that was synthesized because URDF needs one."""
    link = model.links[0] if len(model.links) == 1 else None
    if link is None or not is_synthesized(link) or (link.inertial and link.inertial.mass):
        return model
    name = link.name
    frames = (
        frame.model_copy(update={"attached_to": MODEL}) if frame.attached_to == name else frame
        for frame in model.frames
    )
    return model.model_copy(update={"links": (), "frames": tuple(frames), "canonical_link": None})


class _RobotBuilder:
    """The robot of one model."""

    def __init__(self, model: Model, format: Format, origins: Mapping[str, Origins]) -> None:
        self.model = model
        self.format = format
        self.graph = FrameGraph(model)
        self.reader = PartReader(partial(_resolve, self.graph), origins, format)

    def robot(self, source: Model, shells: Iterable[tuple[Frame, Model]]) -> Robot:
        """All of it."""
        model, identity = self.model, Transform()
        leaves, parts = self.reader.parts(model, identity)
        inner = [*(self._shell(shell, frame.name) for frame, shell in shells), *self._carried_shells()]
        of_urdf = source if self.format is Format.URDF else Model(name="")
        links, joints = ({part.name for part in parts} for parts in (of_urdf.links, of_urdf.joints))
        return Robot(
            name=model.name,
            format=self.format,
            world=self.graph.pose(WORLD, MODEL, kind="world", base="model"),
            bodies={link.name: self._body(link) for link in model.links},
            joints={joint.name: self._joint(joint) for joint in model.joints if not _is_made_for_static(joint, model)},
            frames={frame.name: self._frame(frame, links, joints) for frame in model.frames},
            models=frozenset(part.name for part in inner),
            leaves=leaves,
            parts=(*parts, *inner),
            where=self.reader.place(model),
        )

    def _body(self, link: Link) -> Body:
        frame = self.graph.pose(link.name, MODEL, base="model")
        leaves, parts = self.reader.parts(link, frame)
        mass = self._mass(link.inertial, link.name)
        return Body(link.name, frame, mass, leaves, parts, self.reader.place(link))

    def _mass(self, inertial: Inertial | None, link: str) -> Mass:
        inertial = inertial or Inertial()
        pose = self.graph.resolve(inertial.pose, link, MODEL, base="model")
        solid = placed(written_solid(inertial, Format.SDF), pose)
        return Mass(solid, bool(inertial.auto), self.reader.place(inertial))

    def _joint(self, joint: Joint) -> JointView:
        frame = self.graph.pose(joint.name, MODEL, kind="joint", base="model")
        leaves, parts = self.reader.parts(joint, frame)
        return JointView(
            joint.name,
            joint.type,
            self._end(joint.parent),
            self._end(joint.child),
            frame,
            tuple(self._axes(joint, frame)),
            joint_leaves(joint, leaves),
            parts,
            self.reader.place(joint),
        )

    def _end(self, name: str | None) -> str:
        """The link that an end of a joint moves with."""
        return self.graph.body(name or WORLD)

    def _axes(self, joint: Joint, frame: Transform) -> Iterator[Vector3]:
        for axis in axes_of(joint):
            turn = frame
            if axis.expressed_in:
                turn = self.graph.pose(axis.expressed_in, MODEL, kind="frame", base="model")
            yield unit(turn.rotate(direction(axis, Format.SDF)))

    def _frame(self, frame: Frame, links: Collection[str], joints: Collection[str]) -> NamedFrame:
        """The frame; `links` and `joints` are the names of those that the file had as URDF."""
        return NamedFrame(
            frame.name,
            self.graph.body(frame.name, kind="frame"),
            self.graph.pose(frame.name, MODEL, kind="frame", base="model"),
            was_link=frame.name in links,
            was_joint=frame.name in joints,
            where=self.reader.place(frame),
        )

    def _shell(self, shell: Model, name: str) -> Part:
        """A nested model without its links, joints and frames."""
        leaves, parts = self.reader.parts(shell, Transform())
        inside = {f"{part.kind}[{part.name}]": Leaf(THERE, where=part.where) for part in parts}
        inside |= {f"{part.kind}[{part.name}]/{path}": leaf for part in parts for path, leaf in part.leaves.items()}
        return Part("model", name, {**leaves, **inside}, self.reader.place(shell))

    def _carried_shells(self) -> Iterator[Part]:
        """The same of nested models that traveled in URDF."""
        for frame in self.model.frames:
            for element in _carried(frame):
                if element.name == "model":
                    part = self.reader.element(element_xml(element), "model", self.reader.place(frame), Transform())
                    yield Part("model", frame.name, part.leaves, part.where, carried=True)


def _resolve(graph: FrameGraph, pose: Pose, holder: Transform) -> Transform:
    """Where a pose is in the model, which is in the frame that `holder` places unless it names another."""
    if pose.relative_to:
        holder = graph.pose(pose.relative_to, MODEL, kind="joint", base="model")
    return holder.compose(Transform.from_pose(pose))


def _carried(node: Node) -> Iterator[Element]:
    for part in node.opaque:
        if is_carrier(part, "sdf"):
            yield from (piece.element for piece in unpack(part) if piece.element)


def _is_made_for_static(joint: Joint, model: Model) -> bool:
    """Whether it holds a link of a static model to the world, where it stands anyway."""
    return bool(model.static) and joint.type == "fixed" and WORLD in (joint.parent, joint.child)
