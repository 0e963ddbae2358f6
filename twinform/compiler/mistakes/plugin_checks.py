"""Checks of plugins by what the catalog knows of them: files, classes, parameters, and names of joints and links.

What only a release of Gazebo can tell is left to the pass `check-plugins`: a repository for Gazebo Classic is right.
"""

from twinform.compiler.mistakes.wheel_checks import report_wheels
from twinform.diagnostics import DiagnosticSink, Location, nearest_name, rules
from twinform.ir import Document, Element, Plugin, World
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
