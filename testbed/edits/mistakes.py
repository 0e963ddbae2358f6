"""Edits that make a file wrong: what has to be an error."""

from random import Random

from testbed.edits.edit import Delete, Edit, Insert, Operation, SetAttribute, SetText, path_of
from testbed.edits.scene import Scene, ends, name_of

KIND = "mistake"
"""What all of them are called in reports."""


def make_a_mistake(scene: Scene, random: Random) -> Edit | None:
    """One of the mistakes that people make."""
    made = random.choice(_MISTAKES_OF_MJCF if scene.is_mjcf else _MISTAKES)(scene, random)
    return Edit(KIND, made) if made else None


def _word_for_number(scene: Scene, random: Random) -> tuple[Operation, ...]:
    masses = [each for each in scene.parts("mass") if each.getparent().tag == "inertial"]  # pyright: ignore[reportOptionalMemberAccess] - the root is no mass
    if not masses:
        return ()
    at = path_of(random.choice(masses))
    return (SetAttribute(at, "value", "heavy") if scene.is_urdf else SetText(at, "heavy"),)


def _unknown_end(scene: Scene, random: Random) -> tuple[Operation, ...]:
    found = [end for joint in scene.joints for end in joint.iterchildren("parent", "child")]
    if not found:
        return ()
    at, name = path_of(random.choice(found)), scene.fresh("nowhere")
    return (SetAttribute(at, "link", name) if scene.is_urdf else SetText(at, name),)


def _no_child(scene: Scene, random: Random) -> tuple[Operation, ...]:
    found = [child for joint in scene.joints for child in joint.iterchildren("child")]
    return (Delete(path_of(random.choice(found))),) if found else ()


def _link_twice(scene: Scene, random: Random) -> tuple[Operation, ...]:
    if not scene.links:
        return ()
    link = random.choice(scene.links)
    holder = link.getparent()
    assert holder is not None
    return (Insert(path_of(holder), len(holder), f'<link name="{name_of(link)}"/>'),)


def _link_without_declaration(scene: Scene, random: Random) -> tuple[Operation, ...]:
    """A link renamed where it stands, and not where it is used."""
    used = {name for joint in scene.joints for name in ends(joint)} - {"world"}
    found = [each for each in scene.links if name_of(each) in used]
    return (SetAttribute(path_of(random.choice(found)), "name", scene.fresh("renamed")),) if found else ()


def _two_parents(scene: Scene, random: Random) -> tuple[Operation, ...]:
    """In URDF, a link on two joints."""
    if not scene.is_urdf or len(scene.joints) < 2:
        return ()
    one, other = random.sample(list(scene.joints), 2)
    child = other.find("child")
    if child is None or not ends(one)[1]:
        return ()
    return (SetAttribute(path_of(child), "link", ends(one)[1]),)


_MISTAKES = (_word_for_number, _unknown_end, _no_child, _link_twice, _link_without_declaration, _two_parents)


def _word_in_mjcf(scene: Scene, random: Random) -> tuple[Operation, ...]:
    masses = scene.parts("inertial")
    return (SetAttribute(path_of(random.choice(masses)), "mass", "heavy"),) if masses else ()


def _unknown_name_in_mjcf(scene: Scene, random: Random) -> tuple[Operation, ...]:
    """A reference to a joint or body that is not there."""
    naming = ("joint", "joint1", "body1", "body2")
    found = [(each, name) for each in scene.own for name in naming if each.get(name)]
    if not found:
        return ()
    element, name = random.choice(found)
    return (SetAttribute(path_of(element), name, scene.fresh("nowhere")),)


def _name_twice_in_mjcf(scene: Scene, random: Random) -> tuple[Operation, ...]:
    among = random.choice([scene.links, scene.joints])
    named = [each for each in among if name_of(each)]
    if len(named) < 2:
        return ()
    one, other = random.sample(named, 2)
    return (SetAttribute(path_of(one), "name", name_of(other)),)


_MISTAKES_OF_MJCF = (_word_in_mjcf, _unknown_name_in_mjcf, _name_twice_in_mjcf)
