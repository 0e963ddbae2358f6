"""A scene: what there is to see of a document, and where it is with every joint at zero.

All frames are in the world's, lengths in meters, angles in radians, colors from 0 to 1. Names are those of SDF: parts
of nested models, and of models in a world, are `model::part`.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from typing import Literal, TypeVar

from twinform.compiler.kinematics import Kinematics, PlacedJoint, degrees_of
from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, DiagnosticSink, Location
from twinform.ir import (
    Collision,
    Color,
    Document,
    Element,
    Empty,
    Format,
    Frame,
    Joint,
    Link,
    Material,
    Model,
    Pose,
    Sensor,
    Vector3,
    Visual,
)
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph, Kind
from twinform.ir.geometry import ShapeNode
from twinform.ir.model import look_up
from twinform.ir.sensor import RENAMED_ELEMENTS
from twinform.ir.solids import Solid, placed, written_solid
from twinform.ir.transform import Transform
from twinform.passes import Pass, Pipeline
from twinform.passes.appearance.materials import classic_materials
from twinform.passes.meshes.limit_sensors import image_size, samples
from twinform.passes.shared.flattening import flatten

Role = Literal["visual", "collision"]


@dataclass(frozen=True, slots=True)
class SceneShape:
    """A visual or collision; `pose` is in the frame of its link."""

    role: Role
    name: str
    pose: Transform
    shape: ShapeNode
    color: Color | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class Ray:
    """The measured part of a ray of a sensor, in the frame of the sensor."""

    start: Vector3
    end: Vector3


@dataclass(frozen=True, slots=True)
class Frustum:
    """The view of a camera along the x axis of its sensor: angles, and the nearest and farthest distance."""

    horizontal: float
    vertical: float
    near: float
    far: float
    pose: Transform = field(default_factory=Transform)


@dataclass(frozen=True, slots=True)
class SceneSensor:
    """A sensor; `pose` is in the frame of the link that it moves with."""

    name: str
    type: str
    link: str
    pose: Transform
    frustums: tuple[Frustum, ...] = ()
    rays: tuple[Ray, ...] = ()
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class SceneLink:
    """A link, the pose of its frame, and its mass in its own frame, which is None for a link without mass."""

    name: str
    pose: Transform
    shapes: tuple[SceneShape, ...] = ()
    mass: Solid | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class SceneJoint(PlacedJoint):
    """A joint of the scene."""

    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class SceneFrame:
    """A named frame, in the frame of the link that it moves with."""

    name: str
    link: str
    pose: Transform
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class Scene:
    """The parts of a document that can be seen; `left_out` says what could not be placed."""

    links: tuple[SceneLink, ...] = ()
    joints: tuple[SceneJoint, ...] = ()
    frames: tuple[SceneFrame, ...] = ()
    sensors: tuple[SceneSensor, ...] = ()
    left_out: tuple[str, ...] = ()

    def kinematics(self) -> Kinematics[SceneJoint]:
        """Return the kinematics of the scene."""
        return Kinematics({link.name: link.pose for link in self.links}, self.joints)


_HORIZONTAL_FOV, _NEAR, _FAR = 1.047, 0.1, 100.0
"""SDF's defaults of a camera, in rad and m."""
_MOST_RAYS = 24
"""So many are drawn of each direction of a scan."""
_FLAT = 1e-6
_WIDEST = math.pi - 1e-3
_LIDARS = frozenset({"ray", "lidar"})


def frustums_of(sensor: Sensor) -> Iterator[Frustum]:
    """Yield the view of each camera of a sensor."""
    for part in sensor.opaque:
        if part.element and part.element.name == "camera":
            yield _make_frustum(part.element)


def rays_of(sensor: Sensor) -> Iterator[Ray]:
    """Yield some rays of a lidar, the outermost among them."""
    for part in sensor.opaque:
        if part.element and RENAMED_ELEMENTS.get(part.element.name, part.element.name) in _LIDARS:
            yield from _make_rays(part.element)


def _make_frustum(camera: Element) -> Frustum:
    width, height = image_size(camera.find("image"))
    horizontal = min(_read_number(camera, "horizontal_fov", _HORIZONTAL_FOV), _WIDEST)
    clip = camera.find("clip")
    near, far = _read_number(clip, "near", _NEAR), _read_number(clip, "far", _FAR)
    # square pixels: tan(v/2) / tan(h/2) = height / width
    vertical = 2 * math.atan(math.tan(horizontal / 2) * height / width) if width and height else horizontal
    return Frustum(horizontal, vertical, near, max(near, far), Transform.from_pose(_read_pose(camera)))


def _make_rays(lidar: Element) -> Iterator[Ray]:
    scan, range_ = lidar.find("scan"), lidar.find("range")
    near, far = _read_number(range_, "min", 0.0), _read_number(range_, "max", 0.0)
    counts = samples(lidar)
    around = [*_choose_angles(scan, "horizontal", counts["horizontal"])]
    for up in _choose_angles(scan, "vertical", counts["vertical"]):
        for aside in around:
            x, y, z = math.cos(up) * math.cos(aside), math.cos(up) * math.sin(aside), math.sin(up)
            yield Ray((near * x, near * y, near * z), (far * x, far * y, far * z))


