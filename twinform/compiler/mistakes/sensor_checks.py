"""Checks of sensors: ranges the wrong way round, degrees, topics and names that two of them have, rates of 0."""

import math

from twinform.compiler.mistakes.value_checks import number_of, place_of, tag_of, text_of
from twinform.diagnostics import DiagnosticSink, Severity, did_you_mean, rules
from twinform.schemas import XmlElement

_HOLDERS = frozenset({"link", "joint", "gazebo"})
_RANGES = (
    ("horizontal", "min_angle", "max_angle"),
    ("vertical", "min_angle", "max_angle"),
    ("range", "min", "max"),
    ("clip", "near", "far"),
)
_MOST = math.tau + 0.01
"""A whole turn, rad, as files round it."""
_RENDERED = frozenset({"camera", "depth", "depth_camera", "rgbd_camera", "gpu_lidar", "gpu_ray", "ray", "lidar"})
"""Types of which each update takes long."""


def report_sensors(tree: XmlElement, sink: DiagnosticSink) -> None:
    """Report what is wrong with the sensors of a file, in URDF those of `<gazebo>`."""
    sensors = [each for each in tree.iter("sensor") if tag_of(each.getparent()) in _HOLDERS]
    if not sensors:
        return
    topics: dict[tuple[XmlElement | None, str], XmlElement] = {}
    names: dict[tuple[object, str], XmlElement] = {}
    frames: set[str] = set()
    for sensor in sensors:
        _report_ranges(sensor, sink)
        _report_rate(sensor, sink)
        _report_topic(sensor, topics, sink)
        _report_name(sensor, names, sink)
        frame = sensor.find("gz_frame_id")
        frame = sensor.find("ignition_frame_id") if frame is None else frame
        if frame is not None:
            frames = frames or {each.get("name") or "" for each in tree.iter("link", "joint", "frame")}
            _report_frame(sensor, frame, frames, sink)


def _report_ranges(sensor: XmlElement, sink: DiagnosticSink) -> None:
    for holder, low, high in _RANGES:
        for each in sensor.iter(holder):
            least, most = number_of(each.find(low)), number_of(each.find(high))
            angles = [value for value in (least, most) if value is not None and abs(value) > _MOST]
            if low == "min_angle" and angles:
                _report_degrees(sensor, each, angles, sink)
            elif least is not None and most is not None and (least > most or (least == most and holder == "clip")):
                message = (
                    f"sensor {sensor.get('name')!r} has <{low}> {least:g}, which is not below its <{high}>, {most:g}"
                )
                hint = f"exchange <{low}> and <{high}>" if least > most else None
                sink.report(
                    rules.INVERTED_RANGE,
                    message,
                    place_of(each),
                    found=f"{least:g}",
                    expected=f"less than {most:g}",
                    help=hint,
                )


def _report_degrees(sensor: XmlElement, holder: XmlElement, angles: list[float], sink: DiagnosticSink) -> None:
    most = max(angles, key=abs)
    at = next(
        each for each in holder.iter("min_angle", "max_angle") if number_of(each) == most or number_of(each) in angles
    )
    value = number_of(at) or 0.0
    message = (
        f"<{tag_of(at)}> of sensor {sensor.get('name')!r} is {value:g} radians, more than a turn; are these degrees?"
    )
    hint = f"write {math.radians(value):.6g} radians"
    sink.report(
        rules.ANGLE_IN_DEGREES, message, place_of(at), found=f"{value:g}", expected=f"at most {math.tau:.4g}", help=hint
    )


def _report_rate(sensor: XmlElement, sink: DiagnosticSink) -> None:
    rate = sensor.find("update_rate")
    if number_of(rate) == 0 and rate is not None:
        is_slow = sensor.get("type") in _RENDERED
        message = f"sensor {sensor.get('name')!r} has an update_rate of 0: it measures in every step of the simulation"
        hint = "write the rate of the real sensor, in Hz"
        severity = None if is_slow else Severity.INFO
        sink.report(rules.ZERO_UPDATE_RATE, message, place_of(rate), found="0", help=hint, severity=severity)


def _report_topic(
    sensor: XmlElement, topics: dict[tuple[XmlElement | None, str], XmlElement], sink: DiagnosticSink
) -> None:
    at = sensor.find("topic")
    topic = text_of(at)
    if at is None or not topic or "$" in topic or topic == "__default__" or sensor.get("type") == "contact":
        return
    # Relative topics of two models of a world are two topics, and Gazebo Classic has another use for them.
    holder = next((each for each in sensor.iterancestors("model", "robot")), None)
    other = topics.setdefault((holder, topic.lstrip("/")), sensor)
    if other is not sensor:
        message = f"sensor {sensor.get('name')!r} publishes to {topic!r}, as does sensor {other.get('name')!r}"
        hint = "give each sensor a topic of its own"
        sink.report(rules.SHARED_TOPIC, message, place_of(at), found=topic, help=hint, related=(place_of(other),))


def _report_name(sensor: XmlElement, names: dict[tuple[object, str], XmlElement], sink: DiagnosticSink) -> None:
    """Report names twice in one link of URDF; those of SDF are verified when it is read."""
    holder = sensor.getparent()
    if holder is None or tag_of(holder) != "gazebo":
        return
    name = sensor.get("name") or ""
    other = names.setdefault((holder.get("reference"), name), sensor)
    if other is not sensor:
        message = f"{holder.get('reference')!r} has two sensors of the name {name!r}; Gazebo refuses the second"
        sink.report(
            rules.DUPLICATE_NAME,
            message,
            place_of(sensor),
            found=name,
            related=(place_of(other),),
            severity=Severity.WARNING,
        )


def _report_frame(sensor: XmlElement, frame: XmlElement, known: set[str], sink: DiagnosticSink) -> None:
    name = text_of(frame)
    own = name.rpartition("/")[2].rpartition("::")[2]
    if not own or own in known or "$" in name or own == sensor.get("name"):
        return
    message = f"sensor {sensor.get('name')!r} measures in the frame {name!r}, and no link, joint or frame has that name"
    sink.report(rules.UNKNOWN_SENSOR_FRAME, message, place_of(frame), found=name, help=did_you_mean(own, known))
