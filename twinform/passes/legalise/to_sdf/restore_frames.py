"""Reverse conversion of poses: restoring how the SDF source wrote them."""

from collections.abc import Iterator
from dataclasses import field
from typing import ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Axis, Element, Format, Frame, Inertial, Joint, Link, Model, Node, Pose, replace_fields, rewrite
from twinform.ir.defaults import direction
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph, Kind
from twinform.ir.scopes import SCOPE
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.annotations import (
    OLD_NAME,
    SYNTHESIZED,
    came_from,
    find_annotation,
    is_synthesized,
    with_annotation,
    without_annotation,
)
from twinform.passes.carriers.carriers import bits_of_ours
from twinform.passes.carriers.token_mass import has_token_mass
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.sdf_versions.version_pass import is_foreign
from twinform.passes.shared.joint_ends import ENDS
from twinform.passes.shared.nodes import map_elements
from twinform.passes.shared.poses import (
    NESTED,
    OFFSET,
    POSE,
    POSE_ANNOTATION,
    AnyPosed,
    Base,
    ElementPoses,
    Posed,
    Rebasing,
    as_annotated,
    pose_attributes,
    read_offset,
)

AnyNode = TypeVar("AnyNode", bound=Node)

_AXES = ("axis", "axis2")
# A NUL byte, since no name in XML can contain one.
_BASE = "\0"
"""Behind the name of a link it calls the frame that the link had in SDF; alone, the frame that the model had."""


