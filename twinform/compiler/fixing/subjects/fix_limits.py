"""Fixes of limits and dynamics: upside down, in degrees, soft ones outside of hard ones, negative damping."""

import math
from collections.abc import Mapping

from twinform.compiler.fixing.numbers_text import numbers_of, text_of_number
from twinform.compiler.fixing.site import FindingSite, Fixers, unsafe
from twinform.diagnostics import Fix, TextEdit, rules
from twinform.schemas import XmlElement


def value_of(site: FindingSite, element: XmlElement, name: str) -> str | None:
    """What an element says of a name: URDF in an attribute, SDF in an element."""
    return element.get(name) if site.file.format == "urdf" else element.findtext(name)


def write(site: FindingSite, element: XmlElement, values: Mapping[str, str]) -> list[TextEdit]:
    """Write other values where there are some."""
    if site.file.format == "urdf":
        return [site.edit.set_attribute(element, name, value) for name, value in values.items()]
    found = [(element.find(name), value) for name, value in values.items()]
    return [edit for each, value in found if each is not None for edit in site.edit.set_text(each, value)]


def _number(site: FindingSite, element: XmlElement, name: str) -> float | None:
    found = numbers_of(value_of(site, element, name))
    return found[0] if len(found) == 1 else None


def _upside_down(site: FindingSite) -> Fix | None:
    lower, upper = (value_of(site, site.element, name) for name in ("lower", "upper"))
    if lower is None or upper is None:
        return None
    return unsafe(
        "Exchange the lower and the upper limit",
        *write(site, site.element, {"lower": upper.strip(), "upper": lower.strip()}),
    )


def _in_degrees(site: FindingSite) -> Fix | None:
    found = {name: _number(site, site.element, name) for name in ("lower", "upper")}
    values = {name: text_of_number(round(math.radians(value), 9)) for name, value in found.items() if value}
    return unsafe("Write the limits in radians", *write(site, site.element, values)) if values else None


def _soft(site: FindingSite) -> Fix | None:
    """Soft limits on the hard ones, where these are there."""
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
    names = [name for name in ("damping", "friction") if (_number(site, site.element, name) or 0) < 0]
    written = {name: (value_of(site, site.element, name) or "").strip().removeprefix("-") for name in names}
    return unsafe("Write the number without its minus", *write(site, site.element, written)) if written else None


FIXERS: Fixers = {
    rules.NEGATIVE_DYNAMICS.name: _negative_dynamics,
    rules.RANGE_IN_DEGREES.name: _in_degrees,
    rules.SOFT_LIMIT_OUTSIDE.name: _soft,
    rules.LOWER_ABOVE_UPPER.name: _upside_down,
}
