"""What an edited file says to those who do not know our carriers, and which differences to it count.

Carriers add to what a reader sees: then the file and its result differ before any edit, and after an edit in the same
way. What counts is a difference of another kind, or of the same kind with another value: there a carrier overrules what
was written.
"""

import re
from enum import Enum

from lxml import etree

from twinform.compiler.compare import Difference
from twinform.passes.legalise.carrier import NAMESPACE
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
    return found.group, aspect, *(_NAME.sub("", said.text or "") for said in (found.a, found.b))


def counts_plainly(found: Difference, plainly: Plainly, edited: bytes) -> bool:
    """Whether a difference to the file without carriers counts."""
    if plainly is Plainly.NONE or _is_empty_link(found, edited) or _is_marked_frame(found, edited):
        return False
    if _is_of_chain(found, edited):
        return False
    if plainly is Plainly.SKELETON:
        return found.aspect.startswith(_SKELETON.get(found.group, ())) if found.aspect else False
    if plainly is Plainly.ADDITIONS_TOO and found.group != "frame":
        return True
    return found.a.text is not None and not _is_without_links(found)


def _is_without_links(found: Difference) -> bool:
    """Whether it is a frame of a model that has no links: they are in the model, and in URDF in a link that is made."""
    return found.group == "frame" and (found.b.text or "").strip("'") == "__model__"


def _is_marked_frame(found: Difference, edited: bytes) -> bool:
    """Whether it is a link or a joint that a mark calls a frame, or made for one."""
    if found.group != "frame" or found.aspect or found.b.text is not None:
        return False
    marks = (f"{_OURS}frame", f"{_OURS}made")
    named = (each for each in etree.fromstring(edited).iter("link", "joint") if each.get("name") == found.name)
    return any(child.tag in marks for each in named for child in each)


def _is_of_chain(found: Difference, edited: bytes) -> bool:
    """Whether it is the last joint of a chain, which has the name of a joint of SDF and only its last axis."""
    if found.group != "joint":
        return False
    root = etree.fromstring(edited)
    if any(each.get("name") == found.name for each in root.iter("joint") if each.find(f"{_OURS}chain") is not None):
        return True
    # a joint of a nested model that has come apart has the name that it has outside of it
    scoped = (mark.text or "" for mark in root.iter(f"{_OURS}scoped-name"))
    return found.a.text is None and any(name.replace("::", "_") == found.name for name in scoped)


def _is_empty_link(found: Difference, edited: bytes) -> bool:
    """Whether it is a link that says nothing but its name: URDF has to have one, so it is made."""
    if found.group != "link" or found.aspect or found.b.text is not None:
        return False
    links = [each for each in etree.fromstring(without_carriers(edited)).iter("link") if each.get("name") == found.name]
    return all(not len(each) for each in links)


def _give_names_back(root: XmlElement) -> None:
    """Call what is marked by its old name, everywhere: a name that had to change is no other part."""
    names: dict[str, str] = {}
    for mark in root.iter(f"{_OURS}scoped-name"):
        holder = mark.getparent()
        if holder is not None and holder.get("name") == mark.get("instead_of") and mark.text:
            names[str(mark.get("instead_of"))] = mark.text
    if not names:
        return
    for element in root.iter(etree.Element):
        if (element.text or "").strip() in names:
            element.text = names[(element.text or "").strip()]
        for key, value in element.items():
            element.set(key, names.get(str(value), str(value)))


def _take_out(element: XmlElement) -> None:
    parent = element.getparent()
    if parent is not None:
        parent.remove(element)