def _choose_angles(scan: Element | None, direction: str, count: int) -> Iterator[float]:
    element = scan.find(direction) if scan else None
    least, most = _read_number(element, "min_angle", 0.0), _read_number(element, "max_angle", 0.0)
    shown = min(count, _MOST_RAYS) if most - least > _FLAT else 1
    shares = (i / (shown - 1) if shown > 1 else 0.5 for i in range(shown))
    return (least * (1 - share) + most * share for share in shares)  # a difference may be too large for a number


def _read_number(element: Element | None, name: str, usual: float) -> float:
    child = element.find(name) if element else None
    try:
        value = float((child.text or "").strip()) if child else usual
    except ValueError:
        return usual
    return value if math.isfinite(value) else usual


def _read_pose(camera: Element) -> Pose | None:
    """Return the `<pose>` of a camera in its sensor; None if it has none, or one that cannot be read."""
    child = camera.find("pose")
    words = (child.text or "").split() if child else []
    if child is None or len(words) != 6 or child.get("relative_to"):
        return None
    try:
        x, y, z, roll, pitch, yaw = map(float, words)
    except ValueError:
        return None
    return Pose(xyz=(x, y, z), rpy=(roll, pitch, yaw), degrees=child.get("degrees") == "true" or None)


Part = TypeVar("Part", Link, Joint, Frame)


def build_scene(document: Document) -> Scene:
    """Return the scene of a document; included models are in it if the includes were expanded."""
    # The document is shown as it stands: a planar joint is three sliders and no chain of three
    # joints. A second reader in the page, such as urdf-loader, would show what *it* understands, so
    # scenes and conversions share this code.
    document = Pipeline(_choose_passes(document)).run(document, DiagnosticSink())
    work = _SceneBuilder(document.format)
    for world in document.worlds:
        graph = FrameGraph(world)
        for model in world.models:
            work.add_model(model, f"{model.name}::", graph)
        work.add_joints(world.joints, _SceneScope(graph))
        work.add_frames(world.frames, _SceneScope(graph))
    for model in document.models:
        work.add_model(model, f"{model.name}::" if len(document.models) > 1 else "", None)
    return Scene(tuple(work.links), tuple(work.joints), tuple(work.frames), tuple(work.sensors), tuple(work.left_out))


def _choose_passes(document: Document) -> tuple[Pass, ...]:
    """Return the passes that move everything a document means into its fields."""
    if document.format is Format.SDF:
        from twinform.passes.sdf_versions import raise_words  # noqa: PLC0415 - the other format does not need it

        return raise_words(document.version)
    from twinform.passes.legalise.shared_materials import SharedMaterials  # noqa: PLC0415 - see above
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - see above

    return (SharedMaterials.unchecked(carriers=False), FoldGazebo.unchecked(carriers=False))


@dataclass(frozen=True, slots=True)
class _SceneScope:
    """The frames of one model or world; `place` is the pose of its root, and `prefix` begins the names of its parts."""

    graph: FrameGraph
    place: Transform = field(default_factory=Transform)
    prefix: str = ""

    def name(self, name: str) -> str:
        """Return the name of a link or joint in the scene."""
        return name if name in {WORLD, MODEL} else self.prefix + name

    def body(self, name: str | None, kind: Kind = "link") -> str:
        """Return the link that a frame moves with, by its name in this model."""
        return self.graph.body(name or WORLD, kind=kind)

    def frame(self, name: str, kind: Kind = "frame") -> Transform:
        """Return the pose of a frame in the world."""
        return self.place.compose(self.graph.place(name, kind=kind))

    def pose_in_link(self, pose: Pose | None, link: str) -> Transform:
        """Return the pose of a part of a link in the frame of the link."""
        return self.graph.resolve(pose, link, link)

    def pose_of_joint_part(self, pose: Pose | None, joint: Joint, link: str) -> Transform:
        """Return the pose of a part of a joint in the frame of the link that it moves with."""
        return self.graph.resolve(pose, joint.name, link, kind="joint")


