"""Where elements of MJCF refer to others by name, and of which kind those are."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from twinform.schemas import XmlElement
from twinform.schemas.facts import named_kinds

KINDS = {
    "body": "body",
    "joint": "joint",
    "freejoint": "joint",
    "geom": "geom",
    "site": "site",
    "camera": "camera",
    "light": "light",
    "flexcomp": "flex",
}
"""The kinds of the named elements in bodies."""
ASSET_KINDS = {name: name for name in ("mesh", "material", "texture", "hfield", "skin", "model")}
"""The kinds of assets."""
SECTION_KINDS = {
    "equality": "equality",
    "tendon": "tendon",
    "actuator": "actuator",
    "sensor": "sensor",
    "keyframe": "key",
}
"""The kinds of what stands in a section, whatever the elements are called."""
_OTHER_KINDS = {
    ("contact", "pair"): "pair",
    ("contact", "exclude"): "exclude",
    ("custom", "numeric"): "numeric",
    ("custom", "text"): "text",
    ("custom", "tuple"): "tuple",
    ("deformable", "flex"): "flex",
    ("deformable", "skin"): "skin",
}
_NO_PARTS = frozenset({"default", "frame", "instance", "model"})
"""What attributes name and nothing in a canonical tree is: it is gone there, or is looked up elsewhere."""
_OF_OBJECT = {"objname": "objtype", "refname": "reftype"}
"""The attributes whose kind another attribute says."""
_OBJECTS = {"xbody": "body", "key": "key"}
SCALAR_JOINTS = frozenset({"hinge", "slide"})
"""The types of joints that have one coordinate."""
_TAKEN_JOINTS: Mapping[str, frozenset[str]] = {
    "joint": SCALAR_JOINTS,  # in an equality or a tendon
    "jointpos": SCALAR_JOINTS,
    "jointvel": SCALAR_JOINTS,
    "ballquat": frozenset({"ball"}),
    "ballangvel": frozenset({"ball"}),
}
"""The types of joints that an element may name, if it may not name all."""
_COORDINATES: Mapping[str, Mapping[str, int]] = {"qpos": {"free": 7, "ball": 4}, "qvel": {"free": 6, "ball": 3}}
"""How many coordinates the position and the velocity of a joint have, if that is more than one."""
WITH_COORDINATES = frozenset({"flexcomp", "flex", "plugin"})
"""Elements that have coordinates of their own."""
OF_LIMITS = {
    "jointlimitpos": "joint", "jointlimitvel": "joint", "jointlimitfrc": "joint",
    "tendonlimitpos": "tendon", "tendonlimitvel": "tendon", "tendonlimitfrc": "tendon",
}  # fmt: skip
"""The sensors that measure limits, and the kind of what has these."""


class Reference(NamedTuple):
    """An attribute that names another element."""

    element: XmlElement
    attribute: str
    kind: str
    name: str


def kind_of(element: XmlElement, section: str) -> str | None:
    """Return the kind of thing that an element of a section is, if it is one that can be referred to."""
    return kind_of_tag(str(element.tag), section)


def kind_of_tag(tag: str, section: str) -> str | None:
    """Return the kind of thing that elements of this name are in a section."""
    if section == "worldbody":
        return KINDS.get(tag)
    if section == "asset":
        return ASSET_KINDS.get(tag)
    return SECTION_KINDS.get(section) or _OTHER_KINDS.get((section, tag))


def kind_of_object(said: str) -> str:
    """Return the kind that a type of object means."""
    return _OBJECTS.get(said, said)


def references_in(element: XmlElement, kinds: Iterable[str] | None = None) -> Iterator[Reference]:
    """Yield the references of an element and of those in it, of some kinds alone where these are given."""
    wanted = None if kinds is None else set(kinds)
    for each in element.iter("*"):
        for reference in own_references(each):
            if wanted is None or reference.kind in wanted:
                yield reference


def own_references(element: XmlElement) -> Iterator[Reference]:
    """Yield the references of one element."""
    attributes = {str(key): str(value) for key, value in element.items()}
    for key, kind in naming_attributes(str(element.tag), attributes):
        yield Reference(element, key, kind, attributes[key])


def naming_attributes(tag: str, attributes: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Yield the attributes of an element that name another one, each with the kind of that."""
    kinds = named_kinds("mjcf")
    for name, value in attributes.items():
        kind = kinds.get(name)
        if name in _OF_OBJECT:
            kind = kind_of_object(attributes.get(_OF_OBJECT[name], ""))
        if kind and kind not in _NO_PARTS and value and not _is_list(tag, name):
            yield name, kind


def _is_list(tag: str, name: str) -> bool:
    """Whether an attribute that is called as a reference is a list of names."""
    return tag == "flex" and name in {"body", "node"}


def most_coordinates(joints: Iterable[str]) -> dict[str, int]:
    """Return how many numbers a keyframe may have for joints of these types, by its attributes."""
    found = tuple(joints)
    return {name: sum(counts.get(each, 1) for each in found) for name, counts in _COORDINATES.items()}


def takes(tag: str, joint: str) -> bool:
    """Whether an element may name a joint of a type."""
    return joint in _TAKEN_JOINTS.get(tag, {joint})


def names_in(elements: Iterable[XmlElement]) -> dict[str, set[str]]:
    """Return the names in a kinematic tree, by their kinds."""
    found: dict[str, set[str]] = {}
    for element in elements:
        for each in element.iter("*"):
            kind, name = KINDS.get(str(each.tag)), each.get("name")
            if kind and name:
                found.setdefault(kind, set()).add(name)
    return found


def rename(element: XmlElement, names: Mapping[str, Iterable[str]], change: Callable[[str], str]) -> None:
    """Change the names that an element and those in it refer to, where they are among some names."""
    for reference in list(references_in(element)):
        if reference.name in names.get(reference.kind, ()):
            reference.element.set(reference.attribute, change(reference.name))
