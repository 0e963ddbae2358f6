"""One robot or world in the 3D view: a node for each link, and layers of what there is on it."""

import importlib
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field
from typing import Any

from twinform.compiler.graph.graph import shortened
from twinform.compiler.kinematics import Kinematics, Positions
from twinform.compiler.scene import Scene, SceneJoint, SceneShape
from twinform.dataclass import dataclass
from twinform.ir import Plane, Vector3
from twinform.ir.transform import Transform
from twinform.view.triangles import MeshDrawings, Triangles, triangles_of

np: Any = importlib.import_module("numpy")
Rgb = tuple[int, int, int]
Array = Any
Handle = Any
"""Of something in the scene of viser."""

UNPAINTED: Rgb = (200, 200, 205)
MARK: Rgb = (255, 170, 0)
# Meters from the origin beyond which a shape does not count for the camera: the ground of a world.
_FAR = 1e4
# A shape with a side of at least this many meters is the ground that a robot stands on.
_GROUND = 50.0
_LEAST = 1e-3
_SHARE = 0.06
"""The length of the axes of a frame, as a share of the whole robot."""
_OPAQUE = 0.999
_SWELL = 1.02
"""How much larger a mark is than what it marks."""


@dataclass(frozen=True, slots=True)
class Look:
    """How a robot is drawn: in one color instead of its own, and how opaque."""

    color: Rgb | None = None
    opacity: float | None = None


