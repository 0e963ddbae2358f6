"""Builds the scene of a document: links, joints, frames and sensors where the frame graph says that they are."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from twinform.compiler.kinematics import degrees_of
from twinform.compiler.scene.scene import Role, Scene, SceneFrame, SceneJoint, SceneLink, SceneSensor, SceneShape
from twinform.compiler.scene.sensor_views import frustums_of, rays_of
from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Collision,
    Color,
    Document,
    Empty,
    Format,
    Frame,
    Joint,
    Link,
    Material,
    Model,
    Pose,
    Sensor,
    Visual,
)
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph, Kind
from twinform.ir.model import look_up
from twinform.ir.solids import Solid, placed, written_solid
from twinform.ir.transform import Transform
from twinform.passes import Pass, Pipeline
from twinform.passes.appearance.classic_materials import classic_materials
from twinform.passes.shared.flattening import flatten

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
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - see above
    from twinform.passes.legalise.to_sdf.shared_materials import SharedMaterials  # noqa: PLC0415 - see above

    return (SharedMaterials(carriers=False), FoldGazebo(carriers=False))


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
