"""Options, sizes and visual settings of a model that MJCF attaches, as `conflict` of the compiler says.

Usually those of the model around count, and nothing of the attached one does. With `merge`, what only the attached
model says is taken over, and of two values the more careful one; with `error`, two values are an error.
"""

from collections.abc import Iterator

from lxml import etree

from twinform.compiler.input.mjcf.element_findings import ElementFindings, give_number
from twinform.compiler.input.mjcf.number_lists import parse_numbers
from twinform.diagnostics import rules
from twinform.schemas import XmlElement

_SECTIONS = ("option", "size", "visual")
_LEAST = frozenset({
    "timestep", "tolerance", "ls_tolerance", "noslip_tolerance", "ccd_tolerance", "sleep_tolerance", "znear",
    "realtime",
})  # fmt: skip
_MOST = frozenset({
    "iterations", "ls_iterations", "noslip_iterations", "ccd_iterations", "sdf_iterations", "sdf_initpoints", "nkey",
    "nuserdata", "nuser_body", "nuser_jnt", "nuser_geom", "nuser_site", "nuser_cam", "nuser_tendon", "nuser_actuator",
    "nuser_sensor", "zfar",
})  # fmt: skip
_OF_BOTH = "actuatorgroupdisable"
_USUALLY_OFF = frozenset({"override", "energy", "fwdinv", "invdiscrete", "multiccd", "sleep", "speculative"})
"""Flags that count where one model enables them; of the others those count that one model disables."""
_UNMERGEABLE = frozenset({
    "gravity", "wind", "magnetic", "density", "viscosity", "integrator", "cone", "jacobian", "solver", "impratio",
    "o_margin", "o_solref", "o_solimp", "o_friction",
})  # fmt: skip


def merge_settings(root: XmlElement, child: XmlElement, attachment: XmlElement, findings: ElementFindings) -> None:
    """Merge the settings of a model that is attached into those of the one around."""
    compiler = root.find("compiler")
    policy = "warning" if compiler is None else compiler.get("conflict", "warning")
    if policy not in {"merge", "error"}:
        return
    for own, other in _pairs(root, child, attachment):
        for key, value in list(other.items()):
            name, theirs = str(key), str(value)
            mine = own.get(name)
            if mine is None:
                if policy == "merge":
                    own.set(name, theirs)
            elif not _is_same(mine, theirs):
                is_wrong = policy == "error" or (name in _UNMERGEABLE and own.tag == "option")
                if is_wrong:
                    message = f"{name!r} of <{own.tag}> is {mine!r} here, and {theirs!r} in the model that is attached"
                    findings.report(rules.UNATTACHED_MODEL, attachment, message, found=theirs, expected=mine)
                else:
                    own.set(name, _merged(str(own.tag), name, mine, theirs))


def _pairs(root: XmlElement, child: XmlElement, attachment: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
    """Yield the elements of settings of an attached model, each behind that of the model around, which may be made."""
    for tag in _SECTIONS:
        for section in child.iterchildren(tag):
            own = _child_of(root, tag, attachment)
            yield own, section
            for each in section.iterchildren("*"):
                yield _child_of(own, str(each.tag), attachment), each


def _child_of(element: XmlElement, tag: str, attachment: XmlElement) -> XmlElement:
    found = element.find(tag)
    if found is None:
        found = etree.SubElement(element, tag)
        give_number(found, attachment)
    return found


def _is_same(one: str, other: str) -> bool:
    first, second = parse_numbers(one), parse_numbers(other)
    return one == other or (first is not None and first == second)


def _merged(tag: str, name: str, mine: str, theirs: str) -> str:
    if tag == "flag":
        return "enable" if name in _USUALLY_OFF else "disable"
    if name == _OF_BOTH:
        return " ".join(dict.fromkeys([*mine.split(), *theirs.split()]))
    choose = min if name in _LEAST else max if name in _MOST else None
    return choose(mine, theirs, key=_number) if choose else mine


def _number(text: str) -> float:
    return (parse_numbers(text) or (0.0,))[0]
