"""What a model has from Gazebo Classic that Gazebo since Fortress does not load, simulate or keep as it is."""

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import LOOSENED_FIXED_JOINT, PLUGIN_NOT_IN_RELEASE, UNSUPPORTED_SENSOR
from twinform.ir import Document, Format, Model
from twinform.passes.plugins.catalog import releases
from twinform.passes.plugins.check_plugins import is_classic
from twinform.passes.plugins.sites import plugins_of, sensors_of
from twinform.passes.plugins.world_systems import kind_of_sensor
from twinform.passes.shared.gazebo_tags import LUMPS_WITHOUT, PRESERVES, TRUE, value_text


def report_classic_parts(document: Document, sink: DiagnosticSink) -> None:
    """Report plugins of Gazebo Classic, and sensors that the newest release of Gazebo does not simulate."""
    for plugin, _ in plugins_of(document):
        if plugin.filename and is_classic(plugin.filename):
            message = f"{plugin.filename} is a plugin of Gazebo Classic"
            help_ = "--passes migrate-gazebo-classic writes those of gz-sim instead"
            sink.report(PLUGIN_NOT_IN_RELEASE, message, plugin.location, found=plugin.filename, help=help_)
    newest = [*releases()][-1]
    for sensor, _ in sensors_of(document):
        if sensor.type not in {None, "custom"} and kind_of_sensor(sensor, newest) is None:
            message = f"sensor {sensor.name!r} is a {sensor.type}, which Gazebo does not simulate"
            help_ = (
                "--passes migrate-gazebo-classic writes the type that it has instead" if sensor.type == "ray" else None
            )
            sink.report(UNSUPPORTED_SENSOR, message, sensor.location, found=sensor.type, help=help_)


def report_loosened_joints(document: Document, sink: DiagnosticSink) -> None:
    """Report fixed joints of URDF that libsdformat makes revolute because they must not be lumped."""
    for model in document.models if document.format is Format.URDF else ():
        _report_loosened(model, sink)


def _report_loosened(model: Model, sink: DiagnosticSink) -> None:
    fixed = {joint.name for joint in model.joints if joint.type == "fixed"}
    for block in model.extensions:
        asked = {each.name: each for each in block.content if value_text(each).lower() in TRUE}
        flag = asked.get(LUMPS_WITHOUT)
        if flag is not None and PRESERVES not in asked and block.reference in fixed:
            message = (
                f"<{LUMPS_WITHOUT}> makes the fixed joint {block.reference!r} a revolute one in Gazebo, from 0 to 0"
            )
            help_ = f"write <{PRESERVES}>true</{PRESERVES}>, which keeps it fixed"
            sink.report(LOOSENED_FIXED_JOINT, message, flag.location, found=LUMPS_WITHOUT, help=help_)
