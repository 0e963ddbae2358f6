"""Fixes of joints: axes that are missing, unused or not of length one, and wrong limits and dynamics."""

import math
from collections.abc import Mapping

from lxml import etree

from twinform.compiler.fixing.fix_numbers import numbers_of, text_of_number, text_of_numbers
from twinform.compiler.fixing.site import FindingSite, Fixers, safe, unsafe
from twinform.diagnostics import Fix, TextEdit, nearest_name, rules
from twinform.schemas import XmlElement

_OF_AN_AXIS = frozenset({"limit", "dynamics"})
"""Elements that URDF writes beside an axis, and that only moving joints use."""
_RANGE = ("lower", "upper")
_DEFAULT_AXIS = {"urdf": "1 0 0", "sdf": "0 0 1"}


def _missing_axis(site: FindingSite) -> Fix | None:
    """Write the default axis of the format."""
    name = (site.finding.expected or "").strip("<>")
    if not name or site.element.find(name) is not None:
        return None
    value = _DEFAULT_AXIS[site.file.format]
    axis = etree.Element(name)
    if site.file.format == "urdf":
        axis.set("xyz", value)
    else:
        etree.SubElement(axis, "xyz").text = value
    return safe(
        f"Write the axis that is the default, {value}", site.edit.insert(site.element, axis, _element_before_axis(site))
    )


def _element_before_axis(site: FindingSite) -> XmlElement | None:
    """Return the last of the elements that an axis is written behind."""
    found = [each for each in site.element if each.tag in {"origin", "pose", "parent", "child"}]
    return found[-1] if found else None


def _unused_axis(site: FindingSite) -> Fix | None:
    """Delete an unused axis with its limits and dynamics; a second axis may mean that the type of joint is wrong."""
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
    numbers = numbers_of(site.read(element, "xyz"))
    length = math.hypot(*numbers)
    if len(numbers) != 3 or not length:
        return None
    value = text_of_numbers([each / length for each in numbers])
    return safe(f"Write the axis with length one, {value}", *site.write(element, "xyz", value))


def _zero_axis(site: FindingSite) -> Fix | None:
    element = site.element if site.file.format == "urdf" else site.element.find("xyz")
    if element is None:
        return None
    value = _DEFAULT_AXIS[site.file.format]
    return unsafe(f"Write the axis that is the default, {value}", *site.write(element, "xyz", value))


def _unused_limit(site: FindingSite) -> Fix | None:
    """Delete the lower and upper limits of a continuous joint."""
    if site.element.tag != "limit":
        return None
    if site.file.format == "urdf":
        written = [name for name in _RANGE if name in site.element.attrib]
        edits = [site.edit.remove_attribute(site.element, name) for name in written]
    else:
        edits = _without_range(site, site.element)
    return safe("Delete the limits of the angle, which nobody reads", *edits) if edits else None


def _continuous_in_sdf(site: FindingSite) -> Fix | None:
    """Make a continuous joint of SDF a revolute one without limits, which every version of SDF has."""
    if site.element.get("type") != "continuous":
        return None
    edits = [edit for limit in site.element.iterfind("axis/limit") for edit in _without_range(site, limit)]
    return unsafe("Make it revolute, without limits", site.edit.set_attribute(site.element, "type", "revolute"), *edits)


def _without_range(site: FindingSite, limit: XmlElement) -> list[TextEdit]:
    """Delete the limits of the angle in a `<limit>` of SDF, or all of it where it has no others."""
    gone = [each for each in limit if each.tag in _RANGE]
    if len(gone) == len(limit):
        return [site.edit.remove(limit)]
    return [site.edit.remove(each) for each in gone]


def _make_continuous(site: FindingSite) -> Fix | None:
    """Make a revolute joint of URDF continuous."""
    joint = site.element if site.element.tag == "joint" else site.element.getparent()
    if site.file.format != "urdf" or joint is None or joint.get("type") != "revolute":
        return None
    return unsafe("Make it continuous: it turns without end", site.edit.set_attribute(joint, "type", "continuous"))


def _missing_limit(site: FindingSite) -> Fix | None:
    """Make a joint without a limit continuous, unless the limit is there with a typo in its tag."""
    row = site.file.row_of(site.element)
    known = {each.name for each in row.children} if row else set[str]()
    unknown = {str(each.tag) for each in site.element.iterchildren("*")} - known
    if any(nearest_name(each, ["limit"]) for each in unknown):
        return None
    return _make_continuous(site)


