"""Dangling references to parts that were removed from a model."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import DROPPED_REFERENCE
from twinform.ir import Document, Element, GazeboExtension, Node, Plugin, walk
from twinform.ir.verify import verify


@dataclass(frozen=True, slots=True)
class RemovedNames:
    """The names of what was taken out, by kind; empty for what had none."""

    names: dict[str, set[str]] = field(default_factory=dict[str, set[str]])


def report_dangling(before: Document, after: Document, removed: RemovedNames, sink: DiagnosticSink) -> None:
    """Report which plugins name what is gone, and what is wrong now that was not before."""
    names = {name for each in removed.names.values() for name in each if name} - set(_names(after))
    for element, where in _parameters(after):
        for word in (element.text, *(value for _, value in element.attributes)):
            name = (word or "").strip().rpartition("::")[2]
            if name in names:
                message = f"<{element.name}> of a plugin names {name!r}, which was removed"
                sink.report(DROPPED_REFERENCE, message, where, found=name)
    old, new = DiagnosticSink(sink.file, sink.strict), DiagnosticSink(sink.file, sink.strict)
    verify(before, old)
    verify(after, new)
    # Both documents are verified, so that whatever refers to what is gone is found without a list
    # of such references here.
    known = {(each.rule.name, each.location) for each in old.diagnostics}
    sink.extend_new(each for each in new.diagnostics if (each.rule.name, each.location) not in known)


def _names(document: Document) -> Iterator[str]:
    """All names that are left."""
    for node in walk(document):
        name = getattr(node, "name", None)
        if isinstance(name, str):
            yield name
        if isinstance(node, GazeboExtension):
            yield from (element.get("name") or "" for each in node.content for element in each.walk())


def _parameters(document: Document) -> Iterator[tuple[Element, Location]]:
    """Every parameter of every plugin, and where it or its plugin stands."""
    for node in walk(document):
        for plugin, content in _plugins(node):
            for each in content:
                for element in each.walk():
                    yield element, element.location if element.source else plugin


def _plugins(node: Node) -> Iterator[tuple[Location, tuple[Element, ...]]]:
    if isinstance(node, Plugin):
        yield node.location, node.content
    if isinstance(node, GazeboExtension):
        for each in node.content:
            for element in each.walk():
                if element.name == "plugin":
                    yield (element.location if element.source else node.location), element.children
