"""What Gazebo does not apply of the `<gazebo>` tags of URDF, since it goes by the names of shapes."""

from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import RENAMED_COLLISION, UNTAGGED_SHAPE
from twinform.ir import Element, Format, Model
from twinform.passes.structure.tag_shapes import wrongly_tagged
from twinform.passes.structure.tagged_shapes import KINDS, seen_shapes
from twinform.profiles.subject import ProfiledFile


def find_lost_tags(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report shapes that Gazebo tags otherwise than the file does, and names in contact sensors that it changes."""
    document = subject.document
    for model in document.models if document is not None and document.format is Format.URDF else ():
        if model.extensions:
            for field in KINDS:
                _find_shapes(model, field, sink)
            _find_sensors(model, sink)


def _find_shapes(model: Model, field: str, sink: DiagnosticSink) -> None:
    for seen, found, name in wrongly_tagged(model, field):
        shape = f"{KINDS[field]} {seen.shape.name!r}" if seen.shape.name else f"a {KINDS[field]} without a name"
        what = f"the tags of {', '.join(map(repr, sorted(found)))}" if found else "none of the tags of its link"
        message = f"{shape} of link {seen.link!r} is {seen.name!r} to Gazebo, which applies {what} to it"
        hint = f"call it {name!r}" if name else None
        sink.report(UNTAGGED_SHAPE, message, seen.shape.location, found=seen.shape.name, help=hint)


def _find_sensors(model: Model, sink: DiagnosticSink) -> None:
    named = {(seen.link, seen.shape.name): seen.name for seen in seen_shapes(model, "collisions") if seen.shape.name}
    theirs = set(named.values())
    for link, sensor, collision in _contacts(model):
        text = (collision.text or "").strip()
        called = named.get((link, text))
        if called is not None and text not in theirs:
            message = f"contact sensor {sensor.get('name')!r} names collision {text!r}, which is {called!r} to Gazebo"
            sink.report(RENAMED_COLLISION, message, collision.location, found=text, help=f"write {called!r}")


def _contacts(model: Model) -> Iterator[tuple[str, Element, Element]]:
    """The links of contact sensors, these, and every name of a collision in them."""
    for extension in model.extensions:
        for sensor in (each for each in extension.content if each.name == "sensor"):
            contact = sensor.find("contact")
            for collision in contact.children if contact is not None else ():
                if collision.name == "collision":
                    yield extension.reference or "", sensor, collision
