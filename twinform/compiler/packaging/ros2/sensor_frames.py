"""The frames of sensors: whether tf knows those that their messages are in."""

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import ros2 as rules
from twinform.ir import Document, Sensor
from twinform.passes.plugins.catalog import release
from twinform.passes.plugins.sites import sensors_of
from twinform.passes.plugins.worlds import kind_of_sensor

_PLACED = ", or another link that is where the sensor is"
_FRAMES = frozenset({"frame_id", "gz_frame_id", "ignition_frame_id"})


def report_frames(document: Document, gazebo: str, sink: DiagnosticSink) -> None:
    """Report each sensor that Gazebo simulates and that names no frame."""
    for sensor, site in sensors_of(document):
        if kind_of_sensor(sensor, gazebo) is None or _has_frame(sensor) or site.model is None:
            continue
        frame = "/".join(filter(None, (site.model.name, site.link_or_joint, sensor.name)))
        message = f"messages of sensor {sensor.name!r} are in the frame {frame!r}, which tf does not have"
        element = release(gazebo).frame_element
        help_ = f"write <{element}>{site.link_or_joint}</{element}> into it{_PLACED if sensor.pose else ''}"
        sink.report(rules.FRAME_NOT_IN_TF, message, sensor.location, found=frame, help=help_)


def _has_frame(sensor: Sensor) -> bool:
    return bool(sensor.frame_id) or any(part.element and part.element.name in _FRAMES for part in sensor.opaque)
