"""Why a difference to the file without its carriers does not count: what only annotations or carriers express."""

from collections.abc import Callable

from testbed.edits.edited_file import OURS, EditedFile, end, scoped_name
from twinform.compiler.compare import Difference

_BEYOND_URDF = frozenset({"axis/initial_position"})
"""What SDF has of a joint, and URDF has no element for."""
_COLORS = frozenset({"ambient", "diffuse", "script"})
"""What SDF has of a material, and URDF too."""


def reason(found: Difference, edited: EditedFile) -> str | None:
    """The first reason of the table that applies to a difference."""
    return next((why for why, applies in _REASONS.items() if applies(found, edited)), None)


def _is_without_links(found: Difference, _: EditedFile) -> bool:
    """Whether it is a frame of a model that has no links: they are in the model, and in URDF in a link that is made."""
    return found.group == "frame" and (found.b.text or "").strip("'") == "__model__"


def _is_annotated_frame(found: Difference, edited: EditedFile) -> bool:
    """Whether it is a link or joint that an annotation calls a frame or part of one, or a frame that one moves."""
    placed = found.aspect.startswith("pose")
    if found.group not in ({"frame", "link"} if placed else {"frame"}) or (
        found.b.text is not None and not found.aspect
    ):
        return False
    annotations = (f"{OURS}offset",) if placed else (f"{OURS}frame", f"{OURS}made")
    named = (each for each in edited.named.iter("link", "joint") if each.get("name") == found.name)
    return any(child.tag in annotations for each in named for child in each)


def _ends_at_annotated_link(found: Difference, edited: EditedFile) -> bool:
    """Whether it is a joint that holds, or hangs from, a frame that an annotation calls a link."""
    if found.group != "joint" or found.aspect not in {"parent", "child"}:
        return False
    return (found.b.text or "").strip("'") in {frame.get("name") for frame in edited.annotated("frame", "link")}


def _stays_a_link(found: Difference, edited: EditedFile) -> bool:
    """Whether it is a link without mass on a fixed joint, or the joint: in a file that came from SDF that is a link."""
    if found.group not in {"link", "joint"} or found.aspect or found.a.text is not None:
        return False
    holders = (joint for joint in edited.holders.values() if joint.get("type") == "fixed")
    fixed = next((each for each in holders if found.name in {each.get("name"), end(each, "child")}), None)
    if fixed is None or edited.root.find(f"{OURS}from") is None:
        return False
    links = (each for each in edited.root.iterfind("link") if each.get("name") == end(fixed, "child"))
    return all(each.find("inertial/mass") is None for each in links)


def _is_of_chain(found: Difference, edited: EditedFile) -> bool:
    """Whether it is the last joint of a chain, which has the name of a joint of SDF and only its last axis.

    Or a part of one that a planar joint of a nested model becomes, or a joint by its name in the other format, or where
    a link is that hangs from a chain.
    """
    if found.group == "kinematics":
        return _hangs_from_chain(found.name or "", edited)
    if found.group not in {"joint", "link"}:
        return False
    planar = (scoped_name(each) for each in edited.root.iter("joint") if each.get("type") == "planar")
    if any("::" in name and _flat(found.name).startswith(_flat(name)) for name in planar):
        return True
    if found.group == "link":
        return found.aspect == "joint" and _flat(found.a.text) == _flat(found.b.text)
    if any(each.get("name") == found.name for each in edited.annotated("joint", "chain")):
        return True
    if found.aspect.endswith("mimic/@joint") and (found.a.text or "").strip("'") in edited.parts:
        return True
    if found.aspect.endswith("mimic/@axis"):
        followers = (each for each in edited.root.iter("joint") if each.get("name") == found.name)
        return any(mimic.get("joint") in edited.parts for each in followers for mimic in each.iterfind("mimic"))
    # a joint of a nested model that has come apart has the name that it has outside of it
    scoped = (annotation.text or "" for annotation in edited.root.iter(f"{OURS}scoped-name"))
    apart = found.name if found.a.text is None else (found.name or "").replace("::", "_")
    return not found.aspect and any(name.replace("::", "_") == apart for name in scoped)


def _hangs_from_chain(link: str, edited: EditedFile) -> bool:
    seen: set[str] = set()
    while link in edited.holders and link not in seen:
        seen.add(link)
        joint = edited.holders[link]
        if str(joint.get("name")) in edited.parts:
            return True
        link = end(joint, "parent")
    return False


def _flat(name: str | None) -> str:
    """A name as URDF writes its scopes."""
    return (name or "").replace("::", "__")