@dataclass(slots=True)
class Figure:
    """A scene, drawn below the node `root` of a viser scene.

    `listen` is called with each part that is drawn and its link; `title` says which of two robots this is. `labels` has
    the texts that explain nodes, by their names. The `watchers` are called when joints have moved.
    """

    api: Any
    root: str
    scene: Scene
    meshes: MeshDrawings
    look: Look = field(default_factory=Look)
    listen: Callable[["Figure", Handle, str], None] | None = None
    title: str = ""
    nodes: dict[str, Handle] = field(default_factory=dict[str, Handle], init=False)
    poses: dict[str, Transform] = field(default_factory=dict[str, Transform], init=False)
    labels: dict[str, str] = field(default_factory=dict[str, str], init=False)
    watchers: list[Callable[[], None]] = field(default_factory=list[Callable[[], None]], init=False)
    base: Handle = field(init=False)
    kinematics: Kinematics[SceneJoint] = field(init=False)
    _layers: dict[str, list[Handle]] = field(default_factory=dict[str, "list[Handle]"], init=False)
    _with_visuals: frozenset[str] = field(default=frozenset(), init=False)
    _marks: list[Handle] = field(default_factory=list[Handle], init=False)
    _size: float | None = field(default=None, init=False)
    _triangles: dict[SceneShape, Triangles] = field(default_factory=dict[SceneShape, Triangles], init=False)

    def __post_init__(self) -> None:
        self.kinematics = self.scene.kinematics()
        self.poses = self.kinematics.poses({})
        self.base = self.api.add_frame(self.root, show_axes=False)
        for number, link in enumerate(self.scene.links):
            self.nodes[link.name] = self.api.add_frame(
                f"{self.root}/links/{number}", show_axes=False, **placed(self.poses[link.name])
            )
            self.called(self.nodes[link.name], self._describe_link(link.name))
        self._with_visuals = frozenset(link for link, _, _ in self.shapes("visual"))

    def called(self, handle: Handle, *lines: str) -> Handle:
        """Label a node with lines that the page shows where the mouse is over it, and return the node."""
        self.labels[handle.name] = "\n".join(filter(None, (*lines, self.title)))
        return handle

    def _describe_link(self, link: str) -> str:
        joint = self.kinematics.hung.get(link)
        by = f"\n{joint.type} joint {shortened(joint.name)}" if joint else ""
        return f"{shortened(link)}{by}"

    def node_name(self, link: str) -> str:
        """Return the name of the node of a link; that of the root for a name that is no link."""
        node = self.nodes.get(link)
        return node.name if node is not None else self.root

    def move(self, positions: Positions) -> None:
        """Move every joint to its position, or to zero without one."""
        poses = self.kinematics.poses(positions)
        for name, pose in poses.items():
            if pose != self.poses[name]:
                at = placed(pose)
                self.nodes[name].position, self.nodes[name].wxyz = at["position"], at["wxyz"]
        self.poses = poses
        for watcher in self.watchers:
            watcher()

    def place(self, offset: Vector3, *, visible: bool) -> None:
        """Move the whole robot, for example beside another one, and show or hide it."""
        self.base.position, self.base.visible = offset, visible

    @property
    def size(self) -> float:
        """The length of the diagonal of the box around the robot, in meters."""
        if self._size is None:
            least, greatest = self.bounds()
            self._size = max(float(np.linalg.norm(greatest - least)), _LEAST)
        return self._size

    def from_world(self, link: str) -> Transform:
        """Return the transform from the world to the frame of a link, with all joints at zero."""
        pose = self.kinematics.at_zero.get(link)
        return pose.inverse() if pose else Transform()

    def axes(self, name: str, pose: Transform, *lines: str) -> Handle:
        """Draw the axes of a frame, labeled with lines."""
        length = self.size * _SHARE
        drawn = self.api.add_frame(name, axes_length=length, axes_radius=length * 0.04, **placed(pose))
        return self.called(drawn, *lines) if lines else drawn

    def show(self, layer: str, draw: Callable[["Figure"], Iterable[Handle]], *, visible: bool) -> None:
        """Show or hide a layer, which is drawn when it is first shown."""
        if layer not in self._layers:
            if not visible:
                return
            self._layers[layer] = list(draw(self))
        for handle in self._layers[layer]:
            handle.visible = visible

    def shapes(self, role: str) -> Iterator[tuple[str, str, SceneShape]]:
        """Yield the visuals or collisions, each with its link and a name for its node."""
        for link in self.scene.links:
            for number, shape in enumerate(link.shapes):
                if shape.role == role:
                    yield link.name, f"{self.node_name(link.name)}/{role}/{number}", shape

    def triangles(self, shape: SceneShape) -> Triangles:
        """Return the triangles of a shape, in its frame."""
        found = self._triangles.get(shape)
        if found is None:
            found = self._triangles[shape] = triangles_of(shape.shape, self.meshes)
        return found

    def problems(self) -> Iterator[tuple[str, SceneShape, str]]:
        """Yield the shapes that are drawn as a box instead, each with its link and the reason."""
        for role in ("visual", "collision"):
            for link, _, shape in self.shapes(role):
                if problem := self.triangles(shape).problem:
                    yield link, shape, problem

    def draw(self, shape: SceneShape, name: str, color: Rgb, opacity: float | None) -> Handle:
        """Draw a shape at its place, in `color` unless it has colors of its own."""
        found, at = self.triangles(shape), placed(shape.pose)
        if found.problem:
            return self.api.add_mesh_simple(name, found.points, found.faces, color=color, wireframe=True, **at)
        if found.colors is not None and self.look.color is None and shape.role == "visual":
            return self.api.add_mesh_trimesh(name, _paint(found), **at)
        clear = opacity if opacity is not None and opacity < _OPAQUE else None
        return self.api.add_mesh_simple(
            name, found.points, found.faces, color=color, opacity=clear, side="double", **at
        )

    def mark(self, links: Mapping[str, Rgb]) -> None:
        """Mark some links with colors, and no others; a link without shapes gets a ball at its frame."""
        for handle in self._marks:
            handle.remove()
        self._marks = []
        bare = {link for link in links if link in self.nodes}
        for role in ("visual", "collision"):
            for link, name, shape in self.shapes(role):
                if link in links and (role == "visual" or link not in self._with_visuals):
                    bare.discard(link)
                    self._marks.append(self._mark(shape, f"{name}-mark", links[link]))
        for link in sorted(bare):
            self._marks.append(
                self.api.add_icosphere(
                    f"{self.node_name(link)}/mark", self.size * _SHARE / 2, color=links[link], opacity=0.8
                )
            )

    def _mark(self, shape: SceneShape, name: str, color: Rgb) -> Handle:
        found = self.triangles(shape)
        middle = (found.points.max(axis=0) + found.points.min(axis=0)) / 2
        points = (found.points - middle) * _SWELL + middle
        return self.api.add_mesh_simple(
            name, points, found.faces, color=color, opacity=0.6, side="double",
            **placed(shape.pose),
        )  # fmt: skip

    @property
    def has_ground(self) -> bool:
        """Whether a shape is as wide as the ground of a world, or a plane is wider than everything else."""
        return any(
            (width := _width(self.triangles(shape).points)) >= _GROUND or (_is_plane(shape) and width > self.size)
            for _, _, shape in self.shapes("visual")
        )

    def bounds(self) -> tuple[Array, Array]:
        """Return the least and greatest coordinates of shapes and frames, with all joints at zero.

        Planes count only if there is nothing else: they are the ground.
        """
        corners = self._find_boxes("visual") or self._find_boxes("collision")
        corners += [np.asarray([pose.translation]) for pose in self.kinematics.at_zero.values() if _is_near(pose)]
        every = np.concatenate(corners) if corners else np.zeros((1, 3))
        return every.min(axis=0), every.max(axis=0)

    def _find_boxes(self, role: str) -> list[Array]:
        """Return the corners of boxes around the shapes that the camera should show."""
        solid: list[Array] = []
        flat: list[Array] = []
        for link, _, shape in self.shapes(role):
            box = _box_around(self.triangles(shape).points, self.kinematics.at_zero[link].compose(shape.pose))
            if np.abs(box).max() < _FAR and _width(box) < _GROUND:
                (flat if _is_plane(shape) else solid).append(box)
        return solid or flat


