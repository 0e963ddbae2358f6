"""Values that MJCF writes otherwise than the source: they come back as they were while they agree with the file.

A look, the URI of a mesh, the axes of an inertia, and, in a file beside this one, the types and ranges of joints.
What an edit has changed does not agree any more, and counts.
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any, TypeVar, cast

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.compiler.input.mjcf.joint_spellings import CLOSE, with_ends, with_motion, with_reference
from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Collision,
    Element,
    Geometry,
    Heightmap,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Mesh,
    Mimic,
    Node,
    Opaque,
    Plane,
    Pose,
    Sensor,
    Surface,
    Visual,
)
from twinform.ir.frames import WORLD
from twinform.ir.node import Vector3
from twinform.ir.solids import tensor, turned
from twinform.ir.transform import Transform
from twinform.passes.carriers.absorb import CarrierError, absorb
from twinform.passes.carriers.annotations import SAME_GEOM, annotation, find_annotation, without_annotation
from twinform.passes.carriers.carriers import to_element
from twinform.passes.carriers.mjcf_texts import (
    AXES,
    LOOK_OF,
    NORMAL,
    PARTS,
    SHAPE_OF,
    TERRAIN,
    Tagged,
    digest_of,
    look_parts,
)
from twinform.passes.carriers.old_names import NAME, source_name
from twinform.passes.carriers.partial_nodes import REST, is_rest, written_name
from twinform.passes.carriers.sdf_versions import is_version_carrier
from twinform.passes.carriers.token_mass import UNSAID
from twinform.passes.legalise.to_mjcf.contact_plan import MASKS
from twinform.passes.legalise.to_mjcf.friction import friction_of, rolling_of, torsional_part, with_rolling
from twinform.passes.legalise.to_mjcf.geoms import turn_up_to
from twinform.passes.legalise.to_mjcf.inertials import weight_parts
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT, kept_elements
from twinform.passes.legalise.to_mjcf.said_parts import child_number, untyped, without_elements
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.poses import read_vector
from twinform.schemas import XmlElement, format_value

AnyNode = TypeVar("AnyNode", bound=Node)
AnyShape = TypeVar("AnyShape", Visual, Collision)

_DIGITS = 12
"""To which a color is rounded once the opacity of its visual is out of it."""


class Spellings:
    """Decides for pairs of a node of a file and its partial node which of them gives way where both say the same.

    Attributes:
        agreed: the tags and names of the assets whose looks come back as they were.
    """

    def __init__(self, root: XmlElement, sink: DiagnosticSink) -> None:
        self.agreed: set[tuple[str, str]] = set()
        self._sink = sink
        self._geoms = {each.get("name") or "": each for each in root.iter("geom")}
        self._assets = {(str(each.tag), each.get("name")): each for each in root.iterfind("asset/*")}
        self._by_class: Mapping[type[Node], Callable[[Any, Any], tuple[Node, Node]]] = {
            Link: lambda node, partial: _with_floating(node, _with_own_names(node, partial)),
            Visual: self._of_visual,
            Collision: lambda node, partial: _without_name_of_file(*self._with_rolling(*_with_shape(node, partial))),
            Surface: lambda node, partial: _with_torsion(*_with_second_coefficient(node, partial)),
            Joint: with_motion,
            Mimic: with_reference,
            Limit: lambda node, partial: (with_ends(node, partial), partial),
            Sensor: _with_contacts,
            Inertial: self._with_inertia,
        }

    def __call__(self, node: AnyNode, partial: AnyNode) -> tuple[AnyNode, AnyNode]:
        """Return both nodes."""
        settle = self._by_class.get(type(node)) if type(node) is type(partial) else None
        return (node, partial) if settle is None else cast("tuple[AnyNode, AnyNode]", settle(node, partial))

    def _of_visual(self, node: Visual, partial: Visual) -> tuple[Node, Node]:
        """The shape, the look and the transparency of the source."""
        looks = self._with_look(*_with_shape(node, partial))
        return _without_name_of_file(*_with_transparency(*looks))

    def _with_look(self, node: Visual, partial: Visual) -> tuple[Visual, Visual]:
        """The look of the source, if the file shows it as it was written."""
        note = find_annotation(partial, LOOK_OF)
        if note is None:
            return node, partial
        partial = without_annotation(partial, LOOK_OF)
        geom = self._geoms.get(source_name(node))
        parts = look_parts(_attributes(geom), self._asset) if geom is not None else []
        if digest_of(parts) != note.get("digest"):
            return node, partial.copy(material=None)
        if note.get("kept"):  # its material has a name that somebody gave it in the file
            return node.copy(material=None), partial
        self.agreed.update((tag, attributes["name"]) for tag, attributes in parts if "name" in attributes)
        return node.copy(material=None, opaque=_without_attributes(node.opaque, {"material"})), partial

    def _with_inertia(self, node: Inertial, partial: Inertial) -> tuple[Inertial, Inertial]:
        """The axes of the source, and what it had for a body without mass."""
        if find_annotation(partial, UNSAID) is not None:  # of a body without mass, as it is read
            node = without_annotation(node, UNSAID)
        return _with_axes(node, partial), without_annotation(self._computed(node, partial), AXES)

    def _computed(self, node: Inertial, partial: Inertial) -> Inertial:
        """What is kept of an inertia that was computed, without that if it or its shapes were edited since."""
        note = find_annotation(partial, PARTS)
        if note is None:
            return partial
        partial = without_annotation(partial, PARTS)
        names = [each.strip() for each in (note.text or "").splitlines()]
        geoms = [geom for each in names if (geom := self._geoms.get(each)) is not None]
        digest = digest_of([weight_parts(node), *(("geom", _attributes(each)) for each in geoms)])
        if digest == note.get("digest") and not any(_has_more(each, names) for each in geoms):
            return partial
        report_stale(
            self._sink, "the inertia is no longer computed: its numbers or its shapes were edited", node.source
        )
        return partial.copy(opaque=tuple(part for part in partial.opaque if not is_version_carrier(part)))

    def _with_rolling(self, node: Collision, partial: Collision) -> tuple[Collision, Collision]:
        """The rolling friction of the file in place of that of the source, which has a word of Bullet for it."""
        geom = self._geoms.get(source_name(node))
        if geom is None or partial.surface is None or friction_of(partial).rolling <= 0.0:
            return node, partial
        surface = with_rolling(partial.surface, rolling_of(_attributes(geom)))
        return node.copy(opaque=_without_attributes(node.opaque, {"friction", "condim"})), partial.copy(surface=surface)

    def _asset(self, tag: str, name: str) -> list[Tagged]:
        found = self._assets.get((tag, name))
        return [] if found is None else [(str(each.tag), _attributes(each)) for each in found.iter()]


def _with_transparency(node: Visual, partial: Visual) -> tuple[Visual, Visual]:
    """The color as it is without the transparency of the visual, which MJCF has in it; an edit may have taken that."""
    through = untyped(partial, "transparency")
    material = node.material
    if through is None or material is None or material.diffuse is None or partial.material is not None:
        return node, partial
    *color, opacity = material.diffuse
    share = 1.0 - child_number(through, default=0.0)
    if not 0.0 < opacity <= share * (1.0 + CLOSE):
        return node, without_elements(partial, {"transparency"})
    made = (*color, round(opacity / share, _DIGITS))
    return node.copy(material=material.copy(ambient=material.ambient and made, diffuse=made)), partial


def _without_name_of_file(node: Node, partial: Node) -> tuple[Node, Node]:
    """The node without the name of its geom, where it gets another one than that is read as."""
    is_renamed = written_name(partial) != getattr(partial, "name", None)
    return (without_annotation(node, NAME) if is_renamed else node), partial


def _with_own_names(node: Link, partial: Link) -> Link:
    """The partial link, whose shapes are called as in the file if another one there has their old names by now.

    A visual that is one geom with a collision is called as that is.
    """
    collisions = tuple(_without_taken(partial.collisions, {each.name for each in node.collisions}))
    visuals = tuple(_without_taken(partial.visuals, {each.name for each in node.visuals}))
    twins = {each.name for each in node.visuals if find_annotation(each, SAME_GEOM) is not None}
    if twins:
        names = {written_name(each): each.name for each in collisions}
        found = ((each, written_name(each)) for each in visuals)
        visuals = tuple(each.copy(name=names.get(name, name)) if name in twins else each for each, name in found)
    return partial.copy(visuals=visuals, collisions=collisions)


def _with_floating(node: Link, partial: Link) -> tuple[Link, Link]:
    """Both links, where the floating joint that is kept of a URDF takes the name of the free joint in the file."""
    floating = find_annotation(partial, FLOATING)
    free = next((each for each in kept_elements(node) if each.name == "freejoint" and each.get("name")), None)
    if floating is None or free is None:
        return node, partial
    others = tuple(pair for pair in floating.attributes if pair[0] != "joint")
    named = floating.copy(attributes=(("joint", free.get("name") or ""), *others))
    parts = tuple(part.copy(element=named) if part.element is floating else part for part in partial.opaque)
    return node.copy(opaque=_without_name(node.opaque, free)), partial.copy(opaque=parts)


def floating_from_world(link: Link, names: Collection[str]) -> Link:
    """A free link, annotated with the joint that it needs in URDF, which has the name of the joint in the file."""
    made = annotation(
        FLOATING, attributes={"joint": unique_name(f"{link.name}_floating_joint", names), "parent": WORLD}
    )
    link, mark = _with_floating(link, Link.unchecked(name=link.name, opaque=(made,)))
    return link.copy(opaque=(*link.opaque, *mark.opaque))


def _without_name(parts: tuple[Opaque, ...], free: Element) -> tuple[Opaque, ...]:
    """The untyped parts of a link without the name of its free joint; a joint of which no more is kept goes too."""
    left = _without(free, {"name"})
    found: list[Opaque] = []
    for part in parts:
        if part.element is None or all(each is not free for each in part.element.children):
            found.append(part)
            continue
        own = [left] if left.attributes or left.children else []
        children = [one for each in part.element.children for one in (own if each is free else [each])]
        if children:
            found.append(part.copy(element=part.element.copy(children=tuple(children))))
    return tuple(found)


def _without_taken(partials: tuple[AnyShape, ...], names: set[str | None]) -> Iterator[AnyShape]:
    """Yield partial shapes; what would get the name of another one keeps the name that it has in the file."""
    others = names - set(map(written_name, partials))
    return (each.copy(name=written_name(each)) if each.name in others else each for each in partials)


def _with_contacts(node: Sensor, partial: Sensor) -> tuple[Sensor, Sensor]:
    """The contacts of which a sensor told, if any of these collisions is there; one of MJCF tells of all."""
    told, read = untyped(partial, "contact"), untyped(node, "contact")
    if told is None or read is None:
        return node, partial
    is_there = not {each.text for each in told.children}.isdisjoint(each.text for each in read.children)
    contact = {"contact"}
    return (without_elements(node, contact), partial) if is_there else (node, without_elements(partial, contact))


def _attributes(element: XmlElement) -> dict[str, str]:
    return {str(name): str(value) for name, value in element.items()}


def _without_attributes(parts: tuple[Opaque, ...], names: Collection[str]) -> tuple[Opaque, ...]:
    """Remainders of a geom without attributes, such as the name of its material."""
    return tuple(
        part.copy(element=part.element.copy(children=tuple(_without(each, names) for each in part.element.children)))
        if part.element is not None and part.element.name == KEPT
        else part
        for part in parts
    )


def _without(element: Element, names: Collection[str]) -> Element:
    return element.copy(attributes=tuple(pair for pair in element.attributes if pair[0] not in names))


def _with_shape(node: AnyShape, partial: AnyShape) -> tuple[AnyShape, AnyShape]:
    """The shape or URI for which a file stands, if it is that file still; a plane that faces where it did."""
    node, partial = _with_position(*_with_normal(node, partial))
    note = find_annotation(partial, SHAPE_OF)
    if note is None:
        return node, partial
    partial = without_annotation(partial, SHAPE_OF)
    shape = node.geometry.shape if node.geometry else None
    more = _more_shapes(partial.geometry)
    partial = partial.copy(geometry=None) if more else partial
    if not isinstance(shape, Mesh | Heightmap) or shape.uri != note.get("file"):
        return node, partial
    try:
        pieces = tuple(Opaque.unchecked(element=each) for each in note.children)
        kept = absorb(Geometry.unchecked(), pieces).shape
    except CarrierError:
        return node, partial
    if isinstance(kept, Mesh) and isinstance(shape, Mesh):
        kept = kept.copy(scale=shape.scale)
    elif isinstance(kept, Heightmap):
        kept = kept.copy(opaque=(*kept.opaque, *shape.opaque))
    geometry = (node.geometry or Geometry.unchecked()).copy(shape=kept, opaque=more)
    beside = partial.geometry.copy(shape=None) if partial.geometry else None
    return node.copy(geometry=geometry), partial.copy(geometry=beside)


def _more_shapes(partial: Geometry | None) -> tuple[Opaque, ...]:
    """The shapes behind the first one, such as further polylines, for which one file stands too."""
    if partial is None or partial.shape is None or is_rest(partial.shape):
        return ()
    alone = to_element(Geometry.unchecked(shape=partial.shape), "geometry", "sdf")
    first = (Opaque.unchecked(element=each) for each in alone.children)
    return (*first, *without_annotation(partial, REST).opaque)


def _with_normal(node: AnyShape, partial: AnyShape) -> tuple[AnyShape, AnyShape]:
    """The plane with its normal in the source, turned back from there: planes of MJCF face z."""
    normal, partial = _vector_of(partial, NORMAL)
    shape = node.geometry.shape if node.geometry else None
    if normal is None or not isinstance(shape, Plane):
        return node, partial
    return _with_shape_in(node, shape.copy(normal=normal), turn_up_to(normal)), partial


def _with_position(node: AnyShape, partial: AnyShape) -> tuple[AnyShape, AnyShape]:
    """The terrain with its position in the source, moved back from there."""
    position, partial = _vector_of(partial, TERRAIN)
    shape = node.geometry.shape if node.geometry else None
    if position is None or not isinstance(shape, Heightmap):
        return node, partial
    written = Opaque.unchecked(element=Element.unchecked(name="pos", text=" ".join(map(format_value, position))))
    placed = Transform.from_pose(Pose.unchecked(xyz=position))
    return _with_shape_in(node, shape.copy(opaque=(*shape.opaque, written)), placed), partial


def _vector_of(partial: AnyShape, kind: str) -> tuple[Vector3 | None, AnyShape]:
    """The three numbers of an annotation, if it is there and has them, and the node without it."""
    note = find_annotation(partial, kind)
    if note is None:
        return None, partial
    try:
        vector = read_vector(note.get("xyz"))
    except ValueError:
        vector = None
    return vector, without_annotation(partial, kind)


def _with_shape_in(node: AnyShape, shape: Plane | Heightmap, place: Transform) -> AnyShape:
    """The node with a shape that is elsewhere in it, such that the shape itself stays where it is."""
    pose = Transform.from_pose(node.pose).compose(place.inverse()).to_pose()
    geometry = (node.geometry or Geometry.unchecked()).copy(shape=shape)
    return node.copy(geometry=geometry, pose=None if Transform.from_pose(pose).is_identity else pose)


def _has_more(geom: XmlElement, names: Collection[str]) -> bool:
    """Whether the body of a geom has one that may touch and has none of these names."""
    body = geom.getparent()
    others = () if body is None else (each for each in body.iterfind("geom") if each.get("name") not in names)
    return any(each.get("contype") != "0" or each.get("conaffinity") != "0" for each in others)


def _with_axes(node: Inertial, partial: Inertial) -> Inertial:
    """The inertial with the inertia in the axes of the source."""
    note = find_annotation(partial, AXES)
    if note is None or node.inertia is None or (node.pose is not None and not _is_unturned(node.pose)):
        return node
    try:
        rpy = read_vector(note.get("rpy"))
    except ValueError:
        return node
    turn = Transform.from_pose(Pose.unchecked(rpy=rpy))
    xx, yy, zz, xy, xz, yz = turned(tensor(node.inertia, 0.0), turn.inverse())
    inertia = Inertia.unchecked(ixx=xx, iyy=yy, izz=zz, ixy=xy, ixz=xz, iyz=yz, source=node.inertia.source)
    pose = (node.pose or Pose.unchecked()).copy(rpy=rpy)
    return node.copy(inertia=inertia, pose=pose)


def _is_unturned(pose: Pose) -> bool:
    return Transform.from_pose(pose.copy(relative_to=None)).is_unturned


def _with_second_coefficient(node: Surface, partial: Surface) -> tuple[Surface, Surface]:
    """The coefficients of SDF, of which MJCF has the first; and the masks of the file, where it has any."""
    if any(untyped(node, name) for name in MASKS):
        partial = without_elements(partial, [f"contact/{name}" for name in MASKS])
    if node.mu2 == node.mu and partial.mu2 is not None:
        node = node.copy(mu2=partial.mu2)
    return node, partial


def _with_torsion(node: Surface, partial: Surface) -> tuple[Surface, Surface]:
    """The torsional friction of the file, with what the source has of it beside the radius of the contact."""
    rest, own = (untyped(each, "torsional") for each in (partial, node))
    if own is None:
        return node, partial
    patch = friction_of(Collision.unchecked(surface=node)).torsional
    others = tuple(part for part in node.opaque if part.element is not own)
    return node.copy(opaque=(torsional_part(patch, rest), *others)), without_elements(partial, {"friction/torsional"})
