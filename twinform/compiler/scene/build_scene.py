"""Builds the scene of a document: links, joints, frames and sensors where the frame graph says that they are."""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeVar

from twinform.compiler.kinematics import degrees_of
from twinform.compiler.scene.colors import color_of
from twinform.compiler.scene.scene import Role, Scene, SceneFrame, SceneJoint, SceneLink, SceneSensor, SceneShape
from twinform.compiler.scene.scope import SceneScope
from twinform.compiler.scene.sensor_views import frustums_of, rays_of
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Collision, Document, Empty, Format, Frame, Joint, Link, Model, Sensor, Visual
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.ir.solids import Solid, placed, written_solid
from twinform.ir.transform import Transform
from twinform.passes import Pass, Pipeline
from twinform.passes.transforms.flattening import flatten

Part = TypeVar("Part", Link, Joint, Frame)


def build_scene(document: Document) -> Scene:
    """The scene of a document; what includes name is in it where they were expanded."""
    # The document is shown as it stands: a planar joint is three sliders and no chain of three
    # joints. A second reader in the page, such as urdf-loader, would show what *it* understands, so
    # scenes and conversions share this code.
    document = Pipeline(_passes(document)).run(document, DiagnosticSink())
    work = _SceneBuilder(document.format)
    for world in document.worlds:
        graph = FrameGraph(world)
        for model in world.models:
            work.add_model(model, f"{model.name}::", graph)
        work.add_joints(world.joints, SceneScope(graph))
        work.add_frames(world.frames, SceneScope(graph))
    for model in document.models:
        work.add_model(model, f"{model.name}::" if len(document.models) > 1 else "", None)
    return Scene(tuple(work.links), tuple(work.joints), tuple(work.frames), tuple(work.sensors), tuple(work.left_out))


def _passes(document: Document) -> tuple[Pass, ...]:
    """What makes all of a document's meaning stand in its fields."""
    if document.format is Format.SDF:
        from twinform.passes.sdf_versions import raise_words  # noqa: PLC0415 - the other format does not need it

        return raise_words(document.version)
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - see above
    from twinform.passes.legalise.to_sdf.shared_materials import SharedMaterials  # noqa: PLC0415 - see above

    return (SharedMaterials(carriers=False), FoldGazebo(carriers=False))


@dataclass(slots=True)
class _SceneBuilder:
    """What was found so far."""

    format: Format
    links: list[SceneLink] = field(default_factory=list[SceneLink])
    joints: list[SceneJoint] = field(default_factory=list[SceneJoint])
    frames: list[SceneFrame] = field(default_factory=list[SceneFrame])
    sensors: list[SceneSensor] = field(default_factory=list[SceneSensor])
    left_out: list[str] = field(default_factory=list[str])

    def add_model(self, model: Model, prefix: str, around: FrameGraph | None) -> None:
        """All of a model; `around` is the graph of the world that it is in."""
        try:
            flat = flatten(model, lambda frame, _: frame)
            graph = FrameGraph(flat)
            name, base = (MODEL, graph) if around is None else (model.name, around)
            scope = SceneScope(graph, base.pose(name, WORLD, kind="model", base="world"), prefix)
        except FrameError as error:
            self.left_out.append(error.message)
            return
        for link in flat.links:
            self._try(self._add_link, link, scope)
        self.add_joints(flat.joints, scope)
        self.add_frames(flat.frames, scope)

    def add_joints(self, joints: Iterable[Joint], scope: SceneScope) -> None:
        """Joints, and the sensors in them."""
        for joint in joints:
            self._try(self._add_joint, joint, scope)

    def add_frames(self, frames: Iterable[Frame], scope: SceneScope) -> None:
        """Named frames."""
        for frame in frames:
            self._try(self._add_frame, frame, scope)

    def _try(self, add: Callable[[Part, SceneScope], None], part: Part, scope: SceneScope) -> None:
        try:
            add(part, scope)
        except FrameError as error:
            self.left_out.append(f"{part.name}: {error.message}")

    def _add_link(self, link: Link, scope: SceneScope) -> None:
        name = scope.name(link.name)
        shapes, mass = tuple(_shapes(link, scope)), self._mass(link, scope)
        self.links.append(SceneLink(name, scope.frame(link.name, "link"), shapes, mass, link.location))
        for sensor in link.sensors:
            self._add_sensor(sensor, name, scope.pose_in_link(sensor.pose, link.name))

    def _mass(self, link: Link, scope: SceneScope) -> Solid | None:
        if link.inertial is None and self.format is Format.URDF:
            return None
        solid = written_solid(link.inertial, self.format)
        pose = scope.pose_in_link(link.inertial.pose if link.inertial else None, link.name)
        return placed(solid, pose) if solid.mass > 0 and math.isfinite(solid.mass) else None

    def _add_joint(self, joint: Joint, scope: SceneScope) -> None:
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

    def _add_frame(self, frame: Frame, scope: SceneScope) -> None:
        link = scope.body(frame.name, "frame")
        pose = scope.graph.pose(frame.name, link, kind="frame")
        self.frames.append(SceneFrame(scope.name(frame.name), scope.name(link), pose, frame.location))


def _shapes(link: Link, scope: SceneScope) -> Iterator[SceneShape]:
    for each in (*link.visuals, *link.collisions):
        shape = each.geometry.shape if each.geometry else None
        if shape is not None and not isinstance(shape, Empty):
            role: Role = "collision" if isinstance(each, Collision) else "visual"
            color = color_of(each.material) if isinstance(each, Visual) else None
            pose = scope.pose_in_link(each.pose, link.name)
            yield SceneShape(role, each.name or "", pose, shape, color, each.location)
