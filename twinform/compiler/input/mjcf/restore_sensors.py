"""Sensors, lights and settings of SDF that became other elements of MJCF: they come back while these are as written."""

from collections.abc import Collection, Iterable
from typing import NamedTuple, TypeVar

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Element, Frame, Joint, Light, Link, Model, Node, Opaque, Sensor, World, replace_fields, rewrite
from twinform.passes.carriers.annotations import WORLDBODY, find_annotation, without_annotation
from twinform.passes.carriers.mjcf_texts import PARTS, digest_of
from twinform.passes.carriers.old_names import NAME
from twinform.passes.carriers.partial_nodes import REST, written_name, written_names
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT
from twinform.passes.legalise.to_mjcf.options import SETTINGS
from twinform.schemas import XmlElement

AnyEmitter = TypeVar("AnyEmitter", Sensor, Light)
AnyHolder = TypeVar("AnyHolder", Link, Joint)
PartName = tuple[str, str]
"""The tag and the name of an element."""


class SensorsBack(NamedTuple):
    """The partial links and joints with the sensors that come back, and the elements that stand for these."""

    links: list[Link]
    joints: list[Joint]
    lights: tuple[Light, ...]
    parts: frozenset[PartName]


def sensors_back(
    links: Iterable[Link],
    joints: Iterable[Joint],
    lights: Iterable[Light],
    root: XmlElement,
    there: Collection[str],
    sink: DiagnosticSink,
) -> SensorsBack:
    """Find the sensors whose elements are in a canonical tree as they were written; the others are as they stand.

    `lights` are those of no link, and `there` are the names of links whose bodies need not have them: what is kept of
    others, and of no body, is stale.

    Those in bodies, and geoms whose contacts they tell, are still in the body of their link, or in the one that its
    joint moves.
    """
    links, joints = list(links), list(joints)
    bodies = {each.name: written_name(each) for each in links}
    elements = {(str(each.tag), each.get("name") or ""): each for each in root.iter()}
    used: set[PartName] = set()

    def back(sensor: AnyEmitter, of_holder: Collection[str | None]) -> AnyEmitter | None:
        note = find_annotation(sensor, PARTS)
        if note is None:
            return sensor
        names = [_part_name(line) for line in (note.text or "").splitlines()]
        found = [elements[name] for name in names if name in elements]
        digest = digest_of((str(each.tag), {str(k): str(v) for k, v in each.items()}) for each in found)
        geoms = (elements.get(("geom", name)) for each in found if (name := each.get("geom1")))
        placed = [*(each for each in found if each.tag in _IN_BODIES), *(each for each in geoms if each is not None)]
        is_moved = any(_body_around(each) not in {"", *of_holder} for each in placed)
        if not found or digest != note.get("digest") or is_moved:
            state = "was edited" if found else "is gone"
            report_stale(
                sink, f"what {type(sensor).__name__.lower()} {sensor.name!r} is in MJCF {state}", sensor.source
            )
            return None
        used.update(names)
        return without_annotation(sensor, PARTS, REST)

    def kept(parts: tuple[AnyEmitter, ...], *of_holder: str | None) -> tuple[AnyEmitter, ...]:
        return tuple(made for each in parts if (made := back(each, of_holder)) is not None)

    def moved_by(joint: Joint) -> str | None:
        written = elements.get(("joint", written_names(joint)[-1]))  # the last of several moves the body
        if written is not None:
            return _body_around(written)
        child = bodies.get(joint.child or "", joint.child)
        return None if _is_moved(elements.get(("body", child or ""))) and joint.type == "fixed" else child

    def of_link(link: Link) -> Link:
        body = bodies[link.name]
        if body == WORLDBODY and ("body", body) not in elements:
            body = None  # what stands in the world itself
        elif body not in there and ("body", body) not in elements:
            return replace_fields(link, sensors=(), lights=())
        return replace_fields(link, sensors=kept(link.sensors, body), lights=kept(link.lights, body))

    return SensorsBack(
        list(map(of_link, links)),
        [replace_fields(each, sensors=kept(each.sensors, moved_by(each))) for each in joints],
        kept(tuple(lights), None),
        frozenset(used),
    )


_IN_BODIES = frozenset({"site", "camera", "light"})


