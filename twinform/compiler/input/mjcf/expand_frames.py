"""Expands the `frame` and `replicate` elements of a canonical MJCF tree: what is in them is posed in the body around.

The copies of a replicate have a number behind their names. What refers to something in it from another section, such
as a sensor, is copied with it.
"""

from collections.abc import Iterator
from copy import deepcopy
from typing import NamedTuple, cast

from lxml import etree

from twinform.compiler.input.mjcf.canonical_values import rotation_of
from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings
from twinform.compiler.input.mjcf.copy_budget import CopyBudget, copies_of
from twinform.compiler.input.mjcf.copy_followers import Followers
from twinform.compiler.input.mjcf.element_findings import ElementFindings, set_line
from twinform.compiler.input.mjcf.number_lists import Numbers, number_text, numbers_of
from twinform.compiler.input.mjcf.quaternions import (
    UNTURNED,
    Quaternion,
    UnturnableError,
    Vector,
    multiply,
    rotate,
    unit,
)
from twinform.diagnostics import rules
from twinform.schemas import XmlElement
from twinform.schemas.mjcf_references import KINDS, names_in, rename

_POSED = frozenset({"body", "geom", "site", "camera", "frame", "flexcomp", "attach"})
_BEFORE = etree.XPath("preceding::*/@name | ancestor::*/@name")
_SCALES = ("scale", "massscale")


class FramePose(NamedTuple):
    """Where a frame stands in the one around it."""

    position: Vector = (0.0, 0.0, 0.0)
    rotation: Quaternion = UNTURNED

    def of(self, inner: "FramePose") -> "FramePose":
        """Return where a frame in this one stands in the one around this."""
        return FramePose(self.point(inner.position), multiply(self.rotation, inner.rotation))

    def point(self, point: Vector) -> Vector:
        """Return a point of this frame in the one around it."""
        a, b = self.position, rotate(self.rotation, point)
        return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def expand_frames(root: XmlElement, settings: CompilerSettings, findings: ElementFindings, budget: CopyBudget) -> None:
    """Put what is in frames and replicates in their places, the innermost replicates first."""
    followers = Followers(root, budget) if next(root.iter("replicate"), None) is not None else None
    for worldbody in root.iterchildren("worldbody"):
        if followers is not None:
            replicates = [element for _, element in etree.iterwalk(worldbody, events=("end",), tag="replicate")]
            for replicate in replicates:
                _expand_frames_in(replicate, findings)
                _expand_replicate(replicate, followers, settings, findings)
        _expand_frames_in(worldbody, findings)
    if followers is not None:
        followers.sort()


def _expand_frames_in(element: XmlElement, findings: ElementFindings) -> None:
    """Expand the frames in an element, the outermost first, so that each of the others is posed but once."""
    for frame in [*element.iter("frame")]:
        _expand_frame(frame, findings)


def _expand_frame(frame: XmlElement, findings: ElementFindings) -> None:
    for name in _SCALES:
        if name in frame.attrib and any(number not in {0.0, 1.0} for number in numbers_of(frame, name, ()) or ()):
            message = f"what is in this frame is scaled by {name!r}, which is not supported"
            findings.report(rules.SCALED_FRAME, frame, message, f"@{name}", found=frame.get(name))
    pose = FramePose(_vector(frame, "pos"), _quaternion(frame))
    for child in _elements(frame):
        place_in(child, pose)
    _replace(frame, list(frame))


def _expand_replicate(
    replicate: XmlElement, followers: Followers, settings: CompilerSettings, findings: ElementFindings
) -> None:
    count = copies_of(replicate) if len(replicate) else 0
    for joint in replicate.iterchildren("joint", "freejoint"):
        message = "a joint may not stand in <replicate>, which would give its body several ones"
        findings.report(rules.JOINTS_OF_A_BODY, joint, message, help="write a <body> around it")
    step = FramePose(_vector(replicate, "offset"), _turn_of(replicate, settings, findings))
    names = names_in(replicate)
    suffixes = [f"{replicate.get('sep', '')}{number:0{len(str(count))}}" for number in range(count)]
    copies: list[XmlElement] = []
    first = next(iter(_elements(replicate)), replicate)
    pose = FramePose()
    for suffix in suffixes:
        for child in _elements(replicate):
            copy = deepcopy(child)
            copy.tail = None
            add_to_names(copy, names, "", suffix)
            place_in(copy, pose)
            set_line(copy, first)  # documents are written in the order of lines, and copies follow each other
            copies.append(copy)
        pose = pose.of(step)
    before = _NamesBefore(replicate)
    if names:
        followers.copy(names, suffixes, before, replicate, findings)
    _replace(replicate, copies)


