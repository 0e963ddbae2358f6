"""Poses in another frame or notation: those of a link or joint, and those in untyped elements such as projectors."""

import math
from collections.abc import Callable
from functools import cache, partial
from typing import Protocol, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    OPAQUE,
    Collision,
    Element,
    Inertial,
    Joint,
    Light,
    Link,
    Node,
    Opaque,
    Pose,
    ReferenceChange,
    Sensor,
    Visual,
    map_references,
    rewrite,
)
from twinform.ir.frames import FrameGraph, Kind
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import NAMESPACE, to_element
from twinform.passes.shared.nodes import map_elements
from twinform.request_options import UrdfVersion
from twinform.schemas import Context, element_xml, format_value, reader, table


def in_radians(transform: Transform, relative_to: str | None = None) -> Pose:
    """The pose in the notation of URDF and SDF before 1.9: numbers as they were read, but angles in radians."""
    written = transform.notation
    if written is None:
        return transform.to_pose(relative_to)
    rpy = written.rpy
    if written.quat_xyzw is not None:
        rpy = transform.rpy()
    elif written.degrees and rpy is not None:
        rpy = (math.radians(rpy[0]), math.radians(rpy[1]), math.radians(rpy[2]))
    return Pose.unchecked(xyz=written.xyz, rpy=rpy, relative_to=relative_to, source=written.source)


def in_urdf(transform: Transform, relative_to: str | None, version: UrdfVersion) -> Pose:
    """The pose in the notation of a version of URDF: a quaternion stays one where that has quaternions."""
    written = transform.notation
    if version == "1.0" or written is None or written.quat_xyzw is None:
        return in_radians(transform, relative_to)
    return Pose.unchecked(xyz=written.xyz, quat_xyzw=written.quat_xyzw, relative_to=relative_to, source=written.source)


POSE = "pose"
"""The annotation with the frame and notation in which SDF wrote the pose of a part."""


def pose_attributes(written: Pose | None) -> dict[str, str | None]:
    """The attributes of the annotation on a pose; none for the default frame and notation."""
    if written is None or (written.relative_to is written.degrees is written.rotation_format is None):
        return {}
    degrees = None if written.degrees is None else str(written.degrees).lower()
    attributes = {"relative_to": written.relative_to, "degrees": degrees, "rotation_format": written.rotation_format}
    return {name: value for name, value in attributes.items() if value is not None}


def as_annotated(transform: Transform, annotation: Element | None, relative_to: str | None) -> Pose | None:
    """The pose in the notation of an annotation; None for the identity, which need not be written."""
    if annotation is None or not (annotation.get("degrees") or annotation.get("rotation_format")):
        pose = transform.to_pose(relative_to)
        return None if pose == Pose.unchecked() else pose
    degrees, form = annotation.get("degrees"), annotation.get("rotation_format")
    plain = transform.to_pose()
    update: dict[str, object] = {"degrees": None if degrees is None else degrees == "true", "rotation_format": form}
    if form == "quat_xyzw":
        update |= {"rpy": None, "quat_xyzw": transform.quaternion()}
    elif degrees == "true":
        roll, pitch, yaw = transform.rpy()
        update["rpy"] = (math.degrees(roll), math.degrees(pitch), math.degrees(yaw))
    # A pose in SDF is one text of six or seven numbers; with a rotation in another notation it
    # cannot leave the zeros out.
    return plain.copy(**{**update, "xyz": plain.xyz or (0.0, 0.0, 0.0), "relative_to": relative_to})


BODY = "body"
"""The annotation on a link of URDF called `world` that is a link in SDF too, and not the world."""
FRAME = "frame"
"""The annotation on a link that is a frame in SDF, with what it is attached to, if not the joint's parent."""
NESTED = "nested"
"""The annotation on a link that is the frame of a nested model in SDF, with what else that model has."""
LINK = "link"
"""The annotation on a frame of SDF that is a link in URDF, attached to the frame that is its joint."""
OFFSET = "offset"
"""The annotation on a link, fixed joint or model with the pose of its frame in SDF relative to that in URDF."""


def offset_attributes(offset: Transform) -> dict[str, str | None]:
    """The offset as attributes: meters and radians."""
    pose = in_radians(offset)
    return {name: format_value(value) for name in ("xyz", "rpy") if (value := getattr(pose, name)) is not None}


def read_offset(annotation: Element) -> Transform:
    """The offset of an annotation, which may have been edited.

    Raises:
        ValueError: it is not three numbers.
    """
    return Transform.from_pose(
        Pose.unchecked(xyz=read_vector(annotation.get("xyz")), rpy=read_vector(annotation.get("rpy")))
    )


def read_vector(text: str | None) -> Vector3:
    """Return the three numbers of a text; zeros where there is none.

    Raises:
        ValueError: it is not three numbers.
    """
    if text is None:
        return (0.0, 0.0, 0.0)
    x, y, z = map(float, text.split())
    # The file may have been edited, perhaps maliciously: `nan` would spread to every pose of the link.
    if not all(map(math.isfinite, (x, y, z))):
        raise ValueError(f"{text!r} is not three numbers")
    return (x, y, z)


