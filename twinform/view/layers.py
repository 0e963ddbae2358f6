"""The layers of a robot: shapes, frames, names, and marks such as axes and limits, masses and what sensors see."""

import importlib
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import pairwise
from typing import Any, NamedTuple

from twinform.compiler.graph.graph import shortened
from twinform.compiler.kinematics import Degree
from twinform.compiler.scene import Frustum, SceneJoint
from twinform.ir import Mesh, Vector3
from twinform.ir.motion import plane_across, slide, turn
from twinform.ir.solids import Solid, principal_axes
from twinform.ir.transform import Transform, cross
from twinform.view.figure import MARK, Figure, Handle, Rgb, placed, rgb

np: Any = importlib.import_module("numpy")

_AXIS: Rgb = (200, 0, 120)
_LIMIT: Rgb = (240, 150, 200)
_BONE: Rgb = (90, 90, 100)
_STEPS = 24
_JOINT_SHARE = 0.08
"""The length of arrows and the radius of arcs, as a share of the whole robot."""


def joint_axes(figure: Figure) -> Iterator[Handle]:
    """Draw an arrow for each axis, in the frame of the link that the joint moves."""
    length = figure.size * _JOINT_SHARE
    for number, joint in enumerate(figure.scene.joints):
        into = figure.from_world(joint.child)
        start = into.apply(joint.frame.translation)
        arrows = [(start, _move_along(start, into.rotate(degree.axis), length)) for degree in joint.degrees]
        if arrows:
            drawn = figure.api.add_arrows(
                f"{figure.node_name(joint.child)}/axes/{number}",
                np.asarray(arrows, dtype=np.float32),
                _AXIS,
                shaft_radius=length * 0.04,
                head_radius=length * 0.1,
                head_length=length * 0.25,
            )
            yield figure.called(drawn, *about(joint))


def about(joint: SceneJoint) -> Iterator[str]:
    """Yield the lines that describe a joint."""
    yield f"joint {shortened(joint.name)}"
    yield f"{joint.type}, from {shortened(joint.parent)} to {shortened(joint.child)}"
    for degree in joint.degrees:
        unit = "m" if degree.slides else "rad"
        if math.isfinite(degree.lower) or math.isfinite(degree.upper):
            yield f"from {degree.lower:.4g} to {degree.upper:.4g} {unit}"
        if degree.leader:
            yield f"follows {shortened(degree.leader.joint)}"


def joint_limits(figure: Figure) -> Iterator[Handle]:
    """Draw arcs and lines from the lower to the upper limits, in the frame of the parent link."""
    length = figure.size * _JOINT_SHARE
    for number, joint in enumerate(figure.scene.joints):
        into = figure.from_world(joint.parent)
        segments = [piece for degree in joint.degrees for piece in _limit_lines(joint, degree, length)]
        if segments:
            points = np.asarray([[into.apply(a), into.apply(b)] for a, b in segments], dtype=np.float32)
            name = f"{figure.node_name(joint.parent)}/limits/{number}"
            drawn = figure.api.add_line_segments(name, points, _LIMIT, thickness=length * 0.05)
            yield figure.called(drawn, *about(joint))


def _limit_lines(joint: SceneJoint, degree: Degree, length: float) -> Iterator[tuple[Vector3, Vector3]]:
    if not (math.isfinite(degree.lower) and math.isfinite(degree.upper)) or degree.lower >= degree.upper:
        return
    center = joint.frame.translation
    if degree.slides:
        yield slide(degree.axis, degree.lower).apply(center), slide(degree.axis, degree.upper).apply(center)
        return
    start = _move_along(center, plane_across(degree.axis)[0], length)
    span = min(degree.upper - degree.lower, 2 * math.pi)
    angles = [degree.lower + span * step / _STEPS for step in range(_STEPS + 1)]
    arc = [turn(degree.axis, angle, center).apply(start) for angle in angles]
    yield center, arc[0]
    yield from pairwise(arc)
    yield arc[-1], center


def skeleton(figure: Figure) -> Iterator[Handle]:
    """Draw lines from the frame of each link to its joints, and on to the links that these move."""
    thick = figure.size * 0.008
    for number, joint in enumerate(figure.scene.joints):
        into = figure.from_world(joint.parent)
        start = figure.kinematics.at_zero.get(joint.parent)
        points = [start.translation if start else joint.frame.translation, joint.frame.translation]
        if joint.child in figure.kinematics.at_zero and not joint.degrees:
            points.append(figure.kinematics.at_zero[joint.child].translation)
        lines = np.asarray([[into.apply(a), into.apply(b)] for a, b in pairwise(points)])
        name = f"{figure.node_name(joint.parent)}/bones/{number}"
        bone = figure.api.add_line_segments(name, lines.astype(np.float32), _BONE, thickness=thick)
        yield figure.called(bone, shortened(joint.parent))
        ball = f"{figure.node_name(joint.child)}/knuckles/{number}"
        at = figure.from_world(joint.child).apply(joint.frame.translation)
        knuckle = figure.api.add_icosphere(ball, thick * 1.6, color=_AXIS if joint.degrees else _BONE, position=at)
        yield figure.called(knuckle, *about(joint))


