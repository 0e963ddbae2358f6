"""Fixes of what readers take and nobody means: values that the finding knows, ranges upside down, commands, grounds."""

from lxml import etree

from twinform.compiler.fixing.fix_numbers import numbers_of
from twinform.compiler.fixing.site import FindingSite, Fixers, unsafe
from twinform.diagnostics import Fix, rules

_PAIRS = (("min", "max"), ("near", "far"), ("min_angle", "max_angle"))


def _expected(site: FindingSite) -> Fix | None:
    """Write the value that the finding has measured or knows."""
    value = site.finding.expected
    return unsafe(f"Write {value}", *site.set_value(value)) if value else None


def _inverted_range(site: FindingSite) -> Fix | None:
    """Exchange the two ends of a range."""
    element = site.element
    name, parent = str(element.tag), element.getparent()
    ends = [(element.find(low), element.find(high)) for low, high in _PAIRS]
    if name.startswith("min_") and parent is not None:
        ends.append((element, parent.find(f"max_{name[4:]}")))
    for least, most in ends:
        if least is not None and most is not None and least.text and most.text:
            edits = (*site.edit.set_text(least, most.text.strip()), *site.edit.set_text(most, least.text.strip()))
            return unsafe(f"Exchange <{least.tag}> and <{most.tag}>", *edits)
    return None


def _moving_plane(site: FindingSite) -> Fix | None:
    """Make a model with a plane static."""
    if site.element.tag == "static":
        return unsafe("Write <static>true</static>", *site.edit.set_text(site.element, "true"))
    static = etree.Element("static")
    static.text = "true"
    return unsafe("Add <static>true</static>", site.edit.insert(site.element, static))


def _decimal_comma(site: FindingSite) -> Fix | None:
    """Write a number with a point."""
    value = site.value.strip().replace(",", ".")
    is_mended = value != site.value.strip() and len(numbers_of(value)) == 1
    return unsafe(f"Write {value}", *site.set_value(value)) if is_mended else None


def _command(site: FindingSite) -> Fix | None:
    """Delete the command interface of a joint that cannot take commands."""
    if site.element.tag != "command_interface":
        return None
    return unsafe("Delete the command interface", site.edit.remove(site.element))


def _mimic_parameter(site: FindingSite) -> Fix | None:
    """Delete the parameter where the joint of the robot says the same."""
    if site.element.tag != "param" or site.finding.help != "delete the parameter":
        return None
    return unsafe("Delete the parameter", site.edit.remove(site.element))


FIXERS: Fixers = {
    rules.CONTROL_VALUE.name: _decimal_comma,
    rules.INVERTED_RANGE.name: _inverted_range,
    rules.MIMIC_PARAMETER.name: _mimic_parameter,
    rules.MOVING_PLANE.name: _moving_plane,
    rules.UNCOMMANDABLE_JOINT.name: _command,
    rules.UPWARD_GRAVITY.name: _expected,
    rules.WRONG_WHEEL_SIZE.name: _expected,
}
