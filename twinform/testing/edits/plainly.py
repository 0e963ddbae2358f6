"""What an edited file says to those who do not know our carriers, and which differences to it count.

Carriers add to what a reader sees: then the file and its result differ before any edit, and after an edit in the same
way. What counts is a difference of another kind, or of the same kind with another value: there a carrier overrules what
was written.
"""

import re
from collections.abc import Callable
from enum import Enum

from lxml import etree

from twinform.compiler.compare import Difference
from twinform.passes.legalise.carrier import NAMESPACE
from twinform.passes.legalise.provenance import may_write_scopes
from twinform.schemas import XmlElement


class Plainly(Enum):
    """Which differences to the file without carriers count.

    `ALL`; `ADDITIONS_TOO`, also what only the result has, as where something was deleted; `SKELETON`, masses, joints
    and places alone, since a pass may bring carriers of its own; `NONE`: who edits a carrier wants it to count.
    """

    ALL = "all"
    ADDITIONS_TOO = "additions too"
    SKELETON = "skeleton"
    NONE = "none"


_OURS = f"{{{NAMESPACE}}}"
_NAME = re.compile(r"'[^']*'")
_UNIT = re.compile(r"(?<=[0-9]) [A-Za-z][A-Za-z0-9*/^]*$")
_SKELETON = {"link": ("inertial",), "joint": ("parent", "child", "type", "pose", "axis/xyz"), "kinematics": ("",)}


def without_carriers(text: bytes) -> bytes:
    """A file without anything in our namespace: what those read who do not know it, but for names that were changed."""
    root = etree.fromstring(text)
    _give_names_back(root)
    for element in list(root.iter(etree.Element)):
        if str(element.tag).startswith(_OURS):
            _take_out(element)
        for name in [str(key) for key in element.keys() if str(key).startswith(_OURS)]:  # noqa: SIM118 - an element
            del element.attrib[name]
    etree.cleanup_namespaces(root)
    return etree.tostring(root)


def plain_key(found: Difference) -> tuple[str | None, ...]:
    """What differs and how, in whatever part: carriers go with their parts, into other links and under other names."""
    aspect = _NAME.sub("", found.aspect)
    if found.group == "kinematics":
        return found.group, aspect
    return found.group, aspect, *(_value(said.text or "") for said in (found.a, found.b))


def _value(text: str) -> str:
    """What was said, without names and without the unit, which changes with the type of a joint."""
    return _UNIT.sub("", _NAME.sub("", text))


def explained(found: Difference, plainly: Plainly, edited: bytes) -> str | None:
    """Why a difference to the file without carriers does not count; None where it does."""
    if plainly is Plainly.NONE:
        return "a carrier itself was edited, which is to count"
    reason = next((reason for reason, applies in _EXPLAINED.items() if applies(found, edited)), None)
    if reason:
        return reason
    if plainly is Plainly.SKELETON:
        in_skeleton = found.aspect and found.aspect.startswith(_SKELETON.get(found.group, ()))
        return None if in_skeleton else "a pass may bring carriers: masses, joints and places count alone"
    if plainly is Plainly.ADDITIONS_TOO and found.group != "frame":
        return None
    return "only the result has it: carriers add to what the file says" if found.a.text is None else None


def _is_without_links(found: Difference, _: bytes) -> bool:
    """Whether it is a frame of a model that has no links: they are in the model, and in URDF in a link that is made."""
    return found.group == "frame" and (found.b.text or "").strip("'") == "__model__"


def _is_marked_frame(found: Difference, edited: bytes) -> bool:
    """Whether it is a link or a joint that a mark calls a frame, or made for one, or a frame that a mark moves."""
    if found.group != "frame" or (found.b.text is not None and not found.aspect):
        return False
    root = etree.fromstring(edited)
    _give_names_back(root)
    marks = (f"{_OURS}offset",) if found.aspect.startswith("pose") else (f"{_OURS}frame", f"{_OURS}made")
    named = (each for each in root.iter("link", "joint") if each.get("name") == found.name)
    return any(child.tag in marks for each in named for child in each)


def _is_of_chain(found: Difference, edited: bytes) -> bool:
    """Whether it is the last joint of a chain, which has the name of a joint of SDF and only its last axis.

    Or a part of one that a planar joint of a nested model becomes, or a joint by its name in the other format.
    """
    if found.group not in {"joint", "link"}:
        return False
    root = etree.fromstring(edited)
    planar = (_scoped_name(each) for each in root.iter("joint") if each.get("type") == "planar")
    if any("::" in name and _flat(found.name).startswith(_flat(name)) for name in planar):
        return True
    if found.group == "link":
        return found.aspect == "joint" and _flat(found.a.text) == _flat(found.b.text)
    if any(each.get("name") == found.name for each in root.iter("joint") if each.find(f"{_OURS}chain") is not None):
        return True
    # a joint of a nested model that has come apart has the name that it has outside of it
    scoped = (mark.text or "" for mark in root.iter(f"{_OURS}scoped-name"))
    apart = found.name if found.a.text is None else (found.name or "").replace("::", "_")
    return not found.aspect and any(name.replace("::", "_") == apart for name in scoped)


def _flat(name: str | None) -> str:
    """A name as URDF writes its scopes."""
    return (name or "").replace("::", "__")