AnyNode = TypeVar("AnyNode", bound=Node)
Posed = Inertial | Visual | Collision | Sensor | Light
AnyPosed = TypeVar("AnyPosed", Inertial, Visual, Collision, Sensor, Light)
Base = tuple[str, Kind]
_FRAME_ATTRIBUTES = ("relative_to", "frame")
"""The attributes that name the frame of a pose, since SDF 1.7 and before."""
Keep = Callable[[str, Pose], tuple[Element, ...]]
"""A function of a message and the old pose that returns what to write beside the moved pose."""
POSE_ANNOTATION = f"{{{NAMESPACE}}}{POSE}"
"""The annotation in an untyped element whose pose was in another frame or notation in the source."""


def _as_named(name: str) -> tuple[str, Kind]:
    return name, "frame"


@dataclass(frozen=True, slots=True)
class ElementPoses:
    """Moves the poses in opaque parts of one link or joint, whose frame becomes `base`."""

    graph: FrameGraph
    holder: str
    base: tuple[str, Kind]
    keep: Keep
    kind: Kind = "link"
    frame: Callable[[str], tuple[str, Kind]] = _as_named
    """The frame graph's name of a frame that an annotation names."""
    stays: frozenset[str] = frozenset()
    """Frames whose poses need not move."""

    def parts(self, parts: tuple[Opaque, ...], *, still: bool) -> tuple[Opaque, ...]:
        """The opaque parts of the link with moved poses; with `still`, only poses that name a frame move."""
        if not parts:
            return parts

        def move(element: Element) -> Element:
            return element if element.name[0] == "{" else self._move(element, Transform(), moves=not still)

        return map_elements(parts, move)

    def sensor(self, sensor: Sensor, written: Pose | None) -> Sensor:
        """A sensor of the link with the poses inside that name a frame moved into the frame of the sensor."""
        if not any(_names_frame(part.element) or _is_annotated(part.element) for part in sensor.opaque if part.element):
            return sensor
        placed = self._resolve(written)

        def move(element: Element) -> Element:
            return self._move(element, placed, moves=False) if element.name[0] != "{" else element

        return sensor.copy(opaque=map_elements(sensor.opaque, move))

    def _move(self, element: Element, holder: Transform, *, moves: bool) -> Element:
        """The element with its poses moved: into `base` if it `moves`, else those that name a frame into `holder`."""
        children = tuple(
            child if child.name == "pose" or child.name[0] == "{" else self._move(child, holder, moves=False)
            for child in element.children
        )
        # A pose may stand at any depth of an element that has no class (a camera in a sensor, an
        # emitter in a link). Only the outermost is in the frame of the link; each further one is in
        # that of the element around it.
        pose, annotation = element.find("pose"), element.find(POSE_ANNOTATION)
        if annotation is not None:
            return self._as_annotated(element, children, annotation, holder, pose, moves=moves)
        if pose is not None and not moves and _frame_of(pose) in _own_frames(element):  # of SDF 1.5 and 1.6
            return element.copy(children=children)
        if pose is not None and _frame_of(pose) in self.stays:
            return element.copy(children=children)
        names_frame = pose is not None and _frame_of(pose) is not None
        if not names_frame and not (moves and (pose is not None or element.name in link_elements("pose"))):
            return element.copy(children=children) if children != element.children else element
        read = Pose.unchecked() if pose is None else read_pose(pose)
        in_base = self._resolve(read)
        made = to_element(holder.inverse().compose(in_base).to_pose(), "pose", "sdf")
        children = tuple(made if child is pose else child for child in children)
        if pose is None:
            return element.copy(children=(made, *children))
        message = f"the pose of <{element.name}> of {self.kind} {self.holder!r} is in another frame"
        return element.copy(children=(*children, *self.keep(message, read)))

    def _as_annotated(
        self,
        element: Element,
        children: tuple[Element, ...],
        annotation: Element,
        holder: Transform,
        pose: Element | None,
        *,
        moves: bool,
    ) -> Element:
        """The element with its pose in the frame and notation of its annotation, and without the annotation."""
        read = Pose.unchecked() if pose is None else read_pose(pose)
        placed = self._resolve(read) if moves or read.relative_to else holder.compose(Transform.from_pose(read))
        name = annotation.get("relative_to")
        around, kind = self.frame(name) if name else ("", "frame")
        known = bool(name) and self.graph.knows(around)
        if known:
            here = self.graph.pose(self.base[0], around, kind=self.base[1], base=kind).compose(placed)
        else:
            here = placed if moves else holder.inverse().compose(placed)
        made = to_element(as_annotated(here, annotation, name if known else None) or Pose.unchecked(), "pose", "sdf")
        rest = tuple(made if child is pose else child for child in children if child is not annotation)
        return element.copy(children=rest if pose is not None else (made, *rest))

    def _resolve(self, pose: Pose | None) -> Transform:
        return self.graph.resolve(pose, self.holder, self.base[0], kind=self.kind, base=self.base[1])


