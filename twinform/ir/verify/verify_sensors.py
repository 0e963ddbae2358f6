"""Verifies sensors and grippers of SDF: their types, and references to what is not there."""

from collections.abc import Callable, Iterator

from twinform.diagnostics import DiagnosticSink, did_you_mean, rules
from twinform.ir.element import Opaque
from twinform.ir.link import Link
from twinform.ir.model import Model
from twinform.ir.scopes import nested_includes, scoped_links
from twinform.ir.sensor import SENSOR_ELEMENTS, Sensor

_PARAMETERS = frozenset[str]().union(*SENSOR_ELEMENTS.values())
_DEFAULT = "__default__"
"""What SDF takes for the name of a collision that is not written."""


def verify_sensors(link: Link, model: Model, sink: DiagnosticSink) -> None:
    """Report sensors of a link whose parameters are not those of their type."""
    for sensor in link.sensors:
        _verify_content(sensor, sink)
        if sensor.type == "force_torque":
            message = f"sensor {sensor.name!r} belongs in a joint, whose force it measures; it is on link {link.name!r}"
            sink.report(rules.MISPLACED_SENSOR, message, sensor.location, found="force_torque")
        if sensor.type == "contact":
            _verify_contact(sensor, model, sink)


def verify_joint_sensors(model: Model, sink: DiagnosticSink) -> None:
    """Report what is wrong with the content of sensors on joints."""
    for joint in model.joints:
        for sensor in joint.sensors:
            _verify_content(sensor, sink)


def _verify_content(sensor: Sensor, sink: DiagnosticSink) -> None:
    allowed = SENSOR_ELEMENTS.get(sensor.type or "")
    if allowed is None:
        return
    for part in sensor.opaque:
        name = part.element.name if part.element and not part.at else ""
        if name in _PARAMETERS and name not in allowed:
            message = f"sensor {sensor.name!r} is of the type {sensor.type!r} and has <{name}>"
            expected = " or ".join(f"<{one}>" for one in sorted(allowed))
            sink.report(rules.SENSOR_MISMATCH, message, part.location, found=f"<{name}>", expected=expected)


def _verify_contact(sensor: Sensor, model: Model, sink: DiagnosticSink) -> None:
    known: set[str] | None = None
    for part, step, name in _texts(sensor.opaque, "contact", "collision"):
        if known is None:
            known = {one.name or "" for _, link in scoped_links(model) for one in link.collisions}
        if name.rpartition("::")[2] not in known and name != _DEFAULT and not any(nested_includes(model)):
            message = f"contact sensor {sensor.name!r} names the collision {name!r}, which does not exist"
            hint = did_you_mean(name.rpartition("::")[2], known)
            sink.report(rules.UNKNOWN_COLLISION, message, part.location.at(step), found=name, help=hint)


def verify_grippers(model: Model, is_link: Callable[[str], bool], sink: DiagnosticSink) -> None:
    """Report grippers whose links do not exist."""
    for word in ("gripper_link", "palm_link"):
        for part, step, name in _texts(model.opaque, "gripper", word):
            if not is_link(name):
                message = f"<{word}> of a gripper names {name!r}, but model {model.name!r} has no such link"
                hint = did_you_mean(name, (link.name for link in model.links))
                sink.report(rules.UNKNOWN_GRIPPER_LINK, message, part.location.at(step), found=name, help=hint)


def _texts(parts: tuple[Opaque, ...], outer: str, inner: str) -> Iterator[tuple[Opaque, str, str]]:
    """The texts of the `inner` children of the parts that are an `outer` element, and the step to each."""
    for part in parts:
        if part.element and part.element.name == outer:
            found = [child.text or "" for child in part.element.children if child.name == inner]
            for place, text in enumerate(found, 1):
                yield part, f"{inner}[{place}]" if len(found) > 1 else inner, text
