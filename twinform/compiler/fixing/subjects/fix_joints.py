"""Fixes of joints: axes that are missing, not needed or not of length one, limits that nobody reads."""

import math

from lxml import etree

from twinform.compiler.fixing.numbers_text import numbers_of, text_of_numbers
from twinform.compiler.fixing.site import FindingSite, Fixers, safe, unsafe
from twinform.diagnostics import Fix, TextEdit, nearest_name, rules
from twinform.schemas import XmlElement

_OF_AN_AXIS = frozenset({"limit", "dynamics"})
"""What URDF writes beside an axis, and only joints that move have a use for."""
_RANGE = ("lower", "upper")
_DEFAULT_AXIS = {"urdf": "1 0 0", "sdf": "0 0 1"}


def _missing_axis(site: FindingSite) -> Fix | None:
    """The default of the format, written down."""
    name = (site.finding.expected or "").strip("<>")
    if not name or site.element.find(name) is not None:
        return None
    value = _DEFAULT_AXIS[site.file.format]
    axis = etree.Element(name)
    if site.file.format == "urdf":
        axis.set("xyz", value)
    else:
        etree.SubElement(axis, "xyz").text = value
    return safe(f"Write the axis that is the default, {value}", site.edit.insert(site.element, axis, _last_end(site)))


def _last_end(site: FindingSite) -> XmlElement | None:
    """The last of the elements before which nobody looks for an axis."""
    found = [each for each in site.element if each.tag in {"origin", "pose", "parent", "child"}]
    return found[-1] if found else None


def _unused_axis(site: FindingSite) -> Fix | None:
    """What belongs to an axis goes with it; a second axis may tell that the type of the joint is wrong."""
    if site.element.tag == "axis2":
        return unsafe("Delete the <axis2>, which nobody reads", site.edit.remove(site.element))
    joint = site.element if site.missing else site.element.getparent()
    if joint is None or (site.missing or str(site.element.tag)) != "axis":
        return None
    idle = [each for each in joint if each.tag in _OF_AN_AXIS and site.file.format == "urdf"]
    gone = idle if site.missing else [site.element, *idle]
    names = " and ".join(f"<{each.tag}>" for each in gone)
    # The axis of a fixed joint, which exporters write: half of what fixes change in the corpus.
    return safe(f"Delete {names}, which nobody reads", *map(site.edit.remove, gone)) if gone else None


def _unnormalized_axis(site: FindingSite) -> Fix | None:
    element = site.element if site.file.format == "urdf" else site.element.find("xyz")
    if element is None:
        return None
    text = element.get("xyz") if site.file.format == "urdf" else element.text
    numbers = numbers_of(text)
    length = math.hypot(*numbers)
    if len(numbers) != 3 or not length:
        return None
    value = text_of_numbers([each / length for each in numbers])
    return safe(f"Write the axis with length one, {value}", *_write(site, element, "xyz", value))


def _zero_axis(site: FindingSite) -> Fix | None:
    element = site.element if site.file.format == "urdf" else site.element.find("xyz")
    if element is None:
        return None
    value = _DEFAULT_AXIS[site.file.format]
    return unsafe(f"Write the axis that is the default, {value}", *_write(site, element, "xyz", value))


def _write(site: FindingSite, element: XmlElement, name: str, value: str) -> tuple[TextEdit, ...]:
    """Write a value where the format has it: URDF in an attribute, SDF in a text."""
    if site.file.format == "urdf":
        return (site.edit.set_attribute(element, name, value),)
    return site.edit.set_text(element, value)


def _unused_limit(site: FindingSite) -> Fix | None:
    """Lower and upper limits of a continuous joint."""
    if site.element.tag != "limit":
        return None
    if site.file.format == "urdf":
        written = [name for name in _RANGE if name in site.element.attrib]
        edits = [site.edit.remove_attribute(site.element, name) for name in written]
    else:
        edits = _without_range(site, site.element)
    return safe("Delete the limits of the angle, which nobody reads", *edits) if edits else None


def _continuous(site: FindingSite) -> Fix | None:
    """A joint of SDF that Gazebo can turn."""
    if site.element.get("type") != "continuous":
        return None
    edits = [edit for limit in site.element.iterfind("axis/limit") for edit in _without_range(site, limit)]
    return unsafe("Make it revolute, without limits", site.edit.set_attribute(site.element, "type", "revolute"), *edits)


def _without_range(site: FindingSite, limit: XmlElement) -> list[TextEdit]:
    """A limit of SDF without those of the angle; there is none where it has no others."""
    gone = [each for each in limit if each.tag in _RANGE]
    if len(gone) == len(limit):
        return [site.edit.remove(limit)]
    return [site.edit.remove(each) for each in gone]


def _make_continuous(site: FindingSite) -> Fix | None:
    """A revolute joint of URDF without limits, or with none to move between."""
    joint = site.element if site.element.tag == "joint" else site.element.getparent()
    if site.file.format != "urdf" or joint is None or joint.get("type") != "revolute":
        return None
    return unsafe("Make it continuous: it turns without end", site.edit.set_attribute(joint, "type", "continuous"))


def _missing_limit(site: FindingSite) -> Fix | None:
    """A joint turns without end, unless its limit is there under another name: then that is what to fix."""
    row = site.file.row_of(site.element)
    known = {each.name for each in row.children} if row else set[str]()
    unknown = {str(each.tag) for each in site.element.iterchildren("*")} - known
    if any(nearest_name(each, ["limit"]) for each in unknown):
        return None
    return _make_continuous(site)


def _empty_range(site: FindingSite) -> Fix | None:
    written = {"lower", "upper"} & set(map(str, site.element.attrib))
    return _make_continuous(site) if not written else None


def _empty_dynamics(site: FindingSite) -> Fix | None:
    if site.element.tag != "dynamics":
        return None
    return safe("Delete the empty <dynamics>", site.edit.remove(site.element))


def _world_child(site: FindingSite) -> Fix | None:
    joint = site.element if site.element.tag == "joint" else site.element.getparent()
    if joint is None:
        return None
    parent, child = joint.find("parent"), joint.find("child")
    if parent is None or child is None or (child.text or "").strip() != "world":
        return None
    edits = (*site.edit.set_text(parent, "world"), *site.edit.set_text(child, (parent.text or "").strip()))
    return unsafe("Exchange parent and child", *edits)


FIXERS: Fixers = {
    rules.MISSING_AXIS.name: _missing_axis,
    rules.UNUSED_AXIS.name: _unused_axis,
    rules.UNNORMALISED_AXIS.name: _unnormalized_axis,
    rules.UNUSED_LIMIT.name: _unused_limit,
    rules.CONTINUOUS_IN_SDF.name: _continuous,
    rules.EMPTY_DYNAMICS.name: _empty_dynamics,
    rules.EMPTY_RANGE.name: _empty_range,
    rules.MISSING_LIMIT.name: _missing_limit,
    rules.WORLD_CHILD.name: _world_child,
    rules.ZERO_AXIS.name: _zero_axis,
}