@cache
def link_elements(part: str) -> frozenset[str]:
    """The untyped elements of a link that may have a part such as `pose` or `@name`."""
    facts = table("sdf")
    # Taken from the facts tables, so that a new element of a link is moved without a change here.
    rows = [row for row in facts.definitions["link"].children if row.place is None]
    return frozenset(row.name for row in rows if any(inner.name == part for inner in facts.resolve(row).rows))


def _frame_of(pose: Element) -> str | None:
    return next((value for name in _FRAME_ATTRIBUTES if (value := pose.get(name))), None)


def _own_frames(element: Element) -> frozenset[str]:
    return frozenset(child.get("name") or "" for child in element.find_all("frame"))


def _names_frame(element: Element) -> bool:
    """Whether a pose in the element names its frame, carriers aside."""
    if element.name[0] == "{":
        return False
    own = element.name == "pose" and _frame_of(element) is not None
    return own or any(map(_names_frame, element.children))


def _is_annotated(element: Element) -> bool:
    return any(each.name == POSE_ANNOTATION for each in element.walk())


def read_pose(element: Element) -> Pose:
    """The pose that an element defines; SDF before 1.7 calls its frame `frame`."""
    # The findings are thrown away: this element was checked when the file was read.
    context = Context(DiagnosticSink(), "", "sdf", table("sdf").newest)
    pose = Pose.unchecked(**reader("sdf", context.version).read(element_xml(element), context, "pose", Pose))
    return pose.copy(relative_to=_frame_of(element), opaque=())


def map_frames(node: AnyNode, change: ReferenceChange) -> AnyNode:
    """The node with every reference changed, in the poses of its opaque parts too."""
    return rewrite(map_references(node, change), Node, partial(_map_opaque_poses, change), having=OPAQUE)


def _map_opaque_poses(change: ReferenceChange, node: AnyNode) -> AnyNode:
    if not node.opaque:
        return node
    return node.copy(opaque=map_elements(node.opaque, partial(_map_element, change)))


def _map_element(change: ReferenceChange, element: Element) -> Element:
    attributes = element.attributes
    if element.name == "pose":
        follows = _FRAME_ATTRIBUTES
        attributes = tuple((name, change("any", text) if name in follows else text) for name, text in attributes)
    children = tuple(_map_element(change, child) for child in element.children)
    return element.copy(attributes=attributes, children=children)


class Write(Protocol):
    """Writes the pose of a part in the new frame."""

    def __call__(self, holder: AnyPosed, tag: str, transform: Transform, /) -> AnyPosed:
        """The part, whose element is called `tag`, at a place in the new frame; unchanged if its pose is right."""
        ...


@dataclass(frozen=True, slots=True)
class Rebasing:
    """Moves the poses in one link or joint into the frame `base`.

    `write` writes the poses of typed parts, `elements` those of untyped ones.
    """

    graph: FrameGraph
    name: str
    kind: Kind
    base: Base
    elements: ElementPoses
    write: Write
    stays: Callable[[Posed], bool]
    """Whether a part can be skipped where the frame stays the same."""

    def link(self, link: Link) -> Link:
        """The link with the poses of its parts moved; its own pose is left to the caller."""
        # Most link frames are on their joints already, and then the link can be skipped.
        still = self.graph.pose(link.name, self.base[0], base=self.base[1]).is_identity
        update: dict[str, object] = {
            "inertial": link.inertial and self._move(link.inertial, "inertial", still=still),
            "visuals": tuple(self._move(visual, "visual", still=still) for visual in link.visuals),
            "collisions": tuple(self._move(collision, "collision", still=still) for collision in link.collisions),
            "sensors": tuple(self._sensor(one, still=still) for one in link.sensors),
            "lights": tuple(self._move(light, "light", still=still) for light in link.lights),
            "opaque": self.elements.parts(link.opaque, still=still),
        }
        return link.copy(**update)

    def joint(self, joint: Joint) -> Joint:
        """The joint with the poses of its sensors moved."""
        moved = tuple(self._sensor(one, still=True) for one in joint.sensors)
        return joint.copy(sensors=moved) if moved else joint

    def _sensor(self, sensor: Sensor, *, still: bool) -> Sensor:
        return self.elements.sensor(self._move(sensor, "sensor", still=still), sensor.pose)

    def _move(self, holder: AnyPosed, tag: str, *, still: bool) -> AnyPosed:
        if still and self.stays(holder):
            return holder
        pose: Pose | None = holder.pose
        transform = self.graph.resolve(pose, self.name, self.base[0], kind=self.kind, base=self.base[1])
        return self.write(holder, tag, transform)