def _is_in_loop(found: Difference, edited: bytes) -> bool:
    """Whether it is about joints, in a robot with loops: marks give names, and these choose the joints of the tree."""
    return found.group in {"joint", "kinematics", "frame"} and etree.fromstring(edited).find("gazebo/joint") is not None


def _is_named_otherwise(found: Difference, edited: bytes) -> bool:
    """Whether it is a joint whose name in URDF stands in a mark."""
    if found.group != "joint" or found.b.text is not None:
        return False
    named = (each for each in etree.fromstring(edited).iter("joint") if each.get("name") == found.name)
    return any(mark.get("instead_of") == found.name for joint in named for mark in joint.iter(f"{_OURS}name"))


def _moves_apart(found: Difference, edited: bytes) -> bool:
    """Whether it is how a robot moves, with a joint that has another name in the other format.

    Which joint is which is told by names. A joint of a model in the model that holds a link of another one is such.
    """
    if found.group != "kinematics":
        return False
    root = etree.fromstring(edited)
    if any(joint.find(f"{_OURS}name") is not None for joint in root.iter("joint")):
        return True
    names = {str(link.get("name")): _scoped_name(link) for link in root.iterfind("link")}
    for joint in root.iterfind("joint"):
        scope, _, own = _scoped_name(joint).rpartition("::")
        if scope and joint.get("type") == "planar":  # a chain in SDF
            return True
        ends = (_end(joint, "parent"), _end(joint, "child"))
        if own and scope and any(end != "world" and not names.get(end, "").startswith(f"{scope}::") for end in ends):
            return True
    return False


def _is_in_held(found: Difference, edited: bytes) -> bool:
    """Whether it is where a frame is, in a robot that a joint holds at the world which a mark calls made."""
    if found.group != "frame" or not found.aspect.startswith("pose"):
        return False
    joints = etree.fromstring(edited).iterfind("joint")
    made = (each for each in joints if each.find(f"{_OURS}made") is not None)
    return any(parent.get("link") == "world" for each in made for parent in each.iterfind("parent"))


def _may_follow(found: Difference, edited: bytes) -> bool:
    """Whether it is how the robot moves, where a mark says that a joint follows another one."""
    mimics = etree.fromstring(edited).iter(f"{_OURS}version")
    return found.group == "kinematics" and any(mark.find("mimic") is not None for mark in mimics)


def _is_empty_link(found: Difference, edited: bytes) -> bool:
    """Whether it is a link that says nothing but its name: URDF has to have one, so it is made."""
    if found.group != "link" or found.aspect or found.b.text is not None:
        return False
    links = [each for each in etree.fromstring(without_carriers(edited)).iter("link") if each.get("name") == found.name]
    return all(not len(each) for each in links)


_EXPLAINED: dict[str, Callable[[Difference, bytes], bool]] = {
    "a link that says nothing, which URDF has to have": _is_empty_link,
    "a mark calls a link a frame, or says where its frame is": _is_marked_frame,
    "a joint of several axes is a chain of joints in URDF": _is_of_chain,
    "a joint has another name in the other format, and moves with another sample": _moves_apart,
    "joints of a robot with loops, of which names choose the tree": _is_in_loop,
    "a carrier says that a joint follows another": _may_follow,
    "a joint that a mark calls made holds the robot at the world": _is_in_held,
    "a frame of a model without links": _is_without_links,
    "a joint has another name in URDF, which a link of SDF has": _is_named_otherwise,
}
"""Differences that the file has without its carriers because URDF cannot say it, by their reason."""


def _give_names_back(root: XmlElement) -> None:
    """Call what is marked by its old name, everywhere: a name that had to change is no other part."""
    names: dict[str, str] = {}
    nested = {_scoped_name(frame) for mark in root.iter(f"{_OURS}nested") if _is_frame(frame := mark.getparent(), root)}
    free = any(may_write_scopes(str(mark.get("version"))) for mark in root.iter(f"{_OURS}from"))
    for mark in root.iter(f"{_OURS}scoped-name"):
        holder = mark.getparent()
        if holder is not None and holder.get("name") == mark.get("instead_of") and mark.text:
            if not free and (mark.text.rpartition("::")[0] or mark.text) not in nested:
                continue  # of what it was in nothing tells any more
            names[str(mark.get("instead_of"))] = mark.text
    if not names:
        return
    for element in root.iter(etree.Element):
        if (element.text or "").strip() in names:
            element.text = names[(element.text or "").strip()]
        for key, value in element.items():
            element.set(key, names.get(str(value), str(value)))


def _scoped_name(holder: XmlElement | None) -> str:
    """What a link is called in SDF."""
    if holder is None:
        return ""
    name = holder.get("name") or ""
    mark = holder.find(f"{_OURS}scoped-name")
    return (mark.text or name) if mark is not None and mark.get("instead_of") == name else name


def _is_frame(link: XmlElement | None, root: XmlElement) -> bool:
    """Whether a link that stands for the frame of a model is still nothing else: fixed, and without a body."""
    if link is None or link.find(f"{_OURS}frame") is None or link.find("inertial/mass") is not None:
        return False
    held_by = (joint for joint in root.iterfind("joint") if _end(joint, "child") == link.get("name"))
    return all(joint.get("type") == "fixed" for joint in held_by)


def _end(joint: XmlElement, tag: str) -> str:
    found = joint.find(tag)
    return (found.get("link") or "") if found is not None else ""


def _take_out(element: XmlElement) -> None:
    parent = element.getparent()
    if parent is not None:
        parent.remove(element)
