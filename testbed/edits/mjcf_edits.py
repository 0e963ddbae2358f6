"""Edits that only MJCF has: bodies are moved with all that is in them, and what a joint has are attributes."""

from random import Random

from testbed.edits.edit import Delete, Edit, Insert, Move, Operation, Rename, SetAttribute, path_of
from testbed.edits.new_parts import MJCF_JOINT_PARTS, MJCF_PARTS, MJCF_SECTIONS, mjcf_body
from testbed.edits.scene import Scene, name_of
from twinform.schemas import XmlElement

_TYPES = ("hinge", "slide", "ball")


def add_part(scene: Scene, random: Random) -> Edit | None:
    """A geom or site in a body, or in the world."""
    places = [*scene.links, *scene.root.iterfind("worldbody")]
    if not places:
        return None
    kind = random.choice(sorted(MJCF_PARTS))
    made = MJCF_PARTS[kind](scene.fresh(f"added_{kind}"), random)
    return Edit("add a part", (_last_in(random.choice(places), made),))


def add_body(scene: Scene, random: Random) -> Edit | None:
    """A body with a mass, a shape, and a joint or none."""
    places = [*scene.links, *scene.root.iterfind("worldbody")]
    if not places:
        return None
    made = mjcf_body(scene.fresh("added_link"), random)
    return Edit("add a link", (_last_in(random.choice(places), made),))


def add_to_joint(scene: Scene, random: Random) -> Edit | None:
    """Give a joint damping, a range or the like."""
    if not scene.joints:
        return None
    joint, given = random.choice(scene.joints), random.choice(MJCF_JOINT_PARTS)
    at = path_of(joint)
    return Edit("add to a joint", tuple(SetAttribute(at, name, value) for name, value in given.items()))


def add_relation(scene: Scene, random: Random) -> Edit | None:
    """What acts on a joint or body or measures it: an actuator, a sensor, an equality, an exclusion."""
    section, make = random.choice(MJCF_SECTIONS)
    joints = [name_of(each) for each in scene.joints if each.get("type", "hinge") in {"hinge", "slide"}]
    bodies = [name_of(each) for each in scene.links]
    wanted = joints if "joint" in make else bodies
    named = [each for each in wanted if each]
    if len(named) < 2:
        return None
    one, other = random.sample(named, 2)
    made = make.format(name=scene.fresh("added"), one=one, other=other)
    found = scene.root.find(section)
    if found is not None:
        return Edit("add a relation", (_last_in(found, made),))
    return Edit("add a relation", (_last_in(scene.root, f"<{section}>{made}</{section}>"),))


def change_type(scene: Scene, random: Random) -> Edit | None:
    """A joint of another type, with all else that it has."""
    if not scene.joints:
        return None
    joint = random.choice(scene.joints)
    types = [each for each in _TYPES if each != joint.get("type", "hinge")]
    return Edit("type of a joint", (SetAttribute(path_of(joint), "type", random.choice(types)),))


def hang_elsewhere(scene: Scene, random: Random) -> Edit | None:
    """A body, with all that is in it, in another body."""
    if len(scene.links) < 3:
        return None
    moved = random.choice(scene.links)
    inside = set(moved.iter("body"))
    places = [each for each in scene.links if each not in inside and each is not moved.getparent()]
    if not places or moved.find("freejoint") is not None:
        return None
    place = random.choice(places)
    return Edit("parent of a joint", (Move(path_of(moved), path_of(place), len(place)),))


def delete_limit(scene: Scene, random: Random) -> Edit | None:
    """The range of a joint."""
    limited = [each for each in scene.joints if each.get("range")]
    if not limited:
        return None
    at = path_of(random.choice(limited))
    return Edit("delete a limit", (SetAttribute(at, "range", None), SetAttribute(at, "limited", None)))


def delete_link(scene: Scene, random: Random) -> Edit | None:
    """A body that no other one is in, with what names it or what is in it."""
    leaves = [each for each in scene.links if each.find("body") is None]
    if not leaves or len(scene.links) < 2:
        return None
    leaf = random.choice(leaves)
    names = {name_of(each) for each in leaf.iter("*")} - {""}
    sections = (each for each in scene.root if each.tag not in {"worldbody", "custom", "asset"})
    naming = [each for section in sections for each in section for value in each.attrib.values() if value in names]
    gone = dict.fromkeys([leaf, *naming])
    return Edit("delete a link", tuple(Delete(path_of(each)) for each in gone))


def rename_part(scene: Scene, random: Random) -> Edit | None:
    """A body, joint, geom, site or the like under another name, wherever the name is used."""
    named = [each for each in scene.own if each.get("name") and each.tag not in {"text", "numeric"}]
    tags = sorted({str(each.tag) for each in named})
    if not tags:
        return None
    tag = random.choice(tags)
    old = name_of(random.choice([each for each in named if each.tag == tag]))
    carriers = random.random() < 0.6
    kind = "name" if carriers else "name, not in carriers"
    return Edit(kind, (Rename(path_of(scene.root), old, scene.fresh(f"edited_{tag}"), carriers),))


def _last_in(place: XmlElement, xml: str) -> Operation:
    return Insert(path_of(place), len(place), xml)
