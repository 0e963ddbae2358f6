"""Canonical values of MJCF elements: radians, orientations as `quat`, shapes without `fromto`, limits that are said."""

import math
from collections.abc import Iterator

from twinform.compiler.input.mjcf.compiler_settings import CompilerSettings
from twinform.compiler.input.mjcf.default_classes import ROTATIONS
from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.mjcf.number_lists import Numbers, number_text, numbers_of
from twinform.compiler.input.mjcf.quaternions import (
    TINY,
    Quaternion,
    UnturnableError,
    from_axes,
    from_axis_angle,
    from_euler,
    from_z_axis,
    unit,
)
from twinform.diagnostics import rules
from twinform.passes.legalise.to_mjcf.kept_mjcf import LIMITED, WITHOUT_CONTROL_LIMIT
from twinform.schemas import XmlElement

_TURNED = frozenset({"body", "frame", "geom", "site", "camera", "inertial", "flexcomp"})
"""The elements that have an orientation."""
_ANGLES = ("range", "ref", "springref")
_SPANNED = {"capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}
"""Shapes that may lie between two points, and how many numbers their size has."""


def write_canonical_values(root: XmlElement, settings: CompilerSettings, findings: ElementFindings) -> None:
    """Rewrite the attributes of all elements; no element is moved."""
    for element in bodies_and_parts(root):
        tag = str(element.tag)
        if tag in {"geom", "site"} and element.get("fromto") is not None:
            _place_between(element, findings)
        if tag in _TURNED:
            _turn(element, settings, findings)
        elif tag == "joint":
            if element.get("type") != "free":
                _write_limits(element, settings, findings, ("range", "actuatorfrcrange"))
            _write_radians(element, settings)
        settings.resolve_files(element)
    for section in root.iterchildren("asset", "deformable"):
        for each in section.iterchildren():
            settings.resolve_files(each)
            _name_by_file(each)
    for each in (each for section in root.iterchildren("tendon") for each in section.iterchildren()):
        _write_limits(each, settings, findings, ("range", "actuatorfrcrange"))
    for each in (each for section in root.iterchildren("actuator") for each in section.iterchildren()):
        names = (
            ("forcerange", "actrange") if each.tag in WITHOUT_CONTROL_LIMIT else ("ctrlrange", "forcerange", "actrange")
        )
        _write_limits(each, settings, findings, names)


def bodies_and_parts(root: XmlElement) -> Iterator[XmlElement]:
    """Yield all elements of the kinematic tree, in order."""
    for worldbody in root.iterchildren("worldbody"):
        yield from worldbody.iterdescendants()


def _turn(element: XmlElement, settings: CompilerSettings, findings: ElementFindings) -> None:
    """Write an orientation as a unit quaternion; none is left where the element is not turned."""
    written = [name for name in ROTATIONS if name in element.attrib]
    if not written:
        return
    try:
        found = _rotation(element, written[0], settings)
    except UnturnableError as error:
        findings.report(rules.ZERO_AXIS, element, f"<{element.tag}> has no orientation: {error}", f"@{written[0]}")
        found = None
    for name in written:
        del element.attrib[name]
    if found is not None:
        element.set("quat", number_text(found))


def rotation_of(element: XmlElement, settings: CompilerSettings) -> Quaternion | None:
    """Return the orientation that an element writes, or None.

    Raises:
        UnturnableError: the numbers are no orientation.
    """
    written = next((name for name in ROTATIONS if name in element.attrib), None)
    return None if written is None else _rotation(element, written, settings)


def _rotation(element: XmlElement, name: str, settings: CompilerSettings) -> Quaternion | None:
    n = numbers_of(element, name, count=_COUNTS[name])
    if n is None:
        return None
    angle = math.radians if settings.degrees else float
    match name:
        case "quat":
            return unit((n[0], n[1], n[2], n[3]))
        case "axisangle":
            return from_axis_angle((n[0], n[1], n[2]), angle(n[3]))
        case "euler":
            return from_euler((angle(n[0]), angle(n[1]), angle(n[2])), settings.sequence)
        case "xyaxes":
            return from_axes((n[0], n[1], n[2]), (n[3], n[4], n[5]))
        case _:
            return from_z_axis((n[0], n[1], n[2]))


_COUNTS = {"quat": 4, "axisangle": 4, "euler": 3, "xyaxes": 6, "zaxis": 3}


def _place_between(element: XmlElement, findings: ElementFindings) -> None:
    """Write the pose and the size of a shape between two points: its z axis points from the second to the first."""
    points = numbers_of(element, "fromto", count=6)
    usual = "sphere"
    shape = element.get("type", usual)
    if points is None or shape not in _SPANNED:
        message = f"'fromto' is for capsules, cylinders, boxes and ellipsoids, and this is a {shape}"
        findings.report(rules.UNUSABLE_SIZE, element, message, "@fromto", found=shape, expected=", ".join(_SPANNED))
        del element.attrib["fromto"]
        return
    start, end = points[:3], points[3:6]
    along = (start[0] - end[0], start[1] - end[1], start[2] - end[2])
    length = math.hypot(*along)
    if length < TINY:
        message = f"the two points of 'fromto' are one, so that the {shape} has no direction"
        findings.report(rules.UNUSABLE_SIZE, element, message, "@fromto", found=element.get("fromto"))
        element.set("size", "1 1 1")  # nothing else is wrong with it
        del element.attrib["fromto"]
        return
    del element.attrib["fromto"]
    for name in ROTATIONS:  # those of a class do not count
        element.attrib.pop(name, None)
    element.set("pos", number_text((a + b) / 2 for a, b in zip(start, end, strict=True)))
    element.set("quat", number_text(from_z_axis(along)))
    element.set("size", number_text(_spanned_size(numbers_of(element, "size", ()) or (), shape, length / 2)))


def _spanned_size(size: Numbers, shape: str, half: float) -> Numbers:
    radius = size[0] if size else 0.0
    if _SPANNED[shape] == 3:
        return (radius, radius, half)
    return (radius, half, *size[2:3])


def _write_radians(joint: XmlElement, settings: CompilerSettings) -> None:
    if not settings.degrees or joint.get("type", "hinge") not in {"hinge", "ball"}:
        return
    for name in _ANGLES:
        found = numbers_of(joint, name)
        # MuJoCo leaves a range that does not limit as it is
        if found is not None and (name != "range" or joint.get("limited") == "true"):
            joint.set(name, number_text(map(math.radians, found)))


def _write_limits(
    element: XmlElement, settings: CompilerSettings, findings: ElementFindings, names: tuple[str, ...]
) -> None:
    """Write whether each range limits: `auto` is not said in canonical MJCF."""
    for name in names:
        if element.tag == "muscle" and name == "range":
            continue
        said = element.get(LIMITED[name], "auto")
        found = numbers_of(element, name, count=2)
        if said != "auto":
            continue
        element.attrib.pop(LIMITED[name], None)
        if found is None:
            continue
        if not settings.autolimits:
            message = f"{name!r} says a range and nothing says whether it limits, which autolimits='false' asks for"
            hint = f"write {LIMITED[name]}='true' or 'false'"
            findings.report(rules.AMBIGUOUS_LIMIT, element, message, f"@{name}", found=element.get(name), help=hint)
        element.set(LIMITED[name], "true" if found[0] < found[1] else "false")


def _name_by_file(asset: XmlElement) -> None:
    """Name an asset after its file, where nothing names it."""
    if asset.get("name") or asset.tag not in {"mesh", "hfield", "texture", "skin"}:
        return
    file = asset.get("file")
    if file:
        last = file.replace("\\", "/").rpartition("/")[2]
        asset.set("name", last.rpartition(".")[0] or last)
