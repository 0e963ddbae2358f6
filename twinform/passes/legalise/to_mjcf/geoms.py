"""Geoms of MJCF: the collisions of a link, which touch, and its visuals, which are only seen.

A visual is a geom that touches nothing (`contype` and `conaffinity` 0) and weighs nothing. Visuals are in group 2,
which viewers show; collisions are in group 3, which they hide, where the model has any visuals. Sizes are half sizes.
"""

from collections.abc import Collection, Sequence
from typing import NamedTuple, TypeVar

from twinform.diagnostics import rules
from twinform.ir import Collision, Element, Visual
from twinform.ir.geometry import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Empty,
    Heightmap,
    Mesh,
    Plane,
    Shape,
    Sphere,
)  # fmt: skip
from twinform.ir.node import Vector3
from twinform.ir.pose import Pose
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import SAME_GEOM, find_annotation
from twinform.passes.carriers.old_names import source_name
from twinform.passes.legalise.to_mjcf.assets import height_field, mesh_asset, vector_in
from twinform.passes.legalise.to_mjcf.contacts import touch_of
from twinform.passes.legalise.to_mjcf.elements import ENDLESS, GRID, Attributes, Value, make_element, placement
from twinform.passes.legalise.to_mjcf.fitted_geoms import fitted_mesh, geom_size, mesh_reference, without_mesh
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements, kept_of_geom, with_kept
from twinform.passes.legalise.to_mjcf.looks import has_look, look
from twinform.passes.legalise.to_mjcf.materials import look_of, with_known_material
from twinform.passes.legalise.to_mjcf.said_parts import without_elements
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext
from twinform.passes.mesh_jobs.mesh_files import NoMeshError
from twinform.passes.shared.nodes import reserve_name

AnyPart = TypeVar("AnyPart", Visual, Collision)
_SEEN, _TOUCHED = 2, 3
"""The groups of visuals and of collisions."""
_COLORS = frozenset({"material", "rgba"})
_UNTOUCHED: Attributes = (("contype", "0"), ("conaffinity", "0"))
_WEIGHTLESS: Attributes = (("density", "0"),)
UP: Vector3 = (0.0, 0.0, 1.0)


class Solid(NamedTuple):
    """The attributes of a geom that say its shape, and where the shape is in the frame of its visual or collision."""

    attributes: Sequence[tuple[str, Value]]
    at: Transform = Transform()


def geom_elements(context: MjcfContext, body: Body) -> list[Element]:
    """The geoms of a body: its collisions and then its visuals.

    Raises:
        FrameError: a frame is not known, or frames go round in a circle.
    """
    found: list[Element] = []
    marked = (each for each in body.link.visuals if find_annotation(each, SAME_GEOM) is not None)
    twins = {each.name: each for each in marked} if context.is_of_mjcf else {}
    parted = {each.name: each for each in body.link.collisions if each.name in twins}
    done, shown = set[int](), set[str]()
    for collision in body.link.collisions:
        if (shape := _shape_of(context, body, collision)) is not None:
            twin = twins.get(collision.name)
            more = touch_of(context, body, collision)
            if twin is not None and _is_one_geom(twin, collision):
                done.add(id(twin))
                shown.add(_kept_group(collision))
                more = [*more, *look_of(context, body, twin, collision)]
            else:
                more = [*more, *_group(context, collision, _TOUCHED)]
            is_seen = twin is not None and id(twin) in done
            found.append(_geom(context, body, collision, shape, more, seen=twin if is_seen else None))
            if twin is not None and is_seen and id(collision) in context.written_geoms:
                context.written_geoms[id(twin)] = context.written_geoms[id(collision)]
                _leave_as(context, collision, twin)
    for visual in body.link.visuals:
        if id(visual) not in done and (shape := _shape_of(context, body, visual)) is not None:
            # Beside visuals in their own group, one that touches too would count as hidden.
            group = _beside_twins(visual, shown) if done else _group(context, visual, _SEEN)
            weightless = () if context.is_of_mjcf or kept_of_geom(visual, "density") else _WEIGHTLESS
            looks = look_of(context, body, visual, other := parted.get(visual.name))
            if other is not None and (material := kept_of_geom(other, "material")):  # only the collision was changed
                looks = [("material", material), *looks]
            more = [*_UNTOUCHED, *group, *weightless, *looks]
            found.append(_geom(context, body, visual, shape, more, seen=visual))
    found = _with_hidden_alone(context, body, found)
    if context.unnamed:
        _name_what_is_read_otherwise(context, body, [each.get("name") or "" for each in found])
    return found


def _is_one_geom(twin: Visual, collision: Collision) -> bool:
    """Whether a visual is still one geom with a collision: one that is transparent or hidden is read as no visual."""
    *_, alpha = look(twin).rgba or (1.0,)
    is_shown = alpha > 0.0 and _kept_group(collision) in {"", "0", "1", "2"}
    return is_shown and (twin.geometry, twin.pose) == (collision.geometry, collision.pose)


