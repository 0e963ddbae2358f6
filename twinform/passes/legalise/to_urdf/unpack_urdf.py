"""Unpacking carriers of URDF parts into the nodes that they came from."""

from collections.abc import Callable
from functools import partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Element, GazeboExtension, Link, Model, Node, Opaque, map_children, rewrite
from twinform.ir.frames import WORLD
from twinform.passes.carriers.carriers import bits_of_ours, is_carrier, is_dangling, is_overruled, unpack
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.urdf_pieces import Standing, misfit
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, MODEL_TAGS, Tag
from twinform.request_options import UrdfVersion

AnyNode = TypeVar("AnyNode", bound=Node)


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