def _body_around(element: XmlElement) -> str | None:
    """The name of the body that an element is in; None in the world, and empty where the body has none."""
    body = next(element.iterancestors("body"), None)
    return None if body is None else body.get("name") or ""


def _is_moved(body: XmlElement | None) -> bool:
    """Whether a body has a joint."""
    return body is not None and any(each.tag in {"joint", "freejoint"} for each in body)


def _part_name(line: str) -> PartName:
    tag, _, name = line.partition(" ")
    return tag, name


def without_parts_of_sensors(model: Model, parts: frozenset[PartName]) -> Model:
    """The model without what the elements of its sensors were lowered to."""
    if not parts:
        return model

    def without(node: Node) -> Node:
        return replace_fields(node, opaque=_opaque(node.opaque, parts))

    def bare(node: AnyHolder) -> AnyHolder:
        node = replace_fields(node, sensors=tuple(each for each in node.sensors if not _is_made_of(each, parts)))
        return replace_fields(node, lights=without_lights(node.lights, parts)) if isinstance(node, Link) else node

    model = model.copy(
        links=tuple(map(bare, model.links)),
        joints=tuple(map(bare, model.joints)),
        frames=tuple(each for each in model.frames if not _is_site(each, parts)),
    )
    return without_empty(rewrite(model, Node, without))


def without_lights(lights: tuple[Light, ...], parts: frozenset[PartName]) -> tuple[Light, ...]:
    """The lights without those of elements that stand for one that comes back."""
    return tuple(each for each in lights if ("light", each.name or "") not in parts)


def without_sensors(world: World, parts: frozenset[PartName]) -> World:
    """The world without lights, sites and readings that stand for what comes back."""
    return replace_fields(
        world,
        lights=without_lights(world.lights, parts),
        frames=tuple(each for each in world.frames if not _is_site(each, parts)),
        opaque=_opaque(world.opaque, parts),
    )


def without_empty(model: Model) -> Model:
    """The model without remainders that hold nothing."""

    def without(node: Node) -> Node:
        return replace_fields(node, opaque=tuple(part for part in node.opaque if not _is_empty(part)))

    return rewrite(model, Node, without)


def _is_empty(part: Opaque) -> bool:
    return part.element is not None and part.element.name == KEPT and not part.element.children


def _is_site(frame: Frame, parts: frozenset[PartName]) -> bool:
    return ("site", frame.source.key if frame.source else frame.name) in parts


def _is_made_of(sensor: Sensor, parts: frozenset[PartName]) -> bool:
    """Whether a sensor was lowered from elements that stand for one that comes back."""
    kept = [one for part in sensor.opaque if part.element and part.element.name == KEPT for one in part.element.walk()]
    readings = {(each.name, each.get("name") or "") for each in kept}
    named = find_annotation(sensor, NAME)  # of a name that SDF cannot have
    return bool(readings & parts) or ("camera", (named.text if named else sensor.name) or "") in parts


def _opaque(parts: tuple[Opaque, ...], names: frozenset[PartName]) -> tuple[Opaque, ...]:
    return tuple(
        part.copy(element=_without(part.element, names)) if part.element and part.element.name == KEPT else part
        for part in parts
    )


def _without(element: Element, names: frozenset[PartName]) -> Element:
    left = (
        (each, _without(each, names)) for each in element.children if (each.name, each.get("name") or "") not in names
    )
    # What was empty before says something by being there, such as that a model was read of MJCF.
    kept = tuple(made for each, made in left if made.children or made.attributes or not each.children)
    return element.copy(children=kept)


def restored_settings(world: World, partial: World, root: XmlElement) -> tuple[World, World]:
    """The settings of the source, if the options of the file are as written; otherwise those of the file."""
    note = find_annotation(partial, PARTS)
    options = ((str(each.tag), {str(k): str(v) for k, v in each.items()}) for each in root.iterfind("option"))
    agrees = note is not None and digest_of(options) == note.get("digest")
    partial = without_annotation(partial, PARTS)
    if agrees:
        return world.copy(gravity=None, opaque=_without_settings(world.opaque)), partial
    return world, partial.copy(gravity=None, opaque=_without_settings(partial.opaque))


def _without_settings(parts: tuple[Opaque, ...]) -> tuple[Opaque, ...]:
    return tuple(part for part in parts if part.element is None or part.element.name not in SETTINGS)