def add_to_names(element: XmlElement, names: dict[str, set[str]], before: str, behind: str) -> None:
    """Change the names of an element and of all in it, and what refers to them."""
    for each in element.iter("*"):
        name = each.get("name")
        if name and (str(each.tag) in KINDS or each.tag == "frame"):
            each.set("name", f"{before}{name}{behind}")
    rename(element, names, lambda name: f"{before}{name}{behind}")


class _NamesBefore:
    """The names that stand before an element in its file, looked for when somebody asks."""

    def __init__(self, element: XmlElement) -> None:
        self._element = element
        self._found: frozenset[str] | None = None

    def __contains__(self, name: object) -> bool:
        if self._found is None:
            before = cast("list[str]", _BEFORE(self._element))
            self._found = frozenset(["world", *map(str, before)])
        return name in self._found


def place_in(element: XmlElement, pose: FramePose) -> None:
    """Write the pose of an element of a frame as it is in the frame around that one."""
    if pose == FramePose():
        return
    tag = str(element.tag)
    if tag in _POSED:
        _place(element, pose)
    elif tag == "inertial":
        _place_inertial(element, pose)
    elif tag == "light":
        element.set("pos", number_text(pose.point(_vector(element, "pos"))))
        element.set("dir", number_text(rotate(pose.rotation, _vector(element, "dir", (0.0, 0.0, -1.0)))))
    elif tag == "joint" and element.get("type") != "free":
        element.set("pos", number_text(pose.point(_vector(element, "pos"))))
        if element.get("type") != "ball":
            element.set("axis", number_text(rotate(pose.rotation, _vector(element, "axis", (0.0, 0.0, 1.0)))))


def _place(element: XmlElement, pose: FramePose) -> None:
    element.set("pos", number_text(pose.point(_vector(element, "pos"))))
    rotation = multiply(pose.rotation, _quaternion(element))
    element.attrib.pop("quat", None)
    if rotation != UNTURNED:
        element.set("quat", number_text(unit(rotation)))


def _place_inertial(inertial: XmlElement, pose: FramePose) -> None:
    full = numbers_of(inertial, "fullinertia", count=6)
    if full is None:
        _place(inertial, pose)
        return
    # the axes of fullinertia are those of the body, and no orientation may stand beside it
    inertial.set("pos", number_text(pose.point(_vector(inertial, "pos"))))
    inertial.set("fullinertia", number_text(_turned_inertia(full, pose.rotation)))


def _turned_inertia(full: Numbers, rotation: Quaternion) -> Numbers:
    """Return R I R^T as xx yy zz xy xz yz."""
    xx, yy, zz, xy, xz, yz = full[:6]
    rows = [
        rotate(rotation, row) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    ]  # (R I)^T, since I is symmetric
    turned = [rotate(rotation, (rows[0][k], rows[1][k], rows[2][k])) for k in range(3)]
    return (turned[0][0], turned[1][1], turned[2][2], turned[0][1], turned[0][2], turned[1][2])


def _turn_of(replicate: XmlElement, settings: CompilerSettings, findings: ElementFindings) -> Quaternion:
    try:
        return rotation_of(replicate, settings) or UNTURNED
    except UnturnableError as error:
        findings.report(rules.ZERO_AXIS, replicate, f"<replicate> has no orientation: {error}")
        return UNTURNED


def _replace(wrapper: XmlElement, contents: list[XmlElement]) -> None:
    """Put elements in the place of the one that they are in or come from."""
    parent = wrapper.getparent()
    if parent is None:
        return
    wrapper.tail = None
    for each in contents:
        wrapper.addprevious(each)
    parent.remove(wrapper)


def _elements(element: XmlElement) -> Iterator[XmlElement]:
    yield from list(element.iterchildren("*"))


def _vector(element: XmlElement, name: str, default: Vector = (0.0, 0.0, 0.0)) -> Vector:
    found = numbers_of(element, name, count=3)
    return default if found is None else (found[0], found[1], found[2])


def _quaternion(element: XmlElement) -> Quaternion:
    found = numbers_of(element, "quat", count=4)
    return UNTURNED if found is None else (found[0], found[1], found[2], found[3])