def _move_along(start: Vector3, direction: Vector3, length: float) -> Vector3:
    return tuple(a + b * length for a, b in zip(start, direction, strict=True))  # type: ignore[return-value]


_INERTIA_COLOR: Rgb = (60, 140, 230)
_TOO_LARGE: Rgb = (220, 40, 40)
_CENTER_COLOR: Rgb = (20, 60, 160)
_MASS_SHARE = 0.03
"""The radius of the ball of the heaviest link, as a share of the whole robot."""


def inertias(figure: Figure) -> Iterator[Handle]:
    """Draw boxes of even density that have the mass and the inertia of the links.

    One that is larger than the whole robot, as of an inertia in a wrong unit, would hide it: it is cut, in red wire.
    """
    for link in figure.scene.links:
        found = inertia_box(link.mass) if link.mass else None
        if found is not None:
            lengths, pose = found
            largest = max(lengths)
            shown = min(1.0, figure.size / largest) if largest else 1.0
            sides = " x ".join(f"{each:.3g}" for each in lengths)
            cut = "" if shown == 1.0 else "larger than the whole robot: drawn smaller"
            box = figure.api.add_box(
                f"{figure.node_name(link.name)}/inertia",
                _INERTIA_COLOR if shown == 1.0 else _TOO_LARGE,
                tuple(each * shown for each in lengths),
                opacity=0.35,
                wireframe=shown < 1.0,
                **placed(pose),
            )
            yield figure.called(box, f"inertia of {shortened(link.name)}", f"a box of {sides} m", cut)


def inertia_box(solid: Solid) -> tuple[Vector3, Transform] | None:
    """Return the sides in meters and the pose of the box of even density that has this mass and inertia.

    The moments of a box of sides a, b, c are m (b^2 + c^2) / 12 and so on, so a^2 = 6 (Iyy + Izz - Ixx) / m; a side
    whose square would be negative, as of no real body, is zero. None where it is not finite.
    """
    if not all(map(math.isfinite, (*solid.inertia, *solid.center))):
        return None
    moments, axes = principal_axes(solid.inertia)
    total = sum(moments)
    a, b, c = (math.sqrt(max(0.0, 6 * (total - 2 * each) / solid.mass)) for each in moments)
    (x1, x2, x3), (y1, y2, y3), (z1, z2, z3) = axes[0], axes[1], cross(axes[0], axes[1])
    pose = Transform(solid.center, (x1, y1, z1, x2, y2, z2, x3, y3, z3))
    return ((a, b, c), pose) if all(map(math.isfinite, (a, b, c))) else None


def centers(figure: Figure) -> Iterator[Handle]:
    """Draw a ball at each center of mass, whose volume grows with the mass."""
    weights = [link.mass.mass for link in figure.scene.links if link.mass]
    for link in figure.scene.links:
        if link.mass and all(map(math.isfinite, link.mass.center)):
            radius = figure.size * _MASS_SHARE * max(0.15, (link.mass.mass / max(weights)) ** (1 / 3))
            name = f"{figure.node_name(link.name)}/center"
            ball = figure.api.add_icosphere(name, radius, color=_CENTER_COLOR, position=link.mass.center)
            yield figure.called(ball, f"center of mass of {shortened(link.name)}", f"{link.mass.mass:g} kg")


_SENSOR: Rgb = (0, 150, 90)
_FAR = 0.6
"""Where frusta and rays are cut, as a share of the whole robot."""


def sensors(figure: Figure) -> Iterator[Handle]:
    """Draw frusta of cameras, rays of lidars, and axes of other sensors; nothing reaches far beyond the robot."""
    far = figure.size * _FAR
    for number, sensor in enumerate(figure.scene.sensors):
        name = f"{figure.node_name(sensor.link)}/sensors/{number}"
        words = f"sensor {shortened(sensor.name)}", f"{sensor.type} on {shortened(sensor.link)}"
        lines = [piece for frustum in sensor.frustums for piece in _frustum_edges(frustum, far)]
        lines += [(ray.start, _shorten(ray.start, ray.end, far)) for ray in sensor.rays]
        if not lines:
            yield figure.axes(name, sensor.pose, *words)
            continue
        points = np.asarray(lines, dtype=np.float32)
        thick = figure.size * 0.003
        drawn = figure.api.add_line_segments(name, points, _SENSOR, thickness=thick, **placed(sensor.pose))
        yield figure.called(drawn, *words)


