"""Shapes that stand for one that the target lacks: primitives for a capsule, a mesh beside the file for others.

Annotations say which they are, so that the reverse conversion folds them back:

    <tf:capsule/>                      a cylinder that is the middle of a capsule, or the sphere that is all of one
    <tf:capsule-end>NAME</tf:...>      a sphere at the end of the cylinder before it, and its name when it was made
    <tf:shape instead_of="M.obj">      the geometry that the mesh of this file stands for
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from typing import NamedTuple, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import Fate, SideFile, rules
from twinform.ir import Collision, Element, GazeboExtension, Link, Node, Pose, Visual, count_parts, replace_fields
from twinform.ir.defaults import sizes
from twinform.ir.geometry import Capsule, Cylinder, Geometry, Mesh, Sphere
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.passes.carriers.carriers import Keeper, bits_of_ours, carry, is_ours
from twinform.passes.mesh_jobs.mesh_files import MARK, NoMeshError
from twinform.passes.shared.nodes import map_elements, piece, reserve_name

AnyPart = TypeVar("AnyPart", Visual, Collision)
CAPSULE = "capsule"
CAPSULE_END = "capsule-end"
SHAPE = "shape"
REPLACED = bits_of_ours(CAPSULE, CAPSULE_END, SHAPE)
"""The bits of the census for these annotations."""
FOLDER = "meshes"
"""Where meshes are written, below the folder of the result."""
_DIGITS = 12
# A file of a stranger could ask for any number of meshes, each with a quarter of a million triangles.
_MOST, _MOST_BYTES = 200, 2**26
"""What the meshes of one result may be: shapes that differ, and bytes."""
_HINTS = {
    "plane": "put the ground into the world, or write a box that is large enough",
    "heightmap": "name a mesh of the terrain",
    "image": "name a mesh of it",
}


class _WrittenMesh(NamedTuple):
    """The file name of a mesh, its size in bytes, and what there is to say of it."""

    name: str
    size: int
    description: str


@dataclass(frozen=True, slots=True)
class ShapeReplacer:
    """Replaces shapes of the kinds that a target `lacks`.

    A mesh is at most `error` off, in m, or 1 % of the largest radius where it is None; none is written without
    `side_files`, which go into `folder`. The URIs of meshes begin with `prefix`, or are relative paths.
    """

    keeper: Keeper
    target: str
    lacks: Callable[[str], bool]
    error: float | None
    prefix: str | None
    side_files: bool
    folder: str = FOLDER
    _known: dict[Geometry, "_WrittenMesh | NoMeshError"] = field(
        default_factory=dict[Geometry, "_WrittenMesh | NoMeshError"]
    )

    def replace(self, part: AnyPart, link: str) -> AnyPart:
        """The part with a shape that the target has; of a capsule the middle, see `with_ends`.

        Raises:
            NoMeshError: no shape can stand for it.
        """
        geometry = part.geometry
        shape = geometry.shape if geometry else None
        if geometry is None or shape is None or not self.lacks(shape.kind):
            return part
        what = f"{type(part).__name__.lower()} {part.name!r} of link {link!r}"
        if isinstance(shape, Capsule):
            parts = "a cylinder and two spheres" if sizes(shape)[1] else "a sphere"
            self._account(shape, f"{what} becomes {parts}: {self.target} has no capsule")
            return middle_of_capsule(part, shape)
        if shape.kind in _HINTS:
            raise NoMeshError(_HINTS[shape.kind])
        made_of = self._mesh(geometry, shape.kind)
        message = f"{what} becomes a mesh of {made_of.description}: {self.target} has no {shape.kind}"
        self.keeper.sink.report(rules.REPLACED_SHAPE, message, shape.location, found=shape.kind)
        self._account(shape, message)
        for other in geometry.opaque:  # a polyline may be one of several
            sink = self.keeper.sink
            sink.account(Fate.APPROXIMATED, rules.REPLACED_SHAPE, message, other.location, other.weight)
        path = f"{self.folder}/{made_of.name}"
        uri = f"{self.prefix.rstrip('/')}/{path}" if self.prefix else path
        made = replace_fields(part, geometry=Geometry(shape=Mesh(uri=uri)))
        if not self.keeper.carriers:
            return made
        return carry(made, [piece(geometry, "geometry")], SHAPE, (("instead_of", made_of.name),))

    def _account(self, shape: Node, message: str) -> None:
        self.keeper.sink.account(Fate.APPROXIMATED, rules.REPLACED_SHAPE, message, shape.location, count_parts(shape))

    def _mesh(self, geometry: Geometry, kind: str) -> "_WrittenMesh":
        """The mesh that stands for a geometry, written beside the result.

        Raises:
            NoMeshError: there is none, or there are too many.
        """
        if geometry not in self._known:
            size = sum(each.size for each in self._known.values() if isinstance(each, _WrittenMesh))
            if len(self._known) >= _MOST or size > _MOST_BYTES:
                raise NoMeshError(
                    f"a result has meshes for no more than {_MOST} shapes, and of {_MOST_BYTES >> 20} MiB"
                )
            try:
                self._known[geometry] = self._write(geometry, kind)
            except NoMeshError as error:
                self._known[geometry] = error
        found = self._known[geometry]
        if isinstance(found, NoMeshError):
            raise found
        return found

    def _write(self, geometry: Geometry, kind: str) -> "_WrittenMesh":
        """Put the mesh of a geometry beside the result.

        Raises:
            NoMeshError: there is none.
        """
        from twinform.passes.shared.shape_meshes import format_length, mesh_of  # noqa: PLC0415 - few shapes need a mesh

        mesh = mesh_of(geometry, self.error)
        if not self.side_files:
            raise NoMeshError("name a file for the result with -o, and a mesh is written beside it")
        # Named by their content, equal shapes share a mesh, no robot writes over that of another,
        # and a mesh that somebody edited is no longer what its name says.
        data = mesh.obj()
        name = f"{kind}_{digest_of(data)}.obj"
        self.keeper.sink.side_files.append(SideFile(f"{self.folder}/{name}", data, MARK.encode()))
        off = f"at most {format_length(mesh.error)} off and inside of it" if mesh.error else "with the same surface"
        return _WrittenMesh(name, len(data), f"{len(mesh.faces)} triangles, {off}")


def digest_of(data: bytes) -> str:
    """What stands in the name of a mesh for its content."""
    import hashlib  # noqa: PLC0415 - few shapes need a mesh

    return hashlib.sha256(data).hexdigest()[:_DIGITS]


def with_ends(parts: Sequence[AnyPart], *, annotated: bool) -> tuple[tuple[AnyPart, ...], dict[str, tuple[str, ...]]]:
    """The parts with spheres behind the middle of each capsule, and the names of the parts of each capsule by its name.

    Not `annotated`, none says any more what it is of.
    """
    taken = {part.name for part in parts if part.name}
    made: list[AnyPart] = []
    names: dict[str, tuple[str, ...]] = {}
    for part in parts:
        is_middle = find_annotation(part, CAPSULE) is not None
        made.append(part if annotated else without_annotation(part, CAPSULE))
        ends = [*ends_of_capsule(part, taken)] if is_middle else []
        made += [with_annotation(end, CAPSULE_END, end.name) if annotated else end for end in ends]
        if ends and part.name:
            names[part.name] = (part.name, *(end.name or "" for end in ends))
    return tuple(made), names


def middle_of_capsule(part: AnyPart, shape: Capsule) -> AnyPart:
    """The cylinder of a capsule, or the sphere that one without a length is, annotated as that."""
    radius, length = sizes(shape)
    made = Cylinder(radius=radius, length=length) if length else Sphere(radius=radius)
    geometry = (part.geometry or Geometry()).copy(shape=made.copy(source=shape.source, opaque=shape.opaque))
    return with_annotation(part.copy(geometry=geometry), CAPSULE)


def ends_of_capsule(part: AnyPart, taken: set[str]) -> Iterator[AnyPart]:
    """Yield the spheres at the ends of the cylinder of a capsule; `taken` are names, and get theirs."""
    shape = part.geometry.shape if part.geometry else None
    if not isinstance(shape, Cylinder):
        return
    foreign = tuple(each for each in part.opaque if not is_ours(each))
    for pose in end_poses(part.pose, sizes(shape)[1]):
        name = reserve_name(f"{part.name}_end", taken) if part.name else part.name
        yield part.copy(name=name, pose=pose, geometry=Geometry(shape=Sphere(radius=shape.radius)), opaque=foreign)


def end_poses(pose: Pose | None, length: float) -> Iterator[Pose]:
    """Yield where the ends of a cylinder are: half its length along z from its middle, both ways."""
    frame = pose.relative_to if pose else None
    for height in (length / 2, -length / 2):
        yield Transform.from_pose(pose).compose(Transform((0.0, 0.0, height))).to_pose(frame)


def map_touched(extension: GazeboExtension, names: Mapping[str, Sequence[str]]) -> GazeboExtension:
    """The extension with the names of collisions in its contact sensors replaced, each by any number of others."""
    if not names:
        return extension
    return replace_fields(extension, content=tuple(_map_touched(each, names, "") for each in extension.content))


def map_sensors(link: Link, names: Mapping[str, Sequence[str]]) -> Link:
    """The link with the names of its collisions in its contact sensors replaced, each by any number of others."""
    if not names:
        return link
    sensors = (
        replace_fields(each, opaque=map_elements(each.opaque, lambda one: _map_touched(one, names, "/sensor")))
        for each in link.sensors
    )
    return replace_fields(link, sensors=tuple(sensors))


def _map_touched(element: Element, names: Mapping[str, Sequence[str]], inside: str) -> Element:
    path = f"{inside}/{element.name}"
    if not "/sensor/contact".startswith(path):
        return element
    children: list[Element] = []
    for child in element.children:
        named = names.get((child.text or "").strip()) if child.name == "collision" and inside else None
        children += [_map_touched(child, names, path)] if named is None else [child.copy(text=each) for each in named]
    return replace_fields(element, children=tuple(children))
