"""Edits of names: of a link, joint, frame, material, sensor, shape or model, wherever the name is used."""

from random import Random

from testbed.edits.edit import NAMING, Edit, Rename, SetAttribute, SetText, path_of
from testbed.edits.scene import Scene, name_of

_NAMED = ("link", "joint", "frame", "material", "sensor", "visual", "collision", "model", "robot", "plugin", "light")
_ENDS = ("parent", "child")


def rename_everywhere(scene: Scene, random: Random) -> Edit | None:
    """Search and replace of a name in the whole file."""
    return _renamed("name", scene, random, carriers=True)


def rename_outside_carriers(scene: Scene, random: Random) -> Edit | None:
    """The same, but not in our namespace."""
    return _renamed("name, not in carriers", scene, random, carriers=False)


def _renamed(kind: str, scene: Scene, random: Random, *, carriers: bool) -> Edit | None:
    tags = sorted({str(each.tag) for each in (scene.root, *scene.own) if each.tag in _NAMED and name_of(each)})
    if not tags:
        return None
    tag = random.choice(tags)
    chosen = random.choice([each for each in (scene.root, *scene.own) if each.tag == tag and name_of(each)])
    old = name_of(chosen)
    return Edit(kind, (Rename(path_of(scene.root), old, scene.fresh(f"edited_{tag}"), carriers),))


def point_elsewhere(scene: Scene, random: Random) -> Edit | None:
    """A reference to another link: of a pose, a frame, or a `<gazebo>`."""
    names = [name_of(each) for each in (*scene.links, *scene.parts("frame"))]
    wanted = NAMING - {"name", "link", "joint", "canonical_link"}
    spots = [(each, key) for each in scene.own for key, value in each.items() if key in wanted and value in names]
    if not spots or len(names) < 2:
        return None
    element, key = random.choice(spots)
    others = [name for name in names if name != element.get(key)]
    return Edit("reference", (SetAttribute(path_of(element), key, random.choice(others)),)) if others else None


def hang_elsewhere(scene: Scene, random: Random) -> Edit | None:
    """A link with its joint on another parent."""
    names = [name_of(each) for each in scene.links]
    if not scene.joints or len(names) < 3:
        return None
    joint = random.choice(scene.joints)
    parent = joint.find(_ENDS[0])
    child = joint.find(_ENDS[1])
    if parent is None or child is None:
        return None
    now = {parent.get("link") or parent.text, child.get("link") or child.text}
    others = [name for name in names if name not in now]
    if not others:
        return None
    at, new = path_of(parent), random.choice(others)
    return Edit("parent of a joint", (SetAttribute(at, "link", new) if scene.is_urdf else SetText(at, new),))
