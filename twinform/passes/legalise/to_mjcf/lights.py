"""Lights of MJCF: those of links, and those of the world, with their colors, attenuation and the cone of a spot."""

import math

from twinform.ir import Color, Element, Light, World
from twinform.ir.frames import WORLD
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.carriers.old_names import source_name
from twinform.passes.legalise.to_mjcf.elements import Attributes, Value, make_element, position
from twinform.passes.legalise.to_mjcf.kept_mjcf import with_kept
from twinform.passes.legalise.to_mjcf.said_parts import (
    child_number,
    child_text,
    untyped,
    without_elements,
)
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

_TYPES = frozenset({"point", "directional", "spot"})
_DOWN: Vector3 = (0.0, 0.0, -1.0)
_OPAQUE: Color = (1.0, 1.0, 1.0, 1.0)
_WHITE, _FAINT = (1.0, 1.0, 1.0), (0.1, 0.1, 0.1)
"""The colors of a light of SDF that has none written."""
_FADING = (("constant", 1.0), ("linear", 1.0), ("quadratic", 0.0))


def body_lights(context: MjcfContext, body: Body) -> list[Element]:
    """The lights of a link."""
    return [_light(context, light, context.resolve(light.pose, body), body.link.name) for light in body.link.lights]


def world_lights(context: MjcfContext) -> list[Element]:
    """The lights of a world, or those beside the models of a document."""
    holder, frames = context.holder, context.tree.frames
    if not isinstance(holder, World):
        return [_light(context, light, Transform.from_pose(light.pose)) for light in context.document.lights]
    return [
        _light(context, light, frames.resolve(light.pose, WORLD, WORLD, kind="world", base="world"))
        for light in holder.lights
    ]


def _light(context: MjcfContext, light: Light, place: Transform, link: str | None = None) -> Element:
    name = context.name("light", source_name(light), light.location)
    context.note_made_name("light", light, name, f"{link}_light" if link else "light")
    return with_kept(make_element("light", [("name", name), *light_attributes(light, place)], (), light.source), light)


def light_attributes(light: Light, place: Transform) -> Attributes:
    """The attributes of a light at a place in its body."""
    kind = _kind(light)
    on, spot = untyped(light, "light_on"), untyped(light, "spot") if kind == "spot" else None
    found: list[tuple[str, Value]] = [
        ("type", kind),
        ("pos", position(place) if any(place.translation) else None),
        ("dir", _direction(light, place)),
        ("castshadow", bool(light.cast_shadows)),
        ("active", False if on is not None and on.text in {"false", "0"} else None),
        ("diffuse", (light.diffuse or _WHITE)[:3]),
        ("specular", (light.specular or _FAINT)[:3]),
        *_attenuation(untyped(light, "attenuation"), kind),
    ]
    if spot is not None:
        found += [("cutoff", _cutoff(spot)), ("exponent", _exponent(spot))]
    return found


def unread_light(light: Light) -> Light | None:
    """A light that is not read again of the element which stands for it; None for one that is."""
    is_turned = light.pose is not None and not Transform.from_pose(light.pose).is_unturned
    colors = (light.diffuse or _OPAQUE, light.specular or _OPAQUE)
    is_bright = any(each[3:] != _OPAQUE[3:] or not all(0 <= part <= 1 for part in each) for each in colors)
    shines_nowhere = light.direction is not None and not any(light.direction)  # in MJCF it shines down
    if light.type not in _TYPES or is_turned or is_bright or shines_nowhere:
        return light
    is_cone = light.type == "spot" and _is_sharp(untyped(light, "spot"))
    left = without_elements(light, {"light_on", "spot"} if is_cone else {"light_on"})
    if any(not is_ours(part) for part in left.opaque):
        return light
    fields = dict.fromkeys(("type", "pose", "cast_shadows", "diffuse", "specular", "direction"))
    return None if left.copy(**fields, opaque=()) == Light.unchecked(name=light.name) else light


def _is_sharp(spot: Element | None) -> bool:
    """Whether a cone of light has no softer edge, as those that are read."""
    if spot is None:
        return False
    inner, outer, fall = (child_number(spot, name, default=0.0) for name in ("inner_angle", "outer_angle", "falloff"))
    return inner == outer and outer > 0 and not fall


def _kind(light: Light) -> str:
    return light.type if light.type in _TYPES else "point"


def _direction(light: Light, place: Transform) -> Vector3 | None:
    """Where a light shines in its body; None for down, which MJCF has as its default."""
    written = light.direction if light.direction and any(light.direction) else _DOWN
    direction = rounded(place.rotate(written))
    return None if direction == _DOWN else direction


def _attenuation(written: Element | None, kind: str) -> Attributes:
    """How a light fades: constant, linear and quadratic part, and how far it shines; a directional one does not fade.

    Where SDF writes one part alone, the others have its defaults, which are not those of MJCF.
    """
    if written is None or kind == "directional":
        return []
    parts = tuple(child_number(written, each, default=usual) for each, usual in _FADING)
    reach = child_text(written, "range")
    return [("range", None if reach is None else float(reach)), ("attenuation", parts)]


def _cutoff(spot: Element) -> float | None:
    """The angle between the axis and the edge of the cone in degrees: SDF has the whole angle of the cone."""
    outer = child_number(spot, "outer_angle", default=0.0)
    return math.degrees(outer) / 2 if outer > 0 else None


def _exponent(spot: Element) -> float | None:
    """How fast a spot fades from its axis to its edge, where that is written."""
    return child_number(spot, "falloff", default=0.0) or None