FOV = math.radians(45)
"""The vertical angle of view of cameras."""
VIEWS: Mapping[str, Vector3] = {
    "Corner": (0.85, -1.15, 0.65),
    "Front": (1.6, 0.0, 0.0),
    "Side": (0.0, -1.6, 0.0),
    "Top": (-0.001, 0.0, 1.6),
}
"""Where cameras are from the middle of what is shown, in units of its size; robots face x, and z is up."""


def viewpoint(figures: Iterable[Figure], view: str = "Corner") -> tuple[Vector3, Vector3]:
    """Return where a camera sees all of some figures, and the point that it looks at."""
    every = list(figures)
    bounds = [figure.bounds() for figure in every]
    least, greatest = np.min([each for each, _ in bounds], axis=0), np.max([each for _, each in bounds], axis=0)
    x, y, z = (float(each) for each in (least + greatest) / 2)
    away = max(figure.size for figure in every)
    a, b, c = VIEWS[view]
    return (x + away * a, y + away * b, z + away * c), (x, y, z)


def aim(camera: Any, figures: Iterable[Figure], view: str = "Corner") -> None:
    """Move a camera of viser to where everything is seen."""
    position, target = viewpoint(figures, view)
    away = math.dist(position, target)
    camera.position, camera.look_at, camera.fov = position, target, FOV
    camera.near, camera.far = away / 100, away * 100


def placed(pose: Transform) -> dict[str, Any]:
    """Return a pose as keywords of viser."""
    x, y, z, w = pose.quaternion()
    return {"position": pose.translation, "wxyz": (w, x, y, z)}


def rgb(color: Iterable[float] | None, usual: Rgb = UNPAINTED) -> Rgb:
    """Return red, green and blue from 0 to 255."""
    if color is None:
        return usual
    red, green, blue, *_ = (round(255 * min(1.0, max(0.0, part))) if math.isfinite(part) else 0 for part in color)
    return red, green, blue


def _is_plane(shape: SceneShape) -> bool:
    return isinstance(shape.shape, Plane)


def _width(points: Array) -> float:
    """Return the longest edge of the box around points."""
    return float(np.ptp(points, axis=0).max())


def _is_near(pose: Transform) -> bool:
    return all(math.isfinite(each) and abs(each) < _FAR for each in pose.translation)


def _paint(found: Triangles) -> Any:
    trimesh = importlib.import_module("trimesh")
    return trimesh.Trimesh(found.points, found.faces, vertex_colors=found.colors, process=False)


def _box_around(points: Array, pose: Transform) -> Array:
    rotation = np.asarray(pose.rotation).reshape(3, 3)
    moved = points @ rotation.T + np.asarray(pose.translation)
    return np.stack([moved.min(axis=0), moved.max(axis=0)])
