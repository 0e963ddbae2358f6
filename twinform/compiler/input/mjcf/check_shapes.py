"""Checks the geoms and sites of MJCF: their orientation, their size, and what their type asks for."""

from twinform.compiler.input.mjcf.canonical_values import bodies_and_parts
from twinform.compiler.input.mjcf.default_classes import ROTATIONS
from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.mjcf.number_lists import numbers_of
from twinform.diagnostics import rules
from twinform.schemas import XmlElement

_SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}
"""How many numbers the size of a shape has, all of which are positive."""
_PARTS = {1: "a radius", 2: "a radius and a half length", 3: "three half sizes"}
_ASSETS = {"mesh": "mesh", "sdf": "mesh", "hfield": "hfield"}
_CONTACT_DIMENSIONS = ("1", "3", "4", "6")


def check_notations(root: XmlElement, findings: ElementFindings) -> None:
    """Report elements that say two poses, before the notations of MJCF become one."""
    for element in bodies_and_parts(root):
        written = [name for name in ROTATIONS if name in element.attrib]
        if len(written) > 1:
            message = f"<{element.tag}> has more than one orientation: {' and '.join(written)}"
            findings.report(rules.TWO_ROTATIONS, element, message, f"@{written[1]}", found=written[1])
        if element.tag in {"geom", "site"} and "fromto" in element.attrib and any(numbers_of(element, "pos", ()) or ()):
            message = f"<{element.tag}> has both 'pos' and 'fromto', in itself or in its class"
            findings.report(rules.TWO_PLACEMENTS, element, message, "@fromto", found=element.get("fromto"))


def check_shapes(root: XmlElement, findings: ElementFindings) -> None:
    """Report shapes whose size does not fit their type, or that lack a mesh or height field."""
    for element in bodies_and_parts(root):
        if element.tag == "geom":
            _check_geom(element, findings)
        elif element.tag == "site":
            _check_size(element, element.get("type", "sphere"), findings, (0.005, 0.005, 0.005))


def _check_geom(geom: XmlElement, findings: ElementFindings) -> None:
    shape = geom.get("type", "sphere")
    dimensions = geom.get("condim")
    if dimensions is not None and dimensions.strip() not in _CONTACT_DIMENSIONS:
        message = f"'condim' is {dimensions}; expected one of {', '.join(_CONTACT_DIMENSIONS)}"
        expected = ", ".join(_CONTACT_DIMENSIONS)
        findings.report(rules.INVALID_VALUE, geom, message, "@condim", found=dimensions, expected=expected)
    if shape == "plane":
        size = numbers_of(geom, "size", ()) or ()
        if len(size) < 3 or size[2] <= 0:
            message = "the size of a plane is two half sizes, or 0 where it is infinite, and a spacing above 0"
            findings.report(rules.UNUSABLE_SIZE, geom, message, "@size", found=geom.get("size"))
        return
    if shape in _ASSETS:
        if not geom.get(_ASSETS[shape]) and not len(geom):
            message = f"a geom of type {shape!r} needs the attribute {_ASSETS[shape]!r}"
            findings.report(rules.MISSING_ATTRIBUTE, geom, message, expected=f"@{_ASSETS[shape]}")
        return
    if not geom.get("mesh"):  # the shape is fitted to the mesh
        _check_size(geom, shape, findings, ())


def _check_size(element: XmlElement, shape: str, findings: ElementFindings, usual: tuple[float, ...]) -> None:
    needed = _SIZES.get(shape, 0)
    size = numbers_of(element, "size", ()) or ()
    whole = (*size, *usual[len(size) :])[:needed]
    if len(whole) == needed and all(number > 0 for number in whole):
        return
    what = _PARTS[needed]
    message = f"the size of a {shape} is {what}, and what is written is {element.get('size') or 'nothing'!r}"
    hint = "each of them has to be above 0"
    findings.report(rules.UNUSABLE_SIZE, element, message, "@size", found=element.get("size"), expected=what, help=hint)
