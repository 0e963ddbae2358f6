"""Checks of plugins that drive on wheels against the geometry: sizes, sides, and one joint for two wheels."""

from collections.abc import Mapping
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Element, Format, Model, Plugin
from twinform.ir.transform import dot, minus
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError, Wheel, wheel

# Wheels are calibrated by some percent; no robot needs a tenth.
_TOLERANCE = 0.1
# Each wheel asks the whole model for its place.
_MOST_WHEELS = 8
_CLEARLY = 0.9
"""The cosine above which two directions are clearly the same."""


class _Drive(NamedTuple):
    """A drive of Gazebo Classic: the system of gz-sim that measures it, and its own words for the parameters.

    A size may be a diameter where the system has a radius.
    """

    system: str
    words: Mapping[str, tuple[str, ...]]
    factors: Mapping[str, float]


_DIAMETER = {"wheel_radius": 2.0}
_CLASSIC = {
    "GazeboRosDiffDrive": _Drive(
        "diff-drive",
        {
            "left_joint": ("leftJoint", "left_joint"),
            "right_joint": ("rightJoint", "right_joint"),
            "wheel_separation": ("wheelSeparation", "wheel_separation"),
            "wheel_radius": ("wheelDiameter", "wheel_diameter"),
        },
        _DIAMETER,
    ),
    "GazeboRosSkidSteerDrive": _Drive(
        "diff-drive",
        {
            "left_joint": ("leftFrontJoint", "leftRearJoint"),
            "right_joint": ("rightFrontJoint", "rightRearJoint"),
            "wheel_radius": ("wheelDiameter",),
        },
        _DIAMETER,
    ),
}


class _Parameters(NamedTuple):
    """The parameters of a drive, found by the names that gz-sim has for them."""

    plugin: Plugin
    drive: _Drive

    def elements(self, parameter: str) -> list[Element]:
        """The elements of a parameter that have a text."""
        words = self.drive.words.get(parameter, (parameter,) if not self.drive.words else ())
        return [each for each in self.plugin.content if each.name in words and (each.text or "").strip()]

    def names(self, option: str) -> tuple[str, ...]:
        """The joints that a parameter names."""
        return tuple((each.text or "").strip() for each in self.elements(option.replace("-", "_")))

    def place(self, element: Element) -> Location:
        """Where a parameter is written."""
        return element.location if element.source else self.plugin.location.at(element.name)


def report_wheels(plugin: Plugin, kind: PluginKind, model: Model, format_: Format, sink: DiagnosticSink) -> None:
    """Report a drive whose sizes are not those of its wheels, or whose joints are not where it takes them to be."""
    drive = _CLASSIC.get(kind.class_name) or _Drive(kind.name, {}, {})
    if drive.system not in MEASURES or len(plugin.content) > _MOST_WHEELS**2:
        return
    own = _Parameters(plugin, drive)
    if _report_repeated(own, sink):
        return
    wheels = _wheels(own, model, format_)
    if wheels and not _report_sides(own, wheels, sink):
        _report_sizes(own, model, format_, sink)


def _report_repeated(own: _Parameters, sink: DiagnosticSink) -> bool:
    """Report a joint that is two wheels of one drive."""
    if own.drive.system == "ackermann-steering":  # whose driven wheels may be those that it steers
        return False
    joints = [each for each in own.plugin.content if each.name.lower().endswith("joint") and (each.text or "").strip()]
    seen: dict[str, str] = {}
    found = False
    for element in joints:
        name = (element.text or "").strip()
        if name in seen:
            message = f"<{element.name}> is the joint {name!r}, which is already the <{seen[name]}> of this drive"
            sink.report(
                rules.WRONG_WHEEL, message, own.place(element), found=name, help="name the joint of the other wheel"
            )
            found = True
        seen.setdefault(name, element.name)
    return found


def _wheels(own: _Parameters, model: Model, format_: Format) -> dict[str, list[Wheel]] | None:
    """The wheels of both sides; None where a joint cannot be measured."""
    sides = {side: own.names(f"{side}-joint") for side in ("left", "right")}
    if not all(0 < len(each) <= _MOST_WHEELS for each in sides.values()):
        return {"left": [], "right": []}
    try:
        return {side: [wheel(model, name, format_) for name in names] for side, names in sides.items()}
    except NotMeasuredError:
        return None


def _report_sides(own: _Parameters, wheels: Mapping[str, list[Wheel]], sink: DiagnosticSink) -> bool:
    """Report wheels that turn against each other, and a left wheel on the right of the way forward.

    A wheel that turns positively about its axle `a` rolls to `a` x up, of which the left side is along `a`.
    """
    if own.drive.system != "diff-drive" or not (wheels["left"] and wheels["right"]):
        return False
    left, right = wheels["left"][0], wheels["right"][0]
    names = own.names("left-joint")[0], own.names("right-joint")[0]
    same = dot(left.axle, right.axle)
    where = own.place(own.elements("left_joint")[0])
    if same < -_CLEARLY:
        message = (
            f"joints {names[0]!r} and {names[1]!r} have opposite axes: driving forward turns the robot on the spot"
        )
        sink.report(rules.WRONG_WHEEL, message, where, help="turn the <axis> of one of them round")
        return True
    across = dot(minus(left.origin, right.origin), left.axle)
    if same > _CLEARLY and across < 0:
        message = (
            f"the left joint {names[0]!r} is on the right of {names[1]!r}, as seen in the direction that they drive: "
            "the robot turns the wrong way"
        )
        hint = "exchange the two joints, or turn the <axis> of both round"
        sink.report(rules.WRONG_WHEEL, message, where, found=names[0], help=hint)
        return True
    return False


def _report_sizes(own: _Parameters, model: Model, format_: Format, sink: DiagnosticSink) -> None:
    """Report sizes that are more than a tenth off."""
    measured = Measured(model, format_, own.names)
    is_skid = len(own.names("left-joint")) > 1  # whose separation stands for the slip as well
    for parameter, measure in MEASURES[own.drive.system].items():
        elements = own.elements(parameter)
        if len(elements) != 1 or (is_skid and parameter == "wheel_separation"):
            continue
        try:
            written = float(elements[0].text or "")
            size = measure(measured) * own.drive.factors.get(parameter, 1.0)
        except (NotMeasuredError, ValueError):
            continue
        if abs(written - size) > _TOLERANCE * size:
            word = elements[0].name
            message = f"<{word}> is {written:g}, and the wheels of the model have {size:.4g} m"
            hint = f"write {size:.4g}, or let --passes add-plugin measure it"
            sink.report(
                rules.WRONG_WHEEL_SIZE,
                message,
                own.place(elements[0]),
                found=f"{written:g}",
                expected=f"{size:.4g}",
                help=hint,
            )