def _with_hidden_alone(context: MjcfContext, body: Body, geoms: list[Element]) -> list[Element]:
    """The geoms of a body, where those that only touch are in a group of their own, unless others have them hidden."""
    names = context.written_geoms
    seen = {names.get(id(each)) for each in body.link.visuals}
    alone = {names.get(id(each)) for each in body.link.collisions if _is_hidden_beside(context, each)} - seen
    if not alone or any(map(_hides_what_touches, (*geoms, *kept_elements(body.link)))):
        return geoms
    return [_in_group(each, _TOUCHED) if each.get("name") in alone else each for each in geoms]


def _hides_what_touches(geom: Element) -> bool:
    """Whether geoms in group 0 are read as hidden beside this one: it is only seen, and in a group of its own."""
    return (geom.get("contype"), geom.get("conaffinity")) == ("0", "0") and geom.get("group") in {"1", "2"}


def _in_group(geom: Element, group: int) -> Element:
    others = tuple(pair for pair in geom.attributes if pair[0] != "group")
    return geom.copy(attributes=(*others, ("group", str(group))))


def _name_what_is_read_otherwise(context: MjcfContext, body: Body, geoms: Sequence[str]) -> None:
    """Let geoms without names have them where reading would make others: of several, one was taken out or moved."""
    made = {
        name: (_wish(body, part), part.name)
        for part in (*body.link.visuals, *body.link.collisions)
        if (name := context.written_geoms.get(id(part))) is not None and ("geom", name) in context.unnamed
    }
    order = [each for each in geoms if each in made]
    misread: str | None = ""
    while misread is not None:
        taken, numbers = {each for each in geoms if each not in order}, dict[str, int]()
        read = {each: reserve_name(made[each][0], taken, numbers) for each in order}
        misread = next((each for each in order if read[each] != made[each][1]), None)
        if misread is not None:
            context.unnamed.discard(("geom", misread))
            order.remove(misread)


def _wish(body: Body, part: Visual | Collision) -> str:
    """What the name of a geom without one is made of where it is read."""
    return f"{body.link.name}_{part.__class__.__name__.lower()}"


def _leave_as(context: MjcfContext, written: Collision, twin: Visual) -> None:
    """Leave of the shape of a visual what was left of that of the collision whose geom stands for both."""
    one, other = (each.geometry.shape if each.geometry else None for each in (written, twin))
    if one is not None and other is not None and id(one) in context.left:
        context.leave(other, context.left[id(one)][1])


def _group(context: MjcfContext, part: Visual | Collision, group: int) -> list[tuple[str, Value]]:
    """The group of a geom: collisions are in one of their own where there are visuals; one of MJCF stays in its own."""
    is_touched = group == _TOUCHED
    if context.is_of_mjcf:
        is_shown = is_touched and _kept_group(part) in {"1", "2"} and not _is_transparent(context, part)
        return [("group", str(group))] if is_shown else []
    # A collision that keeps the color of its geom is no visual: in a group that is shown, it would be read as one too.
    is_shown = is_touched and not context.has_visuals and not any(kept_of_geom(part, each) for each in _COLORS)
    return [] if _kept_group(part) or is_shown else [("group", str(group))]


def _is_hidden_beside(context: MjcfContext, collision: Collision) -> bool:
    """Whether a collision without a visual of a file of MJCF is shown unless others in its body have it hidden.

    Then it was added to the robot while that was in another language, or its visual was deleted there.
    """
    return context.is_of_mjcf and _kept_group(collision) in {"", "0"} and not _is_transparent(context, collision)


def _beside_twins(visual: Visual, shown: Collection[str]) -> list[tuple[str, Value]]:
    """The group of a visual beside collisions that are `shown` in their groups: it hides them, if it came from others.

    Reading takes what touches for hidden, if it is in group 0, and what is only seen is in another one.
    """
    return [("group", "0")] if _kept_group(visual) in {"1", "2"} and not {"", "0"}.isdisjoint(shown) else []


def _kept_group(part: Visual | Collision) -> str:
    return kept_of_geom(part, "group")


def _is_transparent(context: MjcfContext, part: Visual | Collision) -> bool:
    rgba = kept_of_geom(part, "rgba") or context.colors.get(kept_of_geom(part, "material"), "")
    return [float(each) for each in rgba.split()[3:]] == [0.0]


def _geom(
    context: MjcfContext, body: Body, part: AnyPart, shape: Solid, more: Attributes, *, seen: Visual | None
) -> Element:
    name = context.name_in(body, "geom", source_name(part), part)
    if name is not None:
        context.written_geoms[id(part)] = name
        if context.is_of_mjcf:
            context.note_made_name("geom", part, name, _wish(body, part))
    at = context.resolve(part.pose, body).compose(shape.at)
    attributes = [("name", name), *shape.attributes, *placement(at), *more]
    bare = make_element("geom", attributes, (), part.source)
    element = with_kept(bare, part)
    if element is not bare and any(key == "size" for key, _ in shape.attributes):
        element = without_mesh(element)
    if context.is_of_mjcf and seen is not None and not has_look(seen):
        # It was deleted: what is read of MJCF has the colors of its geom.
        return element.copy(attributes=tuple(pair for pair in element.attributes if pair[0] not in _COLORS))
    return with_known_material(context, element)


