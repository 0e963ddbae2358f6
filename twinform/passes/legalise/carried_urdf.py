"""What SDF cannot say of URDF: put into carriers, and unpacked where it stood."""

from collections.abc import Callable, Container, Iterator
from functools import cache, partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import (
    OPAQUE,
    Collision,
    Element,
    Format,
    GazeboExtension,
    Inertial,
    Joint,
    Link,
    Model,
    Node,
    Opaque,
    Pose,
    Visual,
    bits_of,
    map_children,
    rewrite,
)
from twinform.ir.foreign_joints import closes_loop
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import came_from
from twinform.passes.carriers.carriers import (
    DANGLING,
    Keeper,
    bits_of_ours,
    carry,
    is_carrier,
    is_dangling,
    is_ours,
    is_overruled,
    unpack,
)
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.urdf_pieces import BALLS, OF_AN_AXIS, Standing, joints_of, misfit
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, MODEL_TAGS, Tag
from twinform.request_options import UrdfVersion
from twinform.schemas import Fact, table

AnyNode = TypeVar("AnyNode", bound=Node)

_IN_BOTH = (Model, Link, Joint, Visual, Collision, Inertial)
"""Nodes that are an element in both formats, in which other tools' parts stand as they are."""


class CarryUrdf(ModelPass):
    """Put every opaque part of a URDF model into a carrier where it stands, and unpack those that SDF left here.

    Changes: 1. opaque elements, attributes and text of URDF (transmissions, ros2_control, other tools' elements) become
    carriers; 2. parts of an origin, which is a plain text in SDF, are carried by what has the origin; 3. carriers of
    SDF that add to what the model has become parts of it again; the others stay, for nothing may be stated twice; 4.
    what Bullet calls `spherical` and Drake `ball` is a `ball` that carries this name. With `carriers` false, none of
    these parts is carried.
    Never touches: typed fields.
    Diagnostics: none; every part has a ledger entry under `urdf-only`.
    """

    name: ClassVar[str] = "carry-urdf"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without opaque parts of URDF."""
        joints = frozenset(joint.name for joint in model.joints)
        back = came_from(model, Format.SDF)
        # Only nodes with something to sweep are rewritten; in a plain robot that is none.
        having = OPAQUE | (bits_of(Joint) if any(joint.type in BALLS for joint in model.joints) else 0)
        swept = rewrite(model, Node, lambda node: self._sweep(node, sink, back), having=having)
        return swept.copy(opaque=tuple(_with_doubt(part, joints) for part in swept.opaque))

    def _sweep(self, node: Node, sink: DiagnosticSink, back: bool) -> Node:
        if isinstance(node, GazeboExtension):  # the next pass knows what may stand in it
            return node
        if isinstance(node, Joint) and node.type in BALLS:
            message = f"{node.type} joint {node.name!r} has a type that only dialects of URDF have"
            # Bullet's `spherical` and Drake's `ball` are ball joints of SDF. The name of the type
            # travels along, so the conversion back makes no chain of it.
            kept = [Opaque.unchecked(attribute=("type", node.type))]
            ball = self._swept(node.copy(type="ball"), sink, back)
            return self._carry(ball, kept, sink, message)
        return self._swept(node, sink, back)

    def _swept(self, node: AnyNode, sink: DiagnosticSink, back: bool) -> AnyNode:
        """The node with its own parts in carriers, or out of them."""
        pose: Pose | None = getattr(node, "pose", None)
        if not node.opaque and not (pose and pose.opaque):
            return node
        kept: list[Opaque] = []
        pieces: list[Opaque] = []
        for part in node.opaque:
            if is_ours(part):
                kept += _unpacked(part)
            elif closes_loop(part):  # as for <gazebo>: a later pass knows what it is
                kept.append(part)
            else:  # other tools' parts stood in the SDF file as they do here
                (kept if back and isinstance(node, _IN_BOTH) and _is_foreign(part) else pieces).append(part)
        update: dict[str, object] = {"opaque": tuple(kept)}
        if pose and pose.opaque:
            pieces += [_inside("origin", part) for part in pose.opaque]
            update["pose"] = pose.copy(opaque=())
        return self._carry(node.copy(**update), pieces, sink) if not isinstance(node, Pose) else node

    def _carry(self, node: AnyNode, pieces: list[Opaque], sink: DiagnosticSink, message: str = "") -> AnyNode:
        keeper = Keeper(sink, self.carriers)
        for piece in pieces:
            why = message or f"{piece.name} is not a part of SDF"
            where = piece.location if piece.source else node.location
            keeper.account(rules.URDF_ONLY, why, where, max(1, piece.weight))
        if not self.carriers:
            return node
        once = OF_AN_AXIS if isinstance(node, Joint) else ()  # a second one means nothing, and no edit has made it so
        first, again = list[Opaque](), list[Opaque]()
        for piece in pieces:
            (again if piece.element and piece.element.name in once else first).append(piece)
        return carry(carry(node, first, "urdf"), again, "urdf", DANGLING)


def _is_foreign(part: Opaque) -> bool:
    name = part.element.name if part.element else part.attribute[0] if part.attribute else ""
    return not part.at and name.startswith("{")


def _with_doubt(part: Opaque, joints: Container[str]) -> Opaque:
    """A carrier that states it, if what it holds is about a joint that the robot never had."""
    if not is_carrier(part, "urdf") or part.element is None or not part.element.children:
        return part
    named = [name for piece in unpack(part) if piece.element for name in joints_of(piece.element)]
    if all(name in joints for name in named):
        return part
    element = part.element.copy(attributes=(*DANGLING, *part.element.attributes))
    return part.copy(element=element)


def _unpacked(part: Opaque) -> tuple[Opaque, ...]:
    """What is in a carrier of SDF, if the model does not say it already in elements of its own; else the carrier."""
    pieces = unpack(part) if is_carrier(part, "sdf") and part.element and part.element.get("index") is None else ()
    # A carrier whose element the model may have by now in a field waits for `unpack-sdf`: nothing
    # may be stated twice.
    fit = all(piece.element and not piece.at and piece.element.name not in _typed_in_sdf() for piece in pieces)
    return pieces if pieces and fit else (part,)


@cache
def _typed_in_sdf() -> frozenset[str]:
    """Elements that a typed field of the IR stands for, which `unpack-sdf` puts back where nothing else is written."""
    definitions = table("sdf").definitions.values()
    placed = {row.name for definition in definitions for row in _rows(definition) if row.place}
    return frozenset(placed)


def _rows(fact: Fact) -> Iterator[Fact]:
    for row in fact.rows:
        yield row
        yield from _rows(row)


def _inside(step: str, part: Opaque) -> Opaque:
    return part.copy(at=f"{step}/{part.at}" if part.at else step)


class UnpackUrdf(ModelPass):
    """Put what SDF could not express, and carriers of URDF hold, back into the robot.

    Changes: 1. transmissions, ros2_control, safety limits, parts that other tools read and the like stand where they
    stood; 2. the link `world` has its body again.
    Never touches: what the model has by now; what names a link or joint that is gone.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "unpack-urdf"
    urdf_version: UrdfVersion = "1.0"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without carriers of what URDF can express."""
        if sink.has_errors:
            return model
        change = partial(_unpack_node, Standing(model, self.urdf_version), sink)
        model = map_children(model, lambda child: rewrite(child, Node, change, having=bits_of_ours("urdf")))
        standing = Standing(model, self.urdf_version)
        model = _unpack_parts(_restore_world(model), partial(misfit, node=model, standing=standing), sink)
        return _restore_overruled(model, sink)


def _unpack_node(standing: Standing, sink: DiagnosticSink, node: Node) -> Node:
    return _unpack_parts(node, lambda piece: misfit(piece, node, standing), sink)


def _unpack_parts(node: AnyNode, misfit: Callable[[Opaque], str], sink: DiagnosticSink) -> AnyNode:
    """The node with carriers of URDF unpacked, except for pieces that `misfit` gives a reason against."""
    if not any(map(_is_plain, node.opaque)):
        return node
    opaque: list[Opaque] = []
    for part in node.opaque:
        for piece in unpack(part) if _is_plain(part) else (part,):
            why = misfit(piece) if piece is not part and not is_dangling(part) else ""
            if why:
                message = f"{piece.name} of {_describe(node)} is not restored: {why}"
                sink.report(STALE_CARRIER, message, part.location_in(node), found=piece.name)
            else:
                opaque.append(piece)
    return node.copy(opaque=tuple(opaque))


def _is_plain(part: Opaque) -> bool:
    return is_carrier(part, "urdf") and not is_overruled(part)


def _restore_overruled(model: Model, sink: DiagnosticSink) -> Model:
    """The model with overridden tags back in front of the tags that override them."""
    carriers = [part for part in model.opaque if is_carrier(part, "urdf") and is_overruled(part)]
    if not carriers:
        return model
    model = model.copy(opaque=tuple(part for part in model.opaque if part not in carriers))
    for part in carriers:
        for piece in unpack(part):
            more = _insert_overruled(model, piece.element) if piece.element else None
            if more is None:
                message = f"{piece.name} of {_describe(model)} is not restored: what overruled it is gone"
                sink.report(STALE_CARRIER, message, part.location_in(model), found=piece.name)
            else:
                model = more
    return model


def _describe(node: Node) -> str:
    name = getattr(node, "name", None)
    return f"{type(node).__name__.lower()} {name!r}" if name else f"an {type(node).__name__.lower()}"


def _restore_world(model: Model) -> Model:
    """The model with the carried body of its link `world` back."""
    index = next((i for i, link in enumerate(model.links) if link.name == WORLD), None)
    bodies = {
        part: piece
        for part in model.opaque
        if is_carrier(part, "urdf")
        for piece in unpack(part)
        if piece.element is not None and piece.element.name == "link" and piece.element.get("name") == WORLD
    }
    if index is None or not bodies:
        return model
    part, body = next(iter(bodies.items()))
    children = tuple(Opaque.unchecked(element=child) for child in body.element.children) if body.element else ()
    attributes = body.element.attributes if body.element else ()
    children += tuple(Opaque.unchecked(attribute=pair) for pair in attributes if pair[0] != "name")
    world: Link = model.links[index].copy(opaque=(*model.links[index].opaque, *children))
    links = (*model.links[:index], world, *model.links[index + 1 :])
    kept = tuple(each for each in model.opaque if each is not part)
    return model.copy(links=links, opaque=kept)


_TAGS = MODEL_TAGS | JOINT_TAGS | LINK_TAGS
_ELEMENTS = {"surface": "collision", "collision": "collision", "physics": "physics", "dynamics": "axis"}
"""The SDF element in an extension that overrides a tag, by the target of the tag."""


def _insert_overruled(model: Model, extension: Element) -> Model | None:
    """The model with overridden content of a `<gazebo>` back; None where nothing overrides it any more."""
    reference = extension.get("reference")
    for element in extension.children:
        if (found := _insert_tag(model.extensions, reference, element)) is not None:
            model = model.copy(extensions=found)
        elif (parts := _insert_before_carried(model.opaque, extension, element)) is not None:
            model = model.copy(opaque=parts)
        else:
            return None
    return model


def _insert_before_carried(
    parts: tuple[Opaque, ...], extension: Element, element: Element
) -> tuple[Opaque, ...] | None:
    """The opaque parts of a model with a tag before the carried `<gazebo>` that overrides it; None without one."""
    tag, place = _TAGS.get(element.name), (extension.name, extension.attributes)
    for index, part in enumerate(parts):
        if tag is None or part.element is None or (part.element.name, part.element.attributes) != place:
            continue
        if any(_overrules(other, tag) for other in part.element.children):
            alone = Opaque.unchecked(element=extension.copy(children=(element,)))
            return (*parts[:index], alone, *parts[index:])
    return None


def _insert_tag(
    extensions: tuple[GazeboExtension, ...], reference: str | None, element: Element
) -> tuple[GazeboExtension, ...] | None:
    tag = _TAGS.get(element.name)
    for index, one in enumerate(extensions):
        if tag is None or (one.reference or None) != (reference or None):
            continue
        place = next((at for at, other in enumerate(one.content) if _overrules(other, tag)), None)
        if place is not None:
            content = (*one.content[:place], element, *one.content[place:])
            return (*extensions[:index], one.copy(content=content), *extensions[index + 1 :])
    return None


def _overrules(other: Element, tag: Tag) -> bool:
    """Whether another element of an extension sets the field of a tag."""
    same = _TAGS.get(other.name)
    if same is not None and not other.children:
        return (same.target, same.field) == (tag.target, tag.field)
    leaf = tag.field.rpartition("/")[2]
    return other.name == _ELEMENTS.get(tag.target) and any(inner.name == leaf for inner in other.walk())
