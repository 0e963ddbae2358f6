"""Replace the meshes of collisions by primitives, convex hulls or convex parts, within a distance."""

from collections.abc import Sequence
from typing import ClassVar, Literal, cast

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import CHANGED_MESH, KEPT_MESH, NOTHING_MATCHED
from twinform.ir import Collision, Document, Format, Geometry, Link, Mesh, Shape, rewrite
from twinform.ir.geometry import Box, Capsule, Cylinder, Sphere
from twinform.ir.transform import Transform
from twinform.lazy import lazy_pattern
from twinform.passes.framework.pass_base import EVERY, matches, with_such_a_name
from twinform.passes.mesh_jobs.job import Options
from twinform.passes.meshes.mesh_pass import (
    MeshOutcome,
    MeshPass,
    Workbench,
    as_number,
    report_kept_mesh,
)
from twinform.passes.shared.mesh_solids import MeshError
from twinform.passes.shared.shape_meshes import format_length

Way = Literal["primitive", "hull", "parts"]
Kind = Literal["box", "sphere", "cylinder", "capsule"]
_MADE_STEM = lazy_pattern(r"_(hull|part\d+)$")
_CAPSULES: dict[Format, tuple[int, ...]] = {Format.URDF: (1, 1), Format.SDF: (1, 8)}
"""The first version of each format that has capsules."""