def _shape_of(context: MjcfContext, body: Body, part: AnyPart) -> Solid | None:
    """The shape of a visual or collision; None where MJCF has none for it, which is reported."""
    written = part.geometry.shape if part.geometry else None
    if written is None or isinstance(written, Empty):
        return None
    try:
        # A mesh stands for a shape that MJCF lacks.
        replaced = context.replacer.replace(part, body.name)
        shape = replaced.geometry.shape if replaced.geometry and replaced.geometry.shape else written
        found = _solid(context, body, shape, part)
    except NoMeshError as error:
        message = f"{_called(part, body)} is a {written.kind}, which MJCF does not have"
        context.sink.report(rules.UNSAYABLE_SHAPE, message, part.location, found=written.kind, help=str(error))
        return None
    if isinstance(found, str):
        context.sink.report(rules.UNSAYABLE_SHAPE, f"{_called(part, body)} {found}", part.location, found=written.kind)
        return None
    return found


def _called(part: Visual | Collision, body: Body) -> str:
    return f"{type(part).__name__.lower()} {part.name!r} of link {body.name!r}"


def _solid(context: MjcfContext, body: Body, shape: Shape, part: Visual | Collision) -> Solid | str | None:
    """The shape in MJCF; why it has none; or None where that was reported."""
    match shape:
        case Mesh():
            return _mesh_solid(context, shape, part)
        case Plane():
            if body.moves:
                return "is a plane on a link that moves, and MuJoCo takes planes on fixed bodies alone"
            return _plane(shape, tuple(map(float, kept_of_geom(part, "size").split())))
        case Heightmap():
            name = height_field(context, shape, kept_of_geom(part, "hfield"))
            context.leave(shape, without_elements(shape, {"size", "pos"}))
            at = Pose.unchecked(xyz=vector_in(shape, "pos", (0.0, 0.0, 0.0)))
            return None if name is None else Solid([("type", "hfield"), ("hfield", name)], Transform.from_pose(at))
        case Box() | Sphere() | Ellipsoid() | Cylinder() | Capsule():
            name = kept_of_geom(part, "mesh")
            if name and (mesh := fitted_mesh(part, shape, context.kept_asset("mesh", name))) is not None:
                return Solid([("type", shape.kind)], mesh)
            size = geom_size(shape)
            size += tuple(map(float, kept_of_geom(part, "size").split()))[len(size) :]  # more than MuJoCo needs
            if min(size) <= 0.0:
                return "has a size of 0, which MuJoCo refuses"
            return Solid([("type", shape.kind), ("size", size)])
        case _:
            return f"has the shape {shape.kind}, which MJCF does not have"


def _mesh_solid(context: MjcfContext, shape: Mesh, part: Visual | Collision) -> Solid | None:
    """A mesh, whose asset may keep the reference pose that it had in MJCF."""
    wanted, scale = kept_of_geom(part, "mesh"), shape.scale or (1.0, 1.0, 1.0)
    kept = context.kept_asset("mesh", wanted) if wanted else None
    at = Transform() if kept is None else mesh_reference(kept, scale)
    if len(set(scale)) > 1 and not at.is_unturned:
        wanted, at = "", Transform()  # MuJoCo scales what it has turned
    name = mesh_asset(context, shape, wanted, touches=isinstance(part, Collision))
    return None if name is None else Solid([("type", "mesh"), ("mesh", name)], at if name == wanted else Transform())


def _plane(shape: Plane, kept: Sequence[float]) -> Solid:
    """A plane, which faces z in MJCF; what touches it has no end, and what is seen of it has the written size.

    A plane that was read of MJCF has the distance of the lines on it, and no end where it has none there.
    """
    x, y = shape.size or (1.0, 1.0)
    size = (x / 2, y / 2, kept[-1] if kept else GRID)
    if tuple(2 * each or ENDLESS for each in kept[:2]) == (x, y):
        size = (kept[0], kept[1], size[-1])
    return Solid([("type", "plane"), ("size", size)], turn_up_to(shape.normal or UP))


def turn_up_to(normal: Vector3) -> Transform:
    """The shortest turn from z to a direction of any length."""
    x, y, z = normal
    length = (x * x + y * y + z * z) ** 0.5
    if (x, y) == (0.0, 0.0):
        return Transform() if z >= 0 else Transform.from_pose(Pose.unchecked(quat_xyzw=(1.0, 0.0, 0.0, 0.0)))
    return Transform.from_pose(Pose.unchecked(quat_xyzw=(-y, x, 0.0, length + z)))
