"""Expands the `frame` and `replicate` elements of a canonical MJCF tree: what is in them is posed in the body around.

The copies of a replicate have a number behind their names. What refers to something in it from another section, such
as a sensor, is copied with it. How much comes of all copies is counted before anything is copied.
"""

from collections.abc import Container, Iterable, Iterator
from copy import deepcopy
from typing import NamedTuple, cast

from lxml import etree

from twinform.compiler.input.mjcf.canonical_values import rotation_of
from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings
from twinform.compiler.input.mjcf.element_findings import ElementFindings
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
from twinform.compiler.input.mjcf.references import KINDS, names_in, own_references, references_in, rename
from twinform.compiler.input.size_limits import LIFTED_BY_TAGS
from twinform.diagnostics import rules
from twinform.schemas import XmlElement

_WRAPPERS = ("frame", "replicate")
_FOLLOWING = ("contact", "tendon", "equality", "actuator", "sensor", "custom")
"""The sections whose elements are copied with what they refer to, each behind those that it may refer to."""
_NAMED_BY_SECTION = {"tendon": "tendon", "actuator": "actuator"}
_POSED = frozenset({"body", "geom", "site", "camera", "frame", "flexcomp", "attach"})
_HELD_TOGETHER = frozenset({"connect", "weld", "joint", "tendon"})
_KINDS_OF_BODIES = frozenset(KINDS.values())
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


def is_too_large(root: XmlElement, findings: ElementFindings, most: int) -> bool:
    """Report that the replicates of a tree make more elements than there may be, before any is made."""
    sizes: dict[XmlElement, int] = {}
    for _, element in etree.iterwalk(root, events=("end",)):
        inside = sum(sizes.pop(child, 0) for child in element)
        sizes[element] = inside * max(_count(element), 1) if element.tag == "replicate" else inside + 1
        if sizes[element] > most:
            message = f"the copies of this <{element.tag}> make more than {most:,} elements"
            findings.report(rules.OVERSIZED_FILE, element, message, help=LIFTED_BY_TAGS)
            return True
    return False


def expand_frames(root: XmlElement, settings: CompilerSettings, findings: ElementFindings) -> None:
    """Put what is in frames and replicates in their places, the innermost first."""
    for worldbody in root.iterchildren("worldbody"):
        wrappers = [element for _, element in etree.iterwalk(worldbody, events=("end",), tag=_WRAPPERS)]
        for wrapper in wrappers:
            if wrapper.tag == "frame":
                _expand_frame(wrapper, findings)
            else:
                _expand_replicate(wrapper, root, settings, findings)


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
    replicate: XmlElement, root: XmlElement, settings: CompilerSettings, findings: ElementFindings
) -> None:
    count = _count(replicate)
    for joint in replicate.iterchildren("joint", "freejoint"):
        message = "a joint may not stand in <replicate>, which would give its body several ones"
        findings.report(rules.JOINTS_OF_A_BODY, joint, message, help="write a <body> around it")
    step = FramePose(_vector(replicate, "offset"), _turn_of(replicate, settings, findings))
    names = names_in(replicate)
    suffixes = [f"{replicate.get('sep', '')}{number:0{len(str(count))}}" for number in range(count)]
    copies: list[XmlElement] = []
    pose = FramePose()
    for suffix in suffixes:
        for child in _elements(replicate):
            copy = deepcopy(child)
            copy.tail = None
            add_to_names(copy, names, "", suffix)
            place_in(copy, pose)
            copies.append(copy)
        pose = pose.of(step)
    before = _NamesBefore(replicate)
    if names:
        copy_followers(root, names, suffixes, before)
    _replace(replicate, copies)


def add_to_names(element: XmlElement, names: dict[str, set[str]], before: str, behind: str) -> None:
    """Change the names of an element and of all in it, and what refers to them."""
    for each in element.iter("*"):
        name = each.get("name")
        if name and (str(each.tag) in KINDS or each.tag == "frame"):
            each.set("name", f"{before}{name}{behind}")
    rename(element, names, lambda name: f"{before}{name}{behind}")


def copy_followers(
    root: XmlElement, names: dict[str, set[str]], suffixes: Iterable[str], before: Container[str]
) -> None:
    """Copy the elements of other sections that refer to what was copied, once for each suffix, and take them out.

    All else that such an element refers to has to be among the names `before` the copies. As in MuJoCo, others are
    not copied, and constraints between what was copied and anything else are left out.
    """
    known = {kind: set(each) for kind, each in names.items()}
    followers: list[tuple[XmlElement, list[XmlElement]]] = []
    for section in (section for tag in _FOLLOWING for section in root.iterchildren(tag)):
        found = [each for each in _elements(section) if _follows(each, known) and _can_follow(each, known, before)]
        followers.append((section, found))
        kind = _NAMED_BY_SECTION.get(str(section.tag))
        if kind:
            known.setdefault(kind, set()).update(name for each in found if (name := each.get("name")))
    for suffix in suffixes:
        for section, found in followers:
            for each in found:
                if _is_whole(each, known):
                    copy = deepcopy(each)
                    if copy.get("name"):
                        copy.set("name", f"{copy.get('name')}{suffix}")
                    rename(copy, known, lambda name, suffix=suffix: f"{name}{suffix}")
                    section.append(copy)
    for section, found in followers:
        for each in found:
            section.remove(each)


def _follows(element: XmlElement, names: dict[str, set[str]]) -> bool:
    """Whether an element refers to one of some names."""
    return any(each.name in names.get(each.kind, ()) for each in references_in(element))


def _can_follow(element: XmlElement, names: dict[str, set[str]], before: Container[str]) -> bool:
    """Whether all that an element refers to is copied, or known when the copies are made."""
    if element.tag in _HELD_TOGETHER:
        return True
    of_bodies = (each for each in references_in(element) if each.kind in _KINDS_OF_BODIES)
    return all(each.name in names.get(each.kind, ()) or each.name in before for each in of_bodies)


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


def _is_whole(element: XmlElement, names: dict[str, set[str]]) -> bool:
    """Whether all that a constraint holds together was copied: MuJoCo leaves others out."""
    if element.tag not in _HELD_TOGETHER:
        return True
    return all(each.name in names.get(each.kind, ()) for each in own_references(element))


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


def _count(replicate: XmlElement) -> int:
    """Return how many copies a replicate makes: none where it says no number, or a negative one."""
    try:
        return max(int(replicate.get("count", "0")), 0)
    except ValueError:
        return 0


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
