"""Poses in the default frame, as before SDF 1.7, where frames have no names."""

from typing import Any, ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, rules
from twinform.ir import (
    Collision,
    Document,
    Element,
    Include,
    Inertial,
    Joint,
    Light,
    Link,
    Model,
    Pose,
    Sensor,
    Visual,
    World,
    count_parts,
    rewrite,
)
from twinform.ir.frames import MODEL, WORLD, FrameGraph, Kind
from twinform.ir.transform import Transform
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import NAMED_FRAMES, VersionPass
from twinform.passes.shared.nodes import piece, pose_piece
from twinform.passes.shared.poses import ElementPoses
from twinform.schemas import Version

Posed = TypeVar("Posed", Visual, Collision, Sensor, Light, Inertial, Include, Link, Joint, Model)
Holder = TypeVar("Holder", Model, World)

_PLACEMENT: Version = (1, 8)
"""Since this version a model may say which of its frames its pose is about."""
_ORIGIN = (0.0, 0.0, 0.0)
_IN_LINKS = ("visuals", "collisions", "sensors", "lights")


class PlaceAbsolutely(VersionPass):
    """Give every pose in the one frame that SDF before 1.7 gives it in.

    Changes: 1. links and nested models are posed in the model, models of a world in the world; 2. joints in their child
    link, but for fixed ones whose child is in an include, which lose their pose; 3. visuals, collisions, inertials,
    sensors and lights in their link, and so on; 4. frames go; 5. a model that is placed by one of its frames is placed
    by its own, which is all that happens in the conversion to 1.7.
    Never touches: poses that name no frame.
    Diagnostics: `older-version` for each frame, `include-not-expanded` where only an include knows a frame; in the
    ledger `other-words` for each pose.
    """

    name: ClassVar[str] = "place-absolutely"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document without named frames."""
        named = self.number >= NAMED_FRAMES
        place = _Placer(keeper, named=named)
        document = rewrite(document, World, place.world)
        models = tuple(place.model(place.root(model)) for model in document.models)
        return document.copy(models=models)


@dataclass(frozen=True, slots=True)
class _Placer:
    """Places models from the outside in, because an outer pose may be in a frame of an inner model."""

    keeper: VersionKeeper
    named: bool

    def world(self, world: World) -> World:
        graph = FrameGraph(world)
        place = _HolderPoses(graph, WORLD, "world", self)
        update = self._members(world, place)
        if not self.named:
            update["lights"] = tuple(map(place.resolved, world.lights))
        return self._without_frames(world.copy(**update))

    def root(self, model: Model) -> Model:
        if not model.placement_frame:
            return model
        where = FrameGraph(model).pose(MODEL, WORLD, kind="model", base="world")
        return self.replace(model, where, None)

    def model(self, model: Model) -> Model:
        if self.named and not model.models:
            return model
        place = _HolderPoses(FrameGraph(model), MODEL, "model", self)
        update = self._members(model, place)
        if not self.named:
            update["links"] = tuple(
                _HolderPoses(place.graph, link.name, "link", self).link(link) for link in model.links
            )
        return self._without_frames(model.copy(**update))

    def _members(self, holder: Holder, place: "_HolderPoses") -> dict[str, Any]:
        """The updated fields that models and worlds have in common."""
        update: dict[str, Any] = {"models": tuple(self.model(place.model(model)) for model in holder.models)}
        if self.named:
            return update
        update["includes"] = tuple(map(place.resolved, holder.includes))
        update["joints"] = tuple(
            _HolderPoses(place.graph, joint.name, "joint", self).joint(joint) for joint in holder.joints
        )
        update["opaque"] = place.elements().parts(holder.opaque, still=True)
        return update

    def _without_frames(self, holder: Holder) -> Holder:
        if self.named:
            return holder
        # Last in, first out, so that each frame comes back at its index.
        for index in reversed(range(len(holder.frames))):
            frame = holder.frames[index]
            message = f"frame {frame.name!r} has no place in SDF before 1.7"
            self.keeper.sink.report(rules.OLDER_VERSION, message, frame.location, found=frame.name)
            pieces = [piece(frame, "frame")]
            condition = VersionCondition(since=NAMED_FRAMES, index=index)
            weight = count_parts(frame)
            holder = self.keeper.keep(holder, pieces, condition, rules.OLDER_VERSION, message, frame.location, weight)
        return holder.copy(frames=())

    def replace(self, node: Posed, where: Transform, relative_to: str | None) -> Posed:
        """The node with its pose in another frame, and the written pose in a carrier."""
        written = node.pose
        made = None if where == Transform() and relative_to is None else where.to_pose(relative_to)
        if made is not None:
            made = _in_full(made).copy(source=written.source if written else None)
        changed = node.copy(pose=made)
        pieces, gone = ([pose_piece(written)], ()) if written else ([], ("pose",))
        called = getattr(node, "name", None)
        what = f"{type(node).__name__.lower()} {called!r}" if called else f"the {type(node).__name__.lower()}"
        message = f"the pose of {what} is in a frame that the version cannot name"
        condition = VersionCondition(since=_PLACEMENT if self.named else NAMED_FRAMES, without=gone)
        weight = count_parts(written) if written else 0
        return self.keeper.keep(changed, pieces, condition, rules.OTHER_WORDS, message, node.location, weight)


@dataclass(frozen=True, slots=True)
class _HolderPoses:
    """Poses in the frame of one link, joint, model or world, which is the default frame there."""

    graph: FrameGraph
    holder: str
    kind: Kind
    placer: _Placer

    def resolved(self, node: Posed) -> Posed:
        """A part with its pose in the frame of the holder."""
        pose = node.pose
        if pose is None or pose.relative_to is None:
            return node
        where = self.graph.resolve(pose, self.holder, self.holder, kind=self.kind, base=self.kind)
        return self.placer.replace(node, where, None)

    def model(self, model: Model) -> Model:
        """A nested model with its pose in the frame of the holder."""
        pose = model.pose
        base = pose.relative_to if pose and pose.relative_to and self.placer.named else None
        names = pose is not None and pose.relative_to is not None and not self.placer.named
        if not names and not model.placement_frame:
            return model
        where = self.graph.pose(model.name, base or self.holder, kind="model", base="frame" if base else self.kind)
        return self.placer.replace(model, where, base)

    def link(self, link: Link) -> Link:
        """The link posed in the model, with all that is in it posed in the link."""
        update: dict[str, Any] = {}
        for field in _IN_LINKS:
            parts: tuple[Any, ...] = getattr(link, field)
            if parts:
                update[field] = tuple([self.resolved(part) for part in parts])
        if link.inertial is not None:
            update["inertial"] = self.resolved(link.inertial)
        if link.sensors:
            update["sensors"] = _sensors(link.sensors, update["sensors"], self.elements())
        if link.opaque:
            update["opaque"] = self.elements().parts(link.opaque, still=True)
        link = link.copy(**update)
        if link.pose is None or link.pose.relative_to is None:
            return link
        return self.placer.replace(link, self.graph.pose(link.name, MODEL), None)

    def joint(self, joint: Joint) -> Joint:
        """The joint posed in its child, and its sensors in the joint."""
        if joint.sensors:
            moved = tuple(map(self.resolved, joint.sensors))
            joint = joint.copy(sensors=_sensors(joint.sensors, moved, self.elements()))
        if joint.pose is None or joint.pose.relative_to is None:
            return joint
        # Before 1.7 a joint is posed in its child, and where that is only the file of an include
        # knows. A sensor on the joint measures in its frame, so such a joint is refused like one
        # that moves.
        if joint.type == "fixed" and not joint.sensors and not self.graph.knows(joint.child or WORLD):
            # only an include knows the child, and where between two links a fixed joint is makes no difference
            return self.placer.replace(joint, Transform(), None)
        self.graph.body(joint.child or WORLD, source=joint.source)
        return self.placer.replace(joint, self.graph.pose(joint.name, joint.child or WORLD, kind="joint"), None)

    def elements(self) -> ElementPoses:
        """Moves the poses in untyped parts of the holder."""
        return ElementPoses(self.graph, self.holder, (self.holder, self.kind), self._keep, self.kind)

    def _keep(self, message: str, pose: Pose) -> tuple[Element, ...]:
        """The carrier that stands beside a moved pose of an untyped element."""
        condition = VersionCondition(since=NAMED_FRAMES, instead="pose")
        return self.placer.keeper.keep_element(pose_piece(pose), condition, rules.OTHER_WORDS, message, NOWHERE)


def _in_full(pose: Pose) -> Pose:
    """The pose with the zeros that its text in SDF has anyway."""
    update: dict[str, object] = {"xyz": pose.xyz or _ORIGIN}
    if pose.quat_xyzw is None:
        update["rpy"] = pose.rpy or _ORIGIN
    return pose.copy(**update)


def _sensors(written: tuple[Sensor, ...], moved: tuple[Sensor, ...], elements: ElementPoses) -> tuple[Sensor, ...]:
    return tuple(elements.sensor(new, old.pose) for old, new in zip(written, moved, strict=True))
