"""Names: there is one of each in its scope, and none that the format keeps for itself."""

from collections.abc import Iterable

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir.document import Document
from twinform.ir.node import Node
from twinform.ir.scoped_elements import scoped_elements, scoped_parts_below

Kinds = Iterable[tuple[str, Iterable[Node]]]
"""What shares a scope: the word for a kind, and the nodes of that kind."""

_NEED_NAMES = frozenset({"world", "link", "joint", "model", "frame", "visual", "collision", "sensor", "light"})


def name_of(node: Node) -> str:
    """The name of a node that has one."""
    return str(getattr(node, "name", None))


def report_names(kind: str, nodes: Iterable[Node], sink: DiagnosticSink) -> None:
    """Report names that are empty or blank, cannot be printed, or are there twice."""
    seen: dict[str, Node] = {}
    for node in nodes:
        name = name_of(node)
        if not name.strip() and kind in _NEED_NAMES:
            sink.report(rules.EMPTY_NAME, f"a {kind} has an empty name", node.location)
        report_unprintable(kind, node, sink)
        if name in seen:
            message = f"{kind} {name!r} is defined twice"
            sink.report(rules.DUPLICATE_NAME, message, node.location, found=name, related=(seen[name].location,))
        seen.setdefault(name, node)


def report_unprintable(kind: str, node: Node, sink: DiagnosticSink) -> None:
    """Report a name with a character that nobody can see."""
    name: str | None = getattr(node, "name", None)
    if name is not None and not name.isprintable():
        message = f"{kind} {name!r} has characters in its name that cannot be seen"
        sink.report(rules.UNPRINTABLE_NAME, message, node.location, found=name)


def report_scope(kinds: Kinds, shared: Severity, sink: DiagnosticSink) -> None:
    """Report names that several kinds of one scope share, beside what is wrong within each kind."""
    owners: dict[str, tuple[str, Node]] = {}
    for kind, nodes in kinds:
        named = [node for node in nodes if getattr(node, "name", None) is not None]
        report_names(kind, named, sink)
        for node in named:
            name = name_of(node)
            other, first = owners.setdefault(name, (kind, node))
            if other != kind:
                message = f"{kind} {name!r} has the name of a {other}"
                related = (first.location,)
                sink.report(rules.SHARED_NAME, message, node.location, found=name, related=related, severity=shared)


def report_reserved(kinds: Kinds, severity: Severity, sink: DiagnosticSink, *, scoped: bool) -> None:
    """Report names that SDF keeps for itself; where `scoped`, also those with `::`, which stands between scopes.

    Where they are not, `::` is part of a name and stands between two others.
    """
    for kind, nodes in kinds:
        for node in nodes:
            name: str | None = getattr(node, "name", None)
            if name is None or not (name == "world" or "__" in name or "::" in name):
                continue
            where = node.location.at("@name")
            if name == "world" or (name.startswith("__") and name.endswith("__")):
                message = f"{kind} {name!r} has a name that SDF keeps for itself"
            elif scoped and "::" in name:
                message = f"{kind} {name!r} has '::' in its name, which stands between a model and what is in it"
            elif not all(part.strip() for part in name.split("::")):
                message = f"{kind} {name!r} has nothing on one side of '::', where a name belongs"
                sink.report(rules.RESERVED_NAME, message, where, found=name, severity=Severity.WARNING)
                continue
            else:
                continue
            sink.report(rules.RESERVED_NAME, message, where, found=name, severity=severity)


def report_scoped_elements(document: Document, sink: DiagnosticSink) -> None:
    """Report elements that SDF does not know and that have `::` in their names: libsdformat looks at these, too."""
    for part in scoped_parts_below(document):
        for element in scoped_elements(part.element) if part.element else ():
            name = element.get("name")
            message = f"<{element.name}> {name!r} has '::' in its name; libsdformat refuses the file for it"
            sink.report(rules.RESERVED_NAME, message, part.location, found=name, severity=Severity.ERROR)