def _frustum_edges(frustum: Frustum, far: float) -> Iterator[tuple[Vector3, Vector3]]:
    """Yield the edges of a frustum along x."""
    depth = min(frustum.far, far)
    near, corners = min(frustum.near, depth), [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    y, z = math.tan(frustum.horizontal / 2), math.tan(frustum.vertical / 2)
    front = [frustum.pose.apply((near, near * y * i, near * z * j)) for i, j in corners]
    back = [frustum.pose.apply((depth, depth * y * i, depth * z * j)) for i, j in corners]
    for ring in (front, back):
        yield from zip(ring, [*ring[1:], ring[0]], strict=True)
    yield from zip(front, back, strict=True)


def _shorten(start: Vector3, end: Vector3, far: float) -> Vector3:
    length = math.dist(start, end)
    share = min(1.0, far / length) if length else 0.0
    x, y, z = (a + (b - a) * share for a, b in zip(start, end, strict=True))
    return x, y, z


SKELETON = "Skeleton"
_COLLISION: Rgb = (230, 90, 60)
_SEE_THROUGH = 0.35


def _draw_visuals(figure: Figure) -> Iterator[Handle]:
    for link, name, shape in figure.shapes("visual"):
        color = figure.look.color or rgb(shape.color)
        opacity = figure.look.opacity or next(iter((shape.color or ())[3:]), None)  # SDF may leave alpha out
        yield _listen(figure, link, figure.draw(shape, name, color, opacity))


def _draw_collisions(figure: Figure) -> Iterator[Handle]:
    for link, name, shape in figure.shapes("collision"):
        yield _listen(figure, link, figure.draw(shape, name, figure.look.color or _COLLISION, _SEE_THROUGH))


def _listen(figure: Figure, link: str, handle: Handle) -> Handle:
    if figure.listen is not None:
        figure.listen(figure, handle, link)
    return handle


def _draw_link_frames(figure: Figure) -> Iterator[Handle]:
    for link in figure.scene.links:
        yield figure.axes(f"{figure.node_name(link.name)}/frame", Transform(), f"frame of {shortened(link.name)}")


def _draw_named_frames(figure: Figure) -> Iterator[Handle]:
    for number, frame in enumerate(figure.scene.frames):
        lines = f"frame {shortened(frame.name)}", f"on {shortened(frame.link)}"
        yield figure.axes(f"{figure.node_name(frame.link)}/frames/{number}", frame.pose, *lines)


def _draw_mesh_origins(figure: Figure) -> Iterator[Handle]:
    for role in ("visual", "collision"):
        for link, name, shape in figure.shapes(role):
            if isinstance(shape.shape, Mesh):
                lines = f"origin of {shortened(shape.shape.uri or 'a mesh')}", f"{role} of {shortened(link)}"
                yield figure.axes(f"{name}-origin", shape.pose, *lines)


def _write_link_names(figure: Figure) -> Iterator[Handle]:
    for link in figure.scene.links:
        yield figure.api.add_label(f"{figure.node_name(link.name)}/name", shortened(link.name))


def _write_joint_names(figure: Figure) -> Iterator[Handle]:
    for number, joint in enumerate(figure.scene.joints):
        at = figure.from_world(joint.child).apply(joint.frame.translation)
        name = f"{figure.node_name(joint.child)}/joints/{number}"
        yield figure.api.add_label(name, shortened(joint.name), position=at)


class Layer(NamedTuple):
    """A layer: its label, whether it is shown at first, and the function that draws it."""

    label: str
    shown: bool
    draw: Callable[[Figure], Iterable[Handle]]


def _draw_world_axes(figure: Figure) -> Iterator[Handle]:
    yield figure.axes(f"{figure.root}/origin", Transform(), "origin: x forward, y to the left, z up")


LAYERS: tuple[Layer, ...] = (
    Layer("Visuals", shown=True, draw=_draw_visuals),
    Layer("Collisions", shown=False, draw=_draw_collisions),
    Layer(SKELETON, shown=False, draw=skeleton),
    Layer("Link frames", shown=False, draw=_draw_link_frames),
    Layer("Named frames", shown=False, draw=_draw_named_frames),
    Layer("Joint axes", shown=False, draw=joint_axes),
    Layer("Joint limits", shown=False, draw=joint_limits),
    Layer("Inertias", shown=False, draw=inertias),
    Layer("Centers of mass", shown=False, draw=centers),
    Layer("Sensors", shown=False, draw=sensors),
    Layer("Origin", shown=False, draw=_draw_world_axes),
    Layer("Mesh origins", shown=False, draw=_draw_mesh_origins),
    Layer("Link names", shown=False, draw=_write_link_names),
    Layer("Joint names", shown=False, draw=_write_joint_names),
)
COLORS: Mapping[str, Rgb] = {
    "x": (204, 0, 0),
    "y": (0, 204, 0),
    "z": (0, 0, 204),
    "joint axes": _AXIS,
    "joint limits": _LIMIT,
    "collisions": _COLLISION,
    "inertias": _INERTIA_COLOR,
    "inertias larger than the robot": _TOO_LARGE,
    "centers of mass": _CENTER_COLOR,
    "what sensors see": _SENSOR,
    "selected, or not drawn": MARK,
}
"""What the colors of layers mean."""