@dataclass(slots=True)
class _SceneBuilder:
    """The parts of a scene that were found so far."""

    format: Format
    links: list[SceneLink] = field(default_factory=list[SceneLink])
    joints: list[SceneJoint] = field(default_factory=list[SceneJoint])
    frames: list[SceneFrame] = field(default_factory=list[SceneFrame])
    sensors: list[SceneSensor] = field(default_factory=list[SceneSensor])
    left_out: list[str] = field(default_factory=list[str])

    def add_model(self, model: Model, prefix: str, around: FrameGraph | None) -> None:
        """Add a model; `around` is the frame graph of the world that it is in."""
        try:
            flat = flatten(model, lambda frame, _: frame)
            graph = FrameGraph(flat)
            name, base = (MODEL, graph) if around is None else (model.name, around)
            scope = _SceneScope(graph, base.pose(name, WORLD, kind="model", base="world"), prefix)
        except FrameError as error:
            self.left_out.append(error.message)
            return
        for link in flat.links:
            self._add_if_placed(self._add_link, link, scope)
        self.add_joints(flat.joints, scope)
        self.add_frames(flat.frames, scope)

    def add_joints(self, joints: Iterable[Joint], scope: _SceneScope) -> None:
        """Add joints, and the sensors in them."""
        for joint in joints:
            self._add_if_placed(self._add_joint, joint, scope)

    def add_frames(self, frames: Iterable[Frame], scope: _SceneScope) -> None:
        """Add named frames."""
        for frame in frames:
            self._add_if_placed(self._add_frame, frame, scope)

    def _add_if_placed(self, add: Callable[[Part, _SceneScope], None], part: Part, scope: _SceneScope) -> None:
        try:
            add(part, scope)
        except FrameError as error:
            self.left_out.append(f"{part.name}: {error.message}")

    def _add_link(self, link: Link, scope: _SceneScope) -> None:
        name = scope.name(link.name)
        shapes, mass = tuple(_find_shapes(link, scope)), self._find_mass(link, scope)
        self.links.append(SceneLink(name, scope.frame(link.name, "link"), shapes, mass, link.location))
        for sensor in link.sensors:
            self._add_sensor(sensor, name, scope.pose_in_link(sensor.pose, link.name))

    def _find_mass(self, link: Link, scope: _SceneScope) -> Solid | None:
        if link.inertial is None and self.format is Format.URDF:
            return None
        solid = written_solid(link.inertial, self.format)
        pose = scope.pose_in_link(link.inertial.pose if link.inertial else None, link.name)
        return placed(solid, pose) if solid.mass > 0 and math.isfinite(solid.mass) else None

    def _add_joint(self, joint: Joint, scope: _SceneScope) -> None:
        parent, child = scope.body(joint.parent), scope.body(joint.child)
        frame = scope.frame(joint.name, "joint")
        degrees = tuple(degrees_of(joint, frame, self.format, scope.frame, scope.prefix))
        ends = scope.name(parent), scope.name(child)
        self.joints.append(SceneJoint(scope.name(joint.name), joint.type, *ends, frame, degrees, joint.location))
        for sensor in joint.sensors:
            self._add_sensor(sensor, ends[1], scope.pose_of_joint_part(sensor.pose, joint, child))

    def _add_sensor(self, sensor: Sensor, link: str, pose: Transform) -> None:
        seen = tuple(frustums_of(sensor)), tuple(rays_of(sensor))
        self.sensors.append(SceneSensor(sensor.name or "", sensor.type or "", link, pose, *seen, sensor.location))

    def _add_frame(self, frame: Frame, scope: _SceneScope) -> None:
        link = scope.body(frame.name, "frame")
        pose = scope.graph.pose(frame.name, link, kind="frame")
        self.frames.append(SceneFrame(scope.name(frame.name), scope.name(link), pose, frame.location))


def _find_shapes(link: Link, scope: _SceneScope) -> Iterator[SceneShape]:
    for each in (*link.visuals, *link.collisions):
        shape = each.geometry.shape if each.geometry else None
        if shape is not None and not isinstance(shape, Empty):
            role: Role = "collision" if isinstance(each, Collision) else "visual"
            color = _find_color(each.material) if isinstance(each, Visual) else None
            pose = scope.pose_in_link(each.pose, link.name)
            yield SceneShape(role, each.name or "", pose, shape, color, each.location)


def _find_color(material: Material | None) -> Color | None:
    """Return the color from 0 to 1, as written or from a Gazebo Classic script; None if there is none."""
    if material is None:
        return None
    of_script = classic_materials().get(material.script.name or "") if material.script else None
    return material.color or material.diffuse or (of_script.diffuse if of_script else None) or material.ambient


def forward_kinematics(
    document: Document, positions: Mapping[str, float | Sequence[float]] | None = None
) -> dict[str, Transform]:
    """Return the pose of each link in the world, by its name in SDF (`model::link` in a world).

    `positions` are in rad or m, by the names of joints; a joint with several degrees of freedom takes a sequence.
    Joints without a position are at zero, and joints that mimic another one follow it. Limits are ignored.

    Raises:
        KeyError: there is no such joint.
        ValueError: a joint has fewer degrees of freedom.
    """
    kinematics = build_scene(document).kinematics()
    values = dict[tuple[str, int], float]()
    for name, position in (positions or {}).items():
        joint = look_up(kinematics.joints, name, "joint")
        given = position if isinstance(position, Sequence) else (position,)
        if len(given) > len(joint.degrees):
            message = f"{joint.type} joint {name!r} takes at most {len(joint.degrees)} positions, not {len(given)}"
            raise ValueError(message)
        values |= {(name, degree): value for degree, value in enumerate(given)}
    return kinematics.poses(values)
