"""Edits that put something elsewhere: order, another link, a copy; and edits without a meaning: white space."""

import copy
from random import Random

from lxml import etree

from testbed.edits.edit import Edit, Insert, Move, Reindent, path_of
from testbed.edits.scene import Scene, name_of
from twinform.schemas import XmlElement

_COPIED = ("visual", "collision", "sensor", "plugin", "frame", "material", "gazebo", "light", "transmission")
_SHAPES = ("visual", "collision", "sensor", "geom", "site")


def reorder(scene: Scene, random: Random) -> Edit | None:
    """An element at another place among those beside it."""
    movable = [each for each in scene.own if _siblings(each) > 1 and _is_order_free(each)]
    if not movable:
        return None
    chosen = random.choice(movable)
    parent = chosen.getparent()
    assert parent is not None
    return Edit("order", (Move(path_of(chosen), path_of(parent), random.randrange(len(parent))),))


def move_shape(scene: Scene, random: Random) -> Edit | None:
    """A visual, collision or sensor in another link."""
    moved = [each for each in scene.parts(*_SHAPES) if _is_in_link(each)]
    if not moved or len(scene.links) < 2:
        return None
    chosen = random.choice(moved)
    targets = [each for each in scene.links if each is not chosen.getparent()]
    target = random.choice(targets)
    return Edit("shape in another link", (Move(path_of(chosen), path_of(target), len(target)),))


def duplicate(scene: Scene, random: Random) -> Edit | None:
    """A copy of a part beside it, with a name of its own."""
    found = scene.parts(*(("geom", "site", "body", "camera") if scene.is_mjcf else _COPIED))
    if not found:
        return None
    chosen = random.choice(found)
    parent = chosen.getparent()
    assert parent is not None
    made = copy.deepcopy(chosen)
    for number, each in enumerate(made.iter(etree.Element) if scene.is_mjcf else [made]):
        if name_of(each):
            each.set("name", scene.fresh(f"copied_{each.tag}") + ("" if each is made else f"_{number}"))
    made.tail = None
    xml = etree.tostring(made, encoding="unicode")
    return Edit("duplicate", (Insert(path_of(parent), parent.index(chosen) + 1, xml),))


def duplicate_carrier(scene: Scene, random: Random) -> Edit | None:
    """A carrier a second time, in its place or in another element."""
    found = [each for each in scene.carried if each.getparent() not in scene.carried]
    if not found:
        return None
    chosen = random.choice(found)
    place = chosen.getparent() if random.random() < 0.5 else random.choice((scene.root, *scene.own))
    assert place is not None
    made = copy.deepcopy(chosen)
    made.tail = None
    return Edit("carrier: a copy", (Insert(path_of(place), len(place), etree.tostring(made, encoding="unicode")),))


def say_nothing(scene: Scene, random: Random) -> Edit:
    """A comment, or other white space."""
    if random.random() < 0.3:
        return Edit("white space", (Reindent(path_of(scene.root), random.choice(["", "\t", "    "])),))
    places = [scene.root, *(each for each in scene.own if len(each))]
    place = random.choice(places)
    return Edit("comment", (Insert(path_of(place), random.randint(0, len(place)), "<!-- edited by hand -->"),))


def _siblings(element: XmlElement) -> int:
    parent = element.getparent()
    return len(parent) if parent is not None else 0


def _is_order_free(element: XmlElement) -> bool:
    """Whether the order means nothing: not so inside plugins and the like."""
    tags = {str(each.tag) for each in element.iterancestors()}
    return not tags & {"plugin", "gazebo", "ros2_control", "transmission"}


def _is_in_link(element: XmlElement) -> bool:
    parent = element.getparent()
    return parent is not None and parent.tag in {"link", "body"}