class RestoreFrames(ModelPass):
    """Write poses as SDF wrote them, in a model that came from there: each in its frame and notation, nothing moves.

    Changes: 1. a link has the frame that an annotation gives it, and all that is in it, or was added to it since, is
    posed in that frame; 2. links are posed in the model's frame, joints in their child's, frames in what they are
    attached to, or each in the frame that an annotation names; 3. an axis is expressed in the frame that an annotation
    names; 4. the ends of a joint are the frames that an annotation names, if they still move with these links.
    Never touches: models that did not come from SDF.
    Diagnostics: `stale-carrier` for annotations whose frames are gone, or go round in a circle since an edit.
    """

    name: ClassVar[str] = "restore-frames"
    old_words: bool = False
    """Whether the model's frame is called as before 1.7 where an annotation has that."""
    is_world: bool = False
    """Whether the model stands for a world, in which poses may be relative to `world`."""

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model as its SDF file has it."""
        if not came_from(model, Format.SDF):
            return self._with_offsets(model, sink)
        model = _without_made_root(model)
        try:
            made = self._restoring(model, sink).run()
            # Each annotation names a frame that was there; after an edit two of them may name each
            # other. Then the usual frames are taken for all.
            if next(FrameGraph(made).problems(), None) is None:
                return made
            message = f"the frames in which poses of {model.name!r} were written go round in a circle by now"
            sink.report(rules.STALE_CARRIER, message, model.location, found=model.name)
            return self._restoring(_without_frames(model), sink).run()
        except FrameError as error:
            error.report(sink)
            return model

    def _restoring(self, model: Model, sink: DiagnosticSink) -> "_Restoring":
        return _Restoring(model, sink, old_words=self.old_words, is_world=self.is_world)

    def _with_offsets(self, model: Model, sink: DiagnosticSink) -> Model:
        """A model of URDF whose links have other frames in the SDF file that it came back from."""
        if all(find_annotation(each, OFFSET) is None for each in _framed(model)):
            return model
        try:
            return _Restoring(_with_noted_frames(model), sink).run()
        except FrameError as error:
            error.report(sink)
            return model


@dataclass(slots=True)
class _Restoring:
    """One run over one model. `frames` are the names by which the graph knows the frames that SDF has."""

    model: Model
    sink: DiagnosticSink
    old_words: bool = False
    is_world: bool = False
    frames: dict[str, Base] = field(default_factory=dict[str, Base])

    def run(self) -> Model:
        helpers = tuple(self._helpers())
        posed = {
            "frames": (*self.model.frames, *helpers),
            "placement_frame": None,
        }  # as yet the root is where its pose puts it
        graph = FrameGraph(self.model.copy(**posed))
        self.frames = {helper.name.removesuffix(_BASE) or MODEL: (helper.name, "frame") for helper in helpers}
        model = self.model.copy(
            links=tuple(self._link(link, graph) for link in self.model.links),
            joints=tuple(self._joint(joint, graph) for joint in self.model.joints),
            frames=tuple(self._frame(frame, graph) for frame in self.model.frames),
        )
        placement = self._placement(graph)
        name, kind = self._in_frame(placement) if placement else self._base(MODEL, "model")
        placed = graph.pose(name, WORLD, kind=kind, base="world")
        pose = as_annotated(placed, find_annotation(model, POSE), None)
        model = model.copy(pose=pose, placement_frame=placement)
        return without_annotation(model, OFFSET, POSE)

    def _placement(self, graph: FrameGraph) -> str | None:
        """The frame of the model that its pose is for, if it names one that is there."""
        name = self.model.placement_frame
        if name and not graph.knows(self._in_frame(name)[0]):
            self._stale(f"there is no frame {name!r} any more, by which {self.model.name!r} was placed", self.model)
            return None
        return name

    def _helpers(self) -> Iterator[Frame]:
        """A frame for each one that SDF has elsewhere than URDF."""
        own = self._offset(self.model)
        if own is not None:  # as yet the model is where its root is
            yield Frame.unchecked(name=_BASE, pose=own.to_pose())
        for each in _framed(self.model):
            offset = self._offset(each)
            if offset is not None:
                yield Frame.unchecked(name=each.name + _BASE, attached_to=each.name, pose=offset.to_pose())

    def _offset(self, node: Link | Joint | Frame | Model) -> Transform | None:
        found = find_annotation(node, OFFSET)
        if found is None:
            return None
        if isinstance(node, Joint) and node.type != "fixed":  # its motion is about the frame that it has here
            self._stale(f"joint {node.name!r} was fixed when its frame was kept", node)
            return None
        try:
            return read_offset(found)
        except ValueError as error:
            self._stale(f"the kept offset of {node.name!r} is invalid: {error}", node)
            return None

    def _stale(self, message: str, node: Node) -> None:
        self.sink.report(rules.STALE_CARRIER, message, node.location)

    def _base(self, name: str, kind: Kind) -> Base:
        return self.frames.get(name, (name, kind))

    def _in_frame(self, name: str) -> Base:
        return self._base(name, "frame")

    def _written_in(self, node: Node, graph: FrameGraph, usual: str) -> str | None:
        """The frame that an annotation on a node names; None for the usual one."""
        found = find_annotation(node, POSE)
        name = found.get("relative_to") if found else None
        if not name:
            return None
        if isinstance(node, Inertial):
            self._stale(f"an inertial is posed in its link, and cannot be in {name!r}", node)
            return None
        is_known = self._is_in_world(node) if name == WORLD else graph.knows(self._in_frame(name)[0])
        if not is_known:
            self._stale(f"there is no frame {name!r} any more, in which a pose was written", node)
            return None
        return name

    def _is_in_world(self, node: Node) -> bool:
        """Whether something stands in a world itself, as a model in it does, and not in a model."""
        outermost = isinstance(node, Joint | Frame) and SCOPE not in node.name.removesuffix(f"{SCOPE}{MODEL}")
        return self.is_world and outermost

    def _own_pose(self, node: Link | Joint | Frame, kind: Kind, usual: str, graph: FrameGraph) -> Pose | None:
        """The pose of a node in the frame that it is to be written in."""
        written_in = self._written_in(node, graph, usual)
        (name, own), (base, held) = self._base(node.name, kind), self._in_frame(written_in or usual)
        placed = graph.pose(name, base, kind=own, base=held if base != WORLD else "world")
        return as_annotated(placed, find_annotation(node, POSE), written_in)

    def _link(self, link: Link, graph: FrameGraph) -> Link:
        base = self._base(link.name, "link")
        inside = self._rebasing(graph, link.name, "link", base).link(link)
        usual = around(link.name, graph)
        pose = self._own_pose(link, "link", usual, graph)
        if usual != MODEL and not (pose and pose.relative_to):  # until it stands in that model, if it is in one
            pose = (pose or Pose.unchecked()).copy(relative_to=usual)
        # An automatic inertia is in the link's own frame whatever that is; its pose has no meaning
        # to move.
        inertial = link.inertial if link.inertial and link.inertial.auto else inside.inertial
        return without_annotation(inside.copy(pose=pose, inertial=inertial), OFFSET, POSE)

    def _rebasing(self, graph: FrameGraph, name: str, kind: Kind, base: Base) -> Rebasing:
        def write(holder: AnyPosed, _tag: str, transform: Transform) -> AnyPosed:
            return self._write(graph, base, holder, transform)

        elements = ElementPoses(graph, name, base, _nothing_beside, kind, self._in_frame)
        return Rebasing(graph, name, kind, base, elements, write, _is_left)

    def _write(self, graph: FrameGraph, base: Base, holder: AnyPosed, transform: Transform) -> AnyPosed:
        written_in = self._written_in(holder, graph, "")
        if written_in is not None:
            name, kind = self._in_frame(written_in)
            transform = graph.pose(base[0], name, kind=base[1], base=kind).compose(transform)
        pose = as_annotated(transform, find_annotation(holder, POSE), written_in)
        return without_annotation(holder.copy(pose=pose), POSE)

    def _joint(self, joint: Joint, graph: FrameGraph) -> Joint:
        base = self._base(joint.name, "joint")
        inside = self._rebasing(graph, joint.name, "joint", base).joint(joint)
        ends = self._frames_at_ends(joint, graph)
        usual = str(ends.get("child", joint.child or WORLD))
        pose = self._own_pose(joint, "joint", usual, graph)
        update: dict[str, object] = {**ends, "pose": pose}
        for name in _AXES:
            update[name] = self._axis(joint, name, graph)
        return without_annotation(inside.copy(**update), OFFSET, POSE, ENDS, *_AXES)

    def _frames_at_ends(self, joint: Joint, graph: FrameGraph) -> dict[str, object]:
        """The frames at the ends of a joint, as far as they still move with its links."""
        found = find_annotation(joint, ENDS)
        ends: dict[str, object] = {}
        for end in ("parent", "child"):
            name, link = found.get(end) if found else None, getattr(joint, end)
            if name is None:
                continue
            # If the frame moves with another link by now, the edit of either of them counts, and
            # the joint stays on the link.
            if graph.knows(name) and graph.body(name, kind="frame") == link:
                ends[end] = name
            else:
                self._stale(f"the {end} of joint {joint.name!r} was {name!r}, which does not move with {link!r}", joint)
        return ends

    def _axis(self, joint: Joint, field: str, graph: FrameGraph) -> Axis | None:
        axis: Axis | None = getattr(joint, field)
        found = find_annotation(joint, field)
        old = found is not None and found.get(OLD_NAME) == "true"
        name = (found and found.get("expressed_in")) or (MODEL if old else None)
        if axis is None or not name:
            return axis
        base, kind = self._in_frame(name)
        if not graph.knows(base):
            self._stale(f"there is no frame {name!r} any more, in which the axis of {joint.name!r} was written", joint)
            return axis
        turn = graph.pose(joint.name, base, kind="joint", base=kind)
        frame = {OLD_NAME: True} if old and self.old_words else {"expressed_in": name}
        return axis.copy(**{"xyz": rounded(turn.rotate(direction(axis, Format.SDF))), **frame})

    def _frame(self, frame: Frame, graph: FrameGraph) -> Frame:
        if find_annotation(frame, NESTED) is None:
            pose = self._own_pose(frame, "frame", frame.attached_to or around(frame.name, graph), graph)
        else:  # a model is posed in the one around it
            usual = around(frame.name.removesuffix(f"{SCOPE}{MODEL}"), graph)
            pose = self._own_pose(frame, "frame", usual, graph) or Pose.unchecked()
            pose = pose.copy(relative_to=pose.relative_to or usual)
        return without_annotation(frame.copy(pose=pose), OFFSET, POSE)


def _framed(model: Model) -> tuple[Link | Joint | Frame, ...]:
    """All that has a frame in the model."""
    return (*model.links, *model.joints, *model.frames)


def around(name: str, graph: FrameGraph) -> str:
    """The frame of the model that something of this name is in: a nested one, if the name is scoped."""
    scope = name.rpartition(SCOPE)[0]
    own = f"{scope}{SCOPE}{MODEL}"
    return own if scope and graph.knows(own) else MODEL


def _nothing_beside(_message: str, _pose: Pose) -> tuple[Element, ...]:
    return ()


def _is_left(holder: Posed) -> bool:
    """Whether a pose may stay as it is where its frame does."""
    return find_annotation(holder, POSE) is None and not (holder.pose and holder.pose.relative_to)


def _without_made_root(model: Model) -> Model:
    """The model without the link that was synthesized because URDF needs one, if that still holds nothing."""
    link = model.links[0] if len(model.links) == 1 else None
    if link is None or not is_synthesized(link):
        return model
    held = link.visuals or link.collisions or link.sensors or link.lights or len(link.opaque) > 1
    weighs = link.inertial and link.inertial.mass and not has_token_mass(link.inertial)
    if held or model.joints or weighs:  # it is a link like others by now
        return model.copy(links=(without_annotation(link, SYNTHESIZED),))
    frames = (_off_root(frame, link.name) for frame in model.frames)
    return model.copy(links=(), frames=tuple(frames), canonical_link=None)


def _off_root(frame: Frame, root: str) -> Frame:
    """The frame in the model's, if it was in the link that stood for that."""
    pose = frame.pose
    if pose is not None and pose.relative_to == root:
        pose = pose.copy(relative_to=None)
    return frame.copy(attached_to=None if frame.attached_to == root else frame.attached_to, pose=pose)


def _with_noted_frames(model: Model) -> Model:
    """The model with an annotation on all that is posed in a frame that it names: there its pose is to be written."""

    def note(node: Node) -> Node:
        pose: Pose | None = getattr(node, "pose", None)
        noted = replace_fields(node, opaque=map_elements(node.opaque, note_element))
        if pose is None or not pose.relative_to or find_annotation(node, POSE) is not None:
            return noted
        return with_annotation(noted, POSE, attributes=pose_attributes(pose))

    def note_element(element: Element) -> Element:
        if is_foreign(element):
            return element
        children = tuple(map(note_element, element.children))
        pose = element.find("pose")
        if pose and pose.get("relative_to"):
            children = (*children, Element.unchecked(name=POSE_ANNOTATION, attributes=pose.attributes))
        return replace_fields(element, children=children)

    return rewrite(model, Node, note)


def _without_frames(node: AnyNode) -> AnyNode:
    """The node without annotations of the frames in which it was written, on it and in it."""
    annotations = (POSE, ENDS, *_AXES)
    return rewrite(node, Node, lambda each: without_annotation(each, *annotations), having=bits_of_ours(*annotations))
