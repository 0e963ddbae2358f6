"""Checks of plugins by what the catalog knows of them: files, classes, parameters, and names of joints and links.

What only a release of Gazebo can tell is left to the pass `check-plugins`: a repository for Gazebo Classic is right.
"""

from collections.abc import Mapping
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Location, nearest_name, rules
from twinform.ir import Document, Element, Format, Model, Plugin, World
from twinform.ir.transform import dot, minus
from twinform.passes.plugins.catalog import (
    LATEST,
    classic_plugins_of_file,
    known_files,
    modern_file,
    ros2_kind,
    systems_of_file,
)
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.passes.plugins.parameters import ModelNames, ParameterContext, check_parameters, find_class
from twinform.passes.plugins.sites import PluginSite, plugins_of, sensors_of
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError, Wheel, wheel
from twinform.passes.plugins.world_systems import check_sensor_world, kind_of_sensor

_FRAMES = frozenset({
    "frameName", "frame_name", "robotBaseFrame", "robot_base_frame", "frame_id", "child_frame_id", "bodyName",
    "body_name",
})  # fmt: skip
"""Parameters that name a frame, which is mostly a link; frames of other nodes are as good."""
# How much of two names is the same where one is a typo of the other: a frame need not be a link, and
# libgazebo_ros_joint_trajectory.so is no typo of libgazebo_ros_joint_pose_trajectory.so.
_TYPO = 0.85
_FILE_TYPO = 0.93


def report_plugins(document: Document, sink: DiagnosticSink) -> None:
    """Report mistakes in plugins of gz-sim and of Gazebo Classic, whichever release they are for."""
    names = ModelNames()
    for plugin, site in plugins_of(document):
        if site.scope != "gui" and plugin.filename:
            _report_plugin(plugin, site, names, document, sink)
    if any(_is_for_gz(world) for world in document.worlds):
        for sensor, site in sensors_of(document):
            kind = kind_of_sensor(sensor, LATEST)
            if site.world and kind and _is_for_gz(site.world):
                check_sensor_world(sensor, kind, site.world, sink)


def _is_for_gz(world: World) -> bool:
    """Whether a world has a system of gz-sim: such a world has no others by default."""
    return any(systems_of_file(plugin.filename or "") for plugin in world.plugins)


def _report_plugin(
    plugin: Plugin, site: PluginSite, names: ModelNames, document: Document, sink: DiagnosticSink
) -> None:
    kinds = systems_of_file(plugin.filename or "")
    classic = classic_plugins_of_file(plugin.filename or "")
    if kinds:
        kind = find_class(plugin, kinds, sink)
        if kind:
            # Names in a world system may have scopes, and an include has a model that was not read.
            is_known = "world" not in kind.scopes and not site.included
            model = site.model if is_known else None
            check_parameters(plugin, ParameterContext(kind, None, model, names, sink))
    elif classic:
        kind = ros2_kind(plugin) or next(iter(classic.values()))
        _report_classic(plugin, kind, site, names, sink)
    else:
        _report_unknown_file(plugin, sink)
        return
    _report_ranges(plugin, sink)
    if site.model and kind and not site.included:
        _report_frames(plugin, site, names, sink)
        report_wheels(plugin, kind, site.model, document.format, sink)


def _report_classic(
    plugin: Plugin, kind: PluginKind, site: PluginSite, names: ModelNames, sink: DiagnosticSink
) -> None:
    """Report joints and links that the model lacks; what else a plugin of Classic does not read is harmless."""
    for element in plugin.content:
        row = kind.parameter(element.name)
        name = (element.text or "").strip()
        known = names.of(site.model, row.type) if site.model and row and row.type in {"joint", "link"} else None
        if row and known and name and name not in known and not _is_open(name):
            short = (plugin.filename or "").rpartition("/")[2]
            message = f"<{element.name}> of {short} names {name!r}, and the model has no such {row.type}"
            near = nearest_name(name, known)
            hint = f"did you mean {near!r}?" if near else None
            sink.report(rules.PLUGIN_REFERENCE, message, _place(element, plugin), found=name, help=hint)


def _report_frames(plugin: Plugin, site: PluginSite, names: ModelNames, sink: DiagnosticSink) -> None:
    """Report frames whose names are nearly those of links."""
    for element in plugin.content:
        name = (element.text or "").strip()
        if element.name not in _FRAMES or not name or _is_open(name) or site.model is None:
            continue
        known = names.of(site.model, "link")
        if not known or name in known:
            continue
        near = nearest_name(name, known, _TYPO)
        if near:
            message = f"<{element.name}> names the frame {name!r}; there is no such link, but there is {near!r}"
            hint = f"did you mean {near!r}?"
            if not sink.has(rules.PLUGIN_REFERENCE, _place(element, plugin)):
                sink.report(rules.PLUGIN_REFERENCE, message, _place(element, plugin), found=name, help=hint)


def _report_ranges(plugin: Plugin, sink: DiagnosticSink) -> None:
    """Report a parameter `min_...` that is above its `max_...`."""
    values = {each.name: each for each in plugin.content if each.name.startswith(("min_", "max_"))}
    for name, least in values.items():
        most = values.get(f"max_{name[4:]}")
        if name.startswith("min_") and most is not None and _is_above(least, most):
            message = f"<{name}> is {least.text}, which is above <{most.name}>, {most.text}"
            where = _place(least, plugin)
            sink.report(rules.INVERTED_RANGE, message, where, found=least.text, expected=f"at most {most.text}")


def _is_above(one: Element, other: Element) -> bool:
    try:
        return float(one.text or "") > float(other.text or "")
    except ValueError:
        return False


def _is_open(name: str) -> bool:
    """Whether a name is that of another model's part, or has a substitution that nobody has made."""
    return "::" in name or "$" in name or "/" in name


def _report_unknown_file(plugin: Plugin, sink: DiagnosticSink) -> None:
    """Report a file whose name is nearly that of a plugin of Gazebo; others are somebody's own."""
    file = modern_file(plugin.filename or "")
    if not file.startswith(("gz-sim-", "gazebo_ros_")):
        return
    near = nearest_name(file, known_files(), _FILE_TYPO)
    if near:
        written = near if near.startswith("gz-") else f"lib{near}.so"
        message = f"Gazebo has no plugin {plugin.filename!r}, but it has {written!r}"
        hint = f"did you mean {written}?"
        sink.report(rules.PLUGIN_NOT_IN_RELEASE, message, plugin.location, found=plugin.filename, help=hint)


def _place(element: Element, plugin: Plugin) -> Location:
    return element.location if element.source else plugin.location.at(element.name)


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
