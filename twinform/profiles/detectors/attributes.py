"""Attributes that libsdformat does not take, whatever element has them."""

from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import EMPTY_ATTRIBUTE
from twinform.profiles.subject import ProfiledFile
from twinform.schemas import XmlElement, path_of


def find_empty_attributes(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report attributes of other namespaces without a value; elements of others, and plugins, are only copied."""
    waiting = [subject.tree] if subject.tree is not None and subject.tree.tag == "sdf" else []
    while waiting:
        element = waiting.pop()
        for name in (str(name) for name, value in element.attrib.items() if not value):
            # libsdformat prints an error for an empty attribute that it does not know.
            if name.startswith("{"):
                place = Location(line=element.sourceline or 0, path=path_of(element))
                message = f"<{element.tag}> has an attribute {name.partition('}')[2]!r} without a value"
                sink.report(EMPTY_ATTRIBUTE, message, place)
        waiting += filter(_is_read, element)


def _is_read(element: XmlElement) -> bool:
    return isinstance(element.tag, str) and not element.tag.startswith("{") and element.tag != "plugin"