class SimplifyCollisions(MeshPass):
    """Replace the meshes of collisions by shapes that are cheap to touch, within a distance that is guaranteed.

    Changes the collisions with a mesh whose name matches `collisions`, on links whose name matches `links`. The ways of
    `how` are tried in their order, and the first one that is within both `max-error` and `max-relative-error` is taken:

    1. `primitive`: the nearest of `shapes`, turned and moved as it has to be; nothing has to be written for it;
    2. `hull`: the convex hull of the mesh, as an OBJ file;
    3. `parts`: convex parts by CoACD, an OBJ file and a collision each, of which the first keeps the name.

    Hulls and parts have as few triangles as the distance needs. They are taken only if these are fewer than the mesh
    has; parts may be more where `how=parts` asks for nothing else.

    The distance is the greatest between the outsides of mesh and shape, both ways; what is inside of the shape, such as
    the motor in a housing, touches nothing and does not count. It is bounded triangle by triangle, not sampled, so that
    no point is farther off than is said. Files are written together with the result, below its folder.
    (`pip install 'twinform[meshes]'`)

    Never touches: masses, inertias, frames and joints. A collision stays where its link has an inertia that is computed
    from collisions (`auto`), where nothing is within the distance, and where its mesh cannot be read.
    Diagnostics: `changed-mesh` for each collision with its triangles and distance, `kept-mesh`, `unreadable-mesh`,
    `mesh-reader-missing`, and `nothing-matched`.
    """

    name = "simplify-collisions"
    example: ClassVar[str] = "simplify-collisions{how=[primitive,hull] max-relative-error=0.02}"

    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))
    collisions: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only collisions"))
    how: tuple[Way, ...] = Field(
        default=("primitive", "hull", "parts"), min_length=1, description="What is tried, in this order; see above."
    )
    shapes: tuple[Kind, ...] = Field(
        default=("box", "sphere", "cylinder", "capsule"),
        min_length=1,
        description="Primitives to choose from; capsules only where the version of the format has them.",
    )
    max_error: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="The distance that is allowed, in m."
    )
    max_relative_error: float | None = Field(
        default=0.05, gt=0, allow_inf_nan=False, description="The same as a share of the diagonal of the mesh."
    )
    triangles: int | None = Field(
        default=None, ge=4, description="The most triangles of a collision, of all its parts together."
    )
    parts: int = Field(default=16, ge=1, le=256, description="The most parts of a collision.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other collisions."""
        bench, matched = self.workbench(sink), list[Collision]()
        made = rewrite(document, Link, lambda link: self._simplify_link(link, self._options(document), bench, matched))
        if not matched:
            message = f"no collision {', '.join(self.collisions)!r} on a link {', '.join(self.links)!r} has a mesh"
            sink.report(NOTHING_MATCHED, message, document.location, found=", ".join(self.collisions))
        return made

    def _options(self, document: Document) -> Options:
        version = tuple(int(part) for part in (document.version or "1.0").split(".") if part.isdigit())
        shapes = [each for each in self.shapes if each != "capsule" or version >= _CAPSULES[document.format]]
        return {
            **self.read_options, "how": list(self.how), "shapes": shapes, "max_error": self.max_error,
            "max_relative_error": self.max_relative_error, "triangles": self.triangles, "parts": self.parts,
        }  # fmt: skip

    def _simplify_link(self, link: Link, options: Options, bench: Workbench, matched: list[Collision]) -> Link:
        if not matches(link.name, self.links):
            return link
        found: list[Collision] = []
        for one in link.collisions:
            mesh = one.geometry.shape if one.geometry else None
            if not isinstance(mesh, Mesh) or not matches(one.name, self.collisions):
                found.append(one)
                continue
            matched.append(one)
            taken = {each.name for each in (*link.collisions, *found) if each.name}
            found += _simplify_collision(link, one, mesh, options, bench, taken)
        same = len(found) == len(link.collisions) and all(a is b for a, b in zip(found, link.collisions, strict=True))
        return link if same else link.copy(collisions=tuple(found))


def _simplify_collision(
    link: Link, collision: Collision, mesh: Mesh, options: Options, bench: Workbench, taken: set[str]
) -> list[Collision]:
    """The collisions that replace one; the collision itself where it stays."""
    what = f"{f'collision {collision.name!r}' if collision.name else 'a collision'} of link {link.name!r}"
    if link.inertial and link.inertial.auto:
        message = f"{what} stays as it is: the inertia of the link is computed from it"
        bench.sink.report(KEPT_MESH, message, collision.location, help="write the inertia out with fill-inertia first")
        return [collision]
    try:
        if bench.sources.find((mesh.uri or "").strip()).is_made(_MADE_STEM):
            return [collision]
        outcome = bench.outcome("simplify", mesh, {**options, "scale": list(mesh.scale or (1.0, 1.0, 1.0))})
        facts = outcome.result.facts
        if "kept" in facts:
            limit = facts["limit"]
            within = f"within {format_length(as_number(limit))} " if limit is not None else ""
            message = f"{what} stays as it is: nothing cheaper was found {within}({facts['kept']})"
            bench.sink.report(
                KEPT_MESH, message, collision.location, found=f"{as_number(facts['before']):.0f} triangles"
            )
            return [collision]
        is_primitive = facts["how"] == "primitive"
        made = _as_primitive(collision, outcome) if is_primitive else _as_convex_parts(collision, outcome, bench, taken)
    except MeshError as error:
        report_kept_mesh(bench.sink, error, what, collision.location)
        return [collision]
    became = f"a {facts['kind']}" if is_primitive else _describe_convex(made, as_number(facts["after"]))
    off = format_length(as_number(facts["error"]))
    message = f"{what}: {as_number(facts['before']):.0f} triangles became {became}, at most {off} off"
    bench.sink.report(CHANGED_MESH, message, collision.location)
    return made


def _describe_convex(made: Sequence[Collision], triangles: float) -> str:
    what = "a convex hull" if len(made) == 1 else f"{len(made)} convex parts"
    return f"{what} of {triangles:.0f}"


def _as_primitive(collision: Collision, outcome: MeshOutcome) -> list[Collision]:
    facts = outcome.result.facts
    sizes, center, rows = (cast("list[float]", facts[key]) for key in ("sizes", "center", "rotation"))
    a, b, c, d, e, f, g, h, i = rows
    inner = Transform((center[0], center[1], center[2]), (a, b, c, d, e, f, g, h, i))
    pose = collision.pose
    placed = Transform.from_pose(pose).compose(inner)
    named = pose.relative_to if pose else None
    return [_with_shape(collision, _primitive_shape(str(facts["kind"]), sizes), pose=placed.to_pose(named))]


def _primitive_shape(kind: str, sizes: Sequence[float]) -> Shape:
    if kind == "box":
        return Box(size=(sizes[0], sizes[1], sizes[2]))
    if kind == "sphere":
        return Sphere(radius=sizes[0])
    made = Capsule if kind == "capsule" else Cylinder
    return made(radius=sizes[0], length=sizes[1])


def _as_convex_parts(collision: Collision, outcome: MeshOutcome, bench: Workbench, taken: set[str]) -> list[Collision]:
    """A collision for each file of convex parts; the first keeps the name of the old one."""
    files = [*outcome.result.files.values()]
    found: list[Collision] = []
    for index, data in enumerate(files, 1):
        suffix = "_hull.obj" if len(files) == 1 else f"_part{index}.obj"
        uri = bench.add(outcome.stem, {suffix: data})
        one = _with_shape(collision, Mesh(uri=uri))
        if index > 1 and collision.name:
            one = one.copy(name=_free_name(collision.name, index, taken))
        found.append(one)
    return found


def _free_name(name: str, index: int, taken: set[str]) -> str:
    free = f"{name}_part{index}"
    while free in taken:
        free += "_"
    taken.add(free)
    return free


def _with_shape(collision: Collision, shape: Shape, **fields: object) -> Collision:
    geometry = (collision.geometry or Geometry()).copy(shape=shape)
    return collision.copy(**{"geometry": geometry, **fields})
