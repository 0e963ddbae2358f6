"""Edits of one value: a number, an enumerated value, a file name."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from testbed.edits.edit import Edit, Operation, SetAttribute, SetText, path_of
from testbed.edits.scene import Scene
from twinform.schemas import XmlElement

_NUMBER = re.compile(r"[+-]?(\d++\.?\d*+|\.\d++)([eE][+-]?\d++)?\Z")
_SIGNED = frozenset(
    {"xyz", "rpy", "pose", "origin", "axis", "lower", "upper", "offset", "multiplier", "quat_xyzw", "pos", "quat"}
    | {"range", "springref", "polycoef", "anchor", "relpose", "dir", "gravity"}
)
"""Values that may be below zero; all others are changed by a factor, so that they keep their sense."""
_SHARES = frozenset({"rgba", "ambient", "diffuse", "specular", "emissive", "transparency", "ratio"})
"""Values from 0 to 1."""
_NO_QUANTITIES = frozenset({"name", "version", "filename", "reference"})
_CARRIED_NUMBER = re.compile(r"(?<=>)-?\d+(\.\d+)?(?=<)")
"""A number in the XML that a carrier of MJCF has for its data."""
_TYPES = {
    True: ("revolute", "continuous", "prismatic", "fixed", "floating", "planar"),
    False: ("revolute", "continuous", "prismatic", "fixed", "ball", "universal", "screw"),
}
_BOOLEANS = {"true": "false", "false": "true", "1": "0", "0": "1"}
_SWITCHES = frozenset(
    {"gravity", "static", "self_collide", "kinematic", "always_on", "visualize", "cast_shadows", "selfCollide"}
    | {"turnGravityOff", "provideFeedback", "use_parent_model_frame", "enable_wind", "implicitSpringDamper"}
)
_FILES = ("package://edited/meshes/other.dae", "model://edited/meshes/other.stl", "other%20part.obj")


@dataclass(frozen=True, slots=True)
class _Spot:
    """A value in a file: the text of an element, or with a name an attribute of it."""

    element: XmlElement
    name: str
    value: str

    def set(self, value: str) -> Operation:
        at = path_of(self.element)
        return SetAttribute(at, self.name, value) if self.name else SetText(at, value)


def change_number(scene: Scene, random: Random) -> Edit | None:
    """Another number in the place of one: a component of a pose, a mass, a limit, a color."""
    return _numbered("number", scene.own, random)


def change_carried_number(scene: Scene, random: Random) -> Edit | None:
    """Another number in a carrier."""
    if not scene.is_mjcf:
        return _numbered("carrier: a number", scene.carried, random)
    spots = [(each, found) for each in scene.carried for found in _CARRIED_NUMBER.finditer(each.get("data") or "")]
    if not spots:
        return None
    text, found = random.choice(spots)
    data = f"{found.string[: found.start()]}{float(found.group()) * 2 + 1:g}{found.string[found.end() :]}"
    return Edit("carrier: a number", (SetAttribute(path_of(text), "data", data),))


def change_type(scene: Scene, random: Random) -> Edit | None:
    """A joint of another type, with all else that it has."""
    if not scene.joints:
        return None
    joint = random.choice(scene.joints)
    types = [each for each in _TYPES[scene.is_urdf] if each != joint.get("type")]
    return Edit("type of a joint", (SetAttribute(path_of(joint), "type", random.choice(types)),))


def change_switch(scene: Scene, random: Random) -> Edit | None:
    """True for false, and false for true."""
    spots = [each for each in scene.own if each.tag in _SWITCHES and (each.text or "").strip() in _BOOLEANS]
    if not spots:
        return None
    chosen = random.choice(spots)
    return Edit("switch", (SetText(path_of(chosen), _BOOLEANS[(chosen.text or "").strip()]),))


def change_file(scene: Scene, random: Random) -> Edit | None:
    """Another mesh."""
    spots = [each for each in _spots(scene.own) if _is_file(each)]
    return Edit("file of a mesh", (random.choice(spots).set(random.choice(_FILES)),)) if spots else None


def _is_file(spot: _Spot) -> bool:
    in_mesh = spot.element.getparent() is not None and spot.element.getparent().tag == "mesh"  # pyright: ignore[reportOptionalMemberAccess] - just asked
    return (spot.element.tag == "mesh" and spot.name == "filename") or (in_mesh and spot.element.tag == "uri")


def _numbered(kind: str, elements: tuple[XmlElement, ...], random: Random) -> Edit | None:
    spots = [each for each in _spots(elements) if _is_numeric(each)]
    if not spots:
        return None
    spot = random.choice(spots)
    words = spot.value.split()
    place = random.randrange(len(words))
    words[place] = _other(spot, words[place], random)
    return Edit(kind, (spot.set(" ".join(words)),))


def _spots(elements: tuple[XmlElement, ...]) -> Iterator[_Spot]:
    for element in elements:
        for name, value in element.items():
            yield _Spot(element, name, value)
        if not len(element) and element.text and element.text.strip():
            yield _Spot(element, "", element.text)


def _is_numeric(spot: _Spot) -> bool:
    words = spot.value.split()
    return bool(words) and spot.name not in _NO_QUANTITIES and all(_NUMBER.match(each) for each in words)


def _other(spot: _Spot, word: str, random: Random) -> str:
    number, called = float(word), spot.name or str(spot.element.tag)
    if called in _SHARES:
        return f"{random.choice([0, 0.25, 0.5, 0.75, 1]):g}"
    if called in _SIGNED:
        return f"{random.choice([0.0, number + 0.1, number - 0.25, -number, number + 1.5, number * 2]):.9g}"
    if float.is_integer(number) and "." not in word and "e" not in word.lower() and abs(number) < 1e6:
        return str(int(number) + random.choice([1, 2, 5]))
    return f"{(number or 1.0) * random.choice([0.5, 0.9, 1.1, 2.0]):.9g}"