def _is_in_loop(found: Difference, edited: EditedFile) -> bool:
    """Whether it is about joints, in a robot with loops: annotations give names, which select joints of the tree."""
    return found.group in {"joint", "kinematics", "frame"} and edited.root.find("gazebo/joint") is not None


def _is_named_otherwise(found: Difference, edited: EditedFile) -> bool:
    """Whether it is a joint whose name in the other format stands in an annotation, by its name here or by that one."""
    if found.group != "joint" or found.aspect:
        return False
    annotations = [
        annotation for joint in edited.annotated("joint", "name") for annotation in joint.iterfind(f"{OURS}name")
    ]
    if found.b.text is None:
        return any(annotation.get("instead_of") == found.name for annotation in annotations)
    return any(annotation.text in {found.name, (found.name or "").removesuffix("_joint")} for annotation in annotations)


def _moves_apart(found: Difference, edited: EditedFile) -> bool:
    """Whether it is how a robot moves, with a joint that has another name in the other format.

    Joints are identified by names. A joint of a model in the model that holds a link of another one is such.
    """
    if found.group != "kinematics":
        return False
    if edited.annotated("joint", "name"):
        return True
    names = {str(link.get("name")): scoped_name(link) for link in edited.root.iterfind("link")}
    for joint in edited.root.iterfind("joint"):
        scope, _, own = scoped_name(joint).rpartition("::")
        if scope and joint.get("type") == "planar":  # a chain in SDF
            return True
        ends = (end(joint, "parent"), end(joint, "child"))
        if own and scope and any(each != "world" and not names.get(each, "").startswith(f"{scope}::") for each in ends):
            return True
    return False


def _is_in_held(found: Difference, edited: EditedFile) -> bool:
    """Whether it is where a frame is, in a robot that a joint holds at the world that is annotated as synthesized."""
    if found.group != "frame" or not found.aspect.startswith("pose"):
        return False
    made = (joint for joint in edited.root.iterfind("joint") if joint.find(f"{OURS}made") is not None)
    return any(end(joint, "parent") == "world" for joint in made)


def _may_follow(found: Difference, edited: EditedFile) -> bool:
    """Whether it is how the robot moves, where an annotation tells that a joint follows another one."""
    mimics = edited.root.iter(f"{OURS}version")
    return found.group == "kinematics" and any(annotation.find("mimic") is not None for annotation in mimics)


def _moves_alike(found: Difference, edited: EditedFile) -> bool:
    """Whether it is to which of several links a frame is attached that are fixed to each other."""
    if found.group != "frame" or found.aspect != "attached_to":
        return False
    return edited.are_fixed(*((written.text or "").strip("'") for written in (found.a, found.b)))


def _is_empty_link(found: Difference, edited: EditedFile) -> bool:
    """Whether it is a link that has nothing but its name: URDF has to have one, so it is made."""
    if found.group != "link" or found.aspect or found.b.text is not None:
        return False
    return all(not len(each) for each in edited.plain.iter("link") if each.get("name") == found.name)


def _is_beyond_urdf(found: Difference, edited: EditedFile) -> bool:
    """Whether it is an element of SDF that URDF does not have, or a material of such elements only."""
    if edited.root.tag != "robot":
        return False
    if found.group == "link" and found.aspect.startswith("visual ") and found.aspect.endswith("/material"):
        named = (each for each in edited.annotated("visual", "sdf") if f"'{each.get('name')}'" in found.aspect)
        carried = [look for visual in named for look in visual.iterfind(f"{OURS}sdf/material")]
        return found.a.text is None and any(all(word.tag not in _COLORS for word in look) for look in carried)
    return found.group == "joint" and found.aspect in _BEYOND_URDF


_REASONS: dict[str, Callable[[Difference, EditedFile], bool]] = {
    "an empty link, which URDF has to have": _is_empty_link,
    "an annotation calls a link a frame, or places its frame": _is_annotated_frame,
    "a link without mass on a fixed joint, which SDF had as a link": _stays_a_link,
    "an annotation calls a frame a link": _ends_at_annotated_link,
    "a joint of several axes is a chain of joints in URDF": _is_of_chain,
    "a joint has another name in the other format, and moves with another sample": _moves_apart,
    "joints of a robot with loops, of which names choose the tree": _is_in_loop,
    "a carrier has a joint follow another": _may_follow,
    "a joint annotated as synthesized holds the robot at the world": _is_in_held,
    "a frame is attached to one of several links that are fixed to each other": _moves_alike,
    "a frame of a model without links": _is_without_links,
    "a joint has another name in the other format, which a link has here": _is_named_otherwise,
    "a carrier has what URDF cannot express": _is_beyond_urdf,
}
"""Differences that the file has without its carriers because URDF cannot express it, by their reason."""