def _empty_range(site: FindingSite) -> Fix | None:
    return _make_continuous(site) if not any(name in site.element.attrib for name in _RANGE) else None


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


def _text_of(site: FindingSite, element: XmlElement, name: str) -> str | None:
    """Return a named value of an element, which is an attribute in URDF and an element in SDF."""
    return element.get(name) if site.file.format == "urdf" else element.findtext(name)


def _write_values(site: FindingSite, element: XmlElement, values: Mapping[str, str]) -> list[TextEdit]:
    """Write other values in the places of those that are written."""
    if site.file.format == "urdf":
        return [site.edit.set_attribute(element, name, value) for name, value in values.items()]
    found = [(element.find(name), value) for name, value in values.items()]
    return [edit for each, value in found if each is not None for edit in site.edit.set_text(each, value)]


def _number_in(site: FindingSite, element: XmlElement, name: str) -> float | None:
    found = numbers_of(_text_of(site, element, name))
    return found[0] if len(found) == 1 else None


def _lower_above_upper(site: FindingSite) -> Fix | None:
    lower, upper = (_text_of(site, site.element, name) for name in ("lower", "upper"))
    if lower is None or upper is None:
        return None
    return unsafe(
        "Exchange the lower and the upper limit",
        *_write_values(site, site.element, {"lower": upper.strip(), "upper": lower.strip()}),
    )


def _range_in_degrees(site: FindingSite) -> Fix | None:
    found = {name: _number_in(site, site.element, name) for name in ("lower", "upper")}
    values = {name: text_of_number(round(math.radians(value), 9)) for name, value in found.items() if value}
    return unsafe("Write the limits in radians", *_write_values(site, site.element, values)) if values else None


def _soft_limit_outside(site: FindingSite) -> Fix | None:
    """Move soft limits that are outside of the hard ones onto them."""
    joint = site.element.getparent()
    limit = joint.find("limit") if joint is not None else None
    if site.element.tag != "safety_controller" or limit is None:
        return None
    hard = {name: numbers_of(limit.get(name, "0")) for name in ("lower", "upper")}
    soft = {name: numbers_of(site.element.get(f"soft_{name}_limit")) for name in ("lower", "upper")}
    values: dict[str, str] = {}
    if soft["lower"] and hard["lower"] and soft["lower"] < hard["lower"]:
        values["soft_lower_limit"] = limit.get("lower", "0")
    if soft["upper"] and hard["upper"] and soft["upper"] > hard["upper"]:
        values["soft_upper_limit"] = limit.get("upper", "0")
    if soft["lower"] and soft["upper"] and soft["lower"] > soft["upper"]:
        values = {
            "soft_lower_limit": site.element.get("soft_upper_limit", ""),
            "soft_upper_limit": site.element.get("soft_lower_limit", ""),
        }
    edits = [site.edit.set_attribute(site.element, name, value) for name, value in values.items()]
    return unsafe("Put the soft limits inside of the hard ones", *edits) if edits else None


def _negative_dynamics(site: FindingSite) -> Fix | None:
    names = [name for name in ("damping", "friction") if (_number_in(site, site.element, name) or 0) < 0]
    written = {name: (_text_of(site, site.element, name) or "").strip().removeprefix("-") for name in names}
    return (
        unsafe("Write the number without its minus", *_write_values(site, site.element, written)) if written else None
    )


FIXERS: Fixers = {
    rules.MISSING_AXIS.name: _missing_axis,
    rules.UNUSED_AXIS.name: _unused_axis,
    rules.UNNORMALISED_AXIS.name: _unnormalized_axis,
    rules.UNUSED_LIMIT.name: _unused_limit,
    rules.CONTINUOUS_IN_SDF.name: _continuous_in_sdf,
    rules.EMPTY_DYNAMICS.name: _empty_dynamics,
    rules.EMPTY_RANGE.name: _empty_range,
    rules.MISSING_LIMIT.name: _missing_limit,
    rules.WORLD_CHILD.name: _world_child,
    rules.ZERO_AXIS.name: _zero_axis,
    rules.NEGATIVE_DYNAMICS.name: _negative_dynamics,
    rules.RANGE_IN_DEGREES.name: _range_in_degrees,
    rules.SOFT_LIMIT_OUTSIDE.name: _soft_limit_outside,
    rules.LOWER_ABOVE_UPPER.name: _lower_above_upper,
}
