"""Edits that take something out: a value, a part, a leaf link with its joint, a carrier."""

from random import Random

from lxml import etree

from testbed.edits.edit import Delete, Edit, SetAttribute, path_of
from testbed.edits.scene import MORE_PARTS, PARTS, PARTS_OF_MJCF, Scene, ends, name_of
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.schemas import XmlElement


def delete_part(scene: Scene, random: Random) -> Edit | None:
    """A visual, sensor, `<gazebo>`, plugin, frame or the like."""
    wanted = PARTS_OF_MJCF if scene.is_mjcf else (*PARTS, *MORE_PARTS)
    tags = sorted({str(each.tag) for each in scene.parts(*wanted)})
    if not tags:
        return None
    return _deleted("delete a part", scene.parts(random.choice(tags)), random)


def delete_value(scene: Scene, random: Random) -> Edit | None:
    """An element that holds nothing but a value."""
    return _deleted("delete a value", [each for each in scene.own if not len(each)], random)


def delete_attribute(scene: Scene, random: Random) -> Edit | None:
    """An attribute, in the hope that there is a default."""
    spots = [(each, name) for each in scene.own for name in each.keys() if name != "version"]  # noqa: SIM118 - an element
    if not spots:
        return None
    element, name = random.choice(spots)
    return Edit("delete an attribute", (SetAttribute(path_of(element), name, None),))


def delete_limit(scene: Scene, random: Random) -> Edit | None:
    """The limits of a joint."""
    return _deleted("delete a limit", scene.parts("limit"), random)


def delete_link(scene: Scene, random: Random) -> Edit | None:
    """A link that nothing hangs from, with its joint and, in URDF, its `<gazebo>` elements."""
    bases = {ends(each)[0] for each in scene.joints}
    leaves = [each for each in scene.links if name_of(each) not in bases]
    if not leaves or len(scene.links) < 2:
        return None
    link = random.choice(leaves)
    joints = [each for each in scene.joints if ends(each)[1] == name_of(link)]
    named = {name_of(link), *map(name_of, joints)}
    blocks = [each for each in scene.parts("gazebo") if each.get("reference") in named]
    return Edit("delete a link", tuple(Delete(path_of(each)) for each in (link, *joints, *blocks)))


def delete_carrier(scene: Scene, random: Random) -> Edit | None:
    """A carrier."""
    return _deleted("carrier: delete one", _carriers(scene), random)


def delete_carriers(scene: Scene, random: Random) -> Edit | None:
    """All carriers, or those in one element."""
    found = _carriers(scene)
    if not found:
        return None
    place = random.choice(found).getparent()
    chosen = found if random.random() < 0.5 else [each for each in found if each.getparent() is place]
    annotations = [each for each in scene.root.iter(etree.Element) if _our_attributes(each)] if chosen is found else []
    cleared = tuple(SetAttribute(path_of(each), name, None) for each in annotations for name in _our_attributes(each))
    return Edit("carrier: delete all", (*cleared, *(Delete(path_of(each)) for each in chosen)))


def delete_our_attribute(scene: Scene, random: Random) -> Edit | None:
    """An attribute of our namespace, or one of a carrier."""
    spots = [(each, name) for each in scene.root.iter(etree.Element) for name in _our_attributes(each)]
    spots += [(each, name) for each in scene.carried for name in each.keys()]  # noqa: SIM118 - an element
    if not spots:
        return None
    element, name = random.choice(spots)
    return Edit("carrier: delete an attribute", (SetAttribute(path_of(element), name, None),))


def _our_attributes(element: XmlElement) -> list[str]:
    return [str(name) for name in element.keys() if str(name).startswith(f"{{{NAMESPACE}}}")]  # noqa: SIM118 - an element


def _carriers(scene: Scene) -> list[XmlElement]:
    return [each for each in scene.carried if scene.is_mjcf or str(each.tag).startswith(f"{{{NAMESPACE}}}")]


def _deleted(kind: str, among: list[XmlElement], random: Random) -> Edit | None:
    return Edit(kind, (Delete(path_of(random.choice(among))),)) if among else None
