"""Checks of single values that no simulation can use: in worlds, sensors, surfaces and transmissions."""

import math
from typing import NamedTuple

from lxml import etree

from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.unexpanded_xacro import elements_of_xacro
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement, path_of


class _Range(NamedTuple):
    """The values that an element may have inside of one of these elements, and what happens with others."""

    inside: frozenset[str]
    least: float
    most: float
    expected: str
    why: str


_SENSOR_IMAGE = frozenset({"image"})
_RANGES = {
    "samples": _Range(frozenset({"horizontal", "vertical"}), 1, math.inf, "at least 1", "the lidar measures nothing"),
    "width": _Range(_SENSOR_IMAGE, 1, math.inf, "at least 1", "the camera has no picture"),
    "height": _Range(_SENSOR_IMAGE, 1, math.inf, "at least 1", "the camera has no picture"),
    "update_rate": _Range(frozenset({"sensor"}), 0, math.inf, "0 or more", "the sensor has no such rate"),
    "stddev": _Range(
        frozenset({"noise", "rate", "accel", "horizontal", "vertical"}),
        0,
        math.inf,
        "0 or more",
        "noise has no such spread",
    ),
    "mechanicalReduction": _Range(
        frozenset({"actuator", "joint", "transmission"}), math.ulp(0), math.inf, "not 0", "the joint would stand still"
    ),
    "restitution_coefficient": _Range(frozenset({"bounce"}), 0, 1, "0 to 1", "each bounce would gain energy"),
    **dict.fromkeys(
        ("mu", "mu1", "mu2"),
        _Range(frozenset({"ode", "bullet", "gazebo"}), 0, math.inf, "0 or more", "friction would push"),
    ),
    "max_step_size": _Range(
        frozenset({"physics"}), math.ulp(0), 0.1, "0.001, at most 0.1 seconds", "bodies fly through each other"
    ),
}


def report_values(tree: XmlElement, sink: DiagnosticSink) -> None:
    """Report values outside of what can be, each at its element."""
    for element in tree.iter(*_RANGES):
        allowed = _RANGES[tag_of(element)]
        value = number_of(element)
        if value is None or tag_of(element.getparent()) not in allowed.inside:
            continue
        if tag_of(element) == "mechanicalReduction":
            value = abs(value)  # a negative one turns the direction round
        if not allowed.least <= value <= allowed.most:
            message = f"<{tag_of(element)}> is {value:g}, and {allowed.why}"
            sink.report(rules.OUT_OF_RANGE, message, place_of(element), found=f"{value:g}", expected=allowed.expected)
    for gravity in tree.iter("gravity"):
        _report_gravity(gravity, sink)
    for plane in tree.iter("plane"):
        _report_plane(plane, sink)
    for mesh in tree.iter("mesh"):
        _report_nameless(mesh, sink)
    for shader in tree.iter("shader"):
        _report_shader(shader, sink)


def _report_gravity(gravity: XmlElement, sink: DiagnosticSink) -> None:
    words = (gravity.text or "").split()
    try:
        x, y, z = map(float, words)
    except ValueError:
        return
    if z > 0 and z > 10 * math.hypot(x, y):  # a tilted world is meant
        message = f"<gravity> is {' '.join(words)}: everything falls up"
        hint = f"write {x:g} {y:g} {-z:g}"
        sink.report(
            rules.UPWARD_GRAVITY,
            message,
            place_of(gravity),
            found=gravity.text,
            expected=f"{x:g} {y:g} {-z:g}",
            help=hint,
        )


def _report_plane(plane: XmlElement, sink: DiagnosticSink) -> None:
    """Report a ground that can fall: a plane to touch in a model of a world that is not static."""
    collision = next(plane.iterancestors("collision"), None)
    model = next(plane.iterancestors("model"), None) if collision is not None else None
    # A model in a file of its own may get its <static> where it is included.
    in_world = next(plane.iterancestors("world"), None) is not None
    if (
        model is None
        or not in_world
        or any(text_of(each.find("static")) in {"true", "1"} for each in (model, *model.iterancestors("model")))
    ):
        return
    if model.find("joint") is None:
        message = f"model {model.get('name')!r} has a plane, which has no end, and is not static: it falls"
        where = model.find("static")
        hint = "write <static>true</static>"
        sink.report(rules.MOVING_PLANE, message, place_of(model if where is None else where), found="plane", help=hint)


def _report_nameless(mesh: XmlElement, sink: DiagnosticSink) -> None:
    uri = mesh.get("filename")  # a blank <uri> of SDF is found by the schema
    if uri is not None and not uri.strip():
        message = "the mesh names no file: its filename is empty"
        sink.report(rules.MISSING_FILE, message, place_of(mesh), found="", expected="the path of a mesh")


def _report_shader(shader: XmlElement, sink: DiagnosticSink) -> None:
    kind = shader.get("type", "")
    # Material.cc, Load: it asks for the map, and `__default__` is none
    if kind.startswith("normal_map") and text_of(shader.find("normal_map")) in {"", "__default__"}:
        message = f"the shader is of type {kind!r} and has no <normal_map>"
        sink.report(rules.MISSING_ELEMENT, message, place_of(shader), expected="<normal_map>", refused=True)


_MAY_HAVE_SUBSTITUTIONS = etree.XPath("descendant-or-self::*[(text() | @*)[contains(., '$(')]]")
"""Nearly no element has one, and libxml2 finds that out faster than Python."""
_SUBSTITUTION = lazy_pattern(r"\$\((?:find|arg|env|optenv|eval|dirname)\b[^)]*\)?")


def report_substitutions(tree: XmlElement, sink: DiagnosticSink) -> None:
    """Report what xacro and roslaunch put in the place of `$(...)`, once for each kind of element of a robot."""
    seen: set[tuple[str, str]] = set()
    if tree.tag != "robot" or sink.file.lower().endswith(XACRO) or next(elements_of_xacro(tree), None) is not None:
        return  # it is expanded, or was reported as a whole
    for element in _MAY_HAVE_SUBSTITUTIONS(tree):
        for text in (element.text or "", *element.attrib.values()):
            found = _SUBSTITUTION.search(text)
            if found and (found[0], tag_of(element)) not in seen:
                seen.add((found[0], tag_of(element)))
                message = f"{found[0]} stands here as it is: only xacro puts something in its place"
                hint = "call the file .xacro, or expand it first: xacro robot.urdf.xacro > robot.urdf"
                sink.report(rules.UNEXPANDED_XACRO, message, place_of(element), found=found[0], help=hint)


def place_of(element: XmlElement) -> Location:
    """Where an element was written."""
    return Location("", element.sourceline or 0, path_of(element))


def text_of(element: XmlElement | None) -> str:
    """The text of an element without blanks around it; empty where there is none."""
    return (element.text or "").strip() if element is not None else ""


def number_of(element: XmlElement | None) -> float | None:
    """The number in an element; None where there is none, which the schema reports, or none that is finite."""
    try:
        value = float(text_of(element))
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def tag_of(element: XmlElement | None) -> str:
    """The name of an element; empty for comments and where there is none."""
    return element.tag if element is not None and isinstance(element.tag, str) else ""
