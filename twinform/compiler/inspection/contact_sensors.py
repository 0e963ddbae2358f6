"""Contact sensors in the `<gazebo>` elements of URDF that name a collision which is not there."""

from twinform.diagnostics import DiagnosticSink, did_you_mean
from twinform.diagnostics.rules import UNKNOWN_COLLISION
from twinform.ir import Document, Element, Format, Model
from twinform.passes.carriers.lumped_names import mentions_collisions

_DEFAULT = "__default__"
"""What SDF takes for the name of a collision that is not written."""


def report_contact_sensors(document: Document, sink: DiagnosticSink) -> None:
    """Report names that neither we nor libsdformat give to a collision; in SDF, verifying has looked."""
    for model in document.models if document.format is Format.URDF else ():
        if mentions_collisions(model):
            _report(model, sink)


def _report(model: Model, sink: DiagnosticSink) -> None:
    from twinform.passes.legalise.to_sdf.follow_lumped_names import (  # noqa: PLC0415 - few robots have such sensors
        names_of_libsdformat,
        own_collisions,
    )

    own = {each.name for each in own_collisions(model).values()}
    known = own | names_of_libsdformat(model).keys() | {_DEFAULT}
    for sensor in (one for each in model.extensions for part in each.content for one in part.walk()):
        contact = sensor.find("contact") if sensor.name == "sensor" and sensor.get("type") == "contact" else None
        for collision in contact.children if contact is not None else ():
            name = (collision.text or "").strip()
            if collision.name == "collision" and name and name.rpartition("::")[2] not in known and "$" not in name:
                _report_one(sensor, collision, name, own, sink)


def _report_one(sensor: Element, collision: Element, name: str, own: set[str], sink: DiagnosticSink) -> None:
    message = f"contact sensor {sensor.get('name')!r} names the collision {name!r}, which does not exist"
    hint = did_you_mean(name.rpartition("::")[2], own)
    sink.report(UNKNOWN_COLLISION, message, collision.location, found=name, help=hint)
