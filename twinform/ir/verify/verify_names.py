"""Verifies names: there is one of each in its scope, and none that the format keeps for itself."""

from collections.abc import Iterable
from typing import Literal

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir.document import Document, World
from twinform.ir.model import Include, Model
from twinform.ir.node import Node
from twinform.ir.scopes import scoped_elements, scoped_parts_below

Kinds = Iterable[tuple[str, Iterable[Node]]]
"""What shares a scope: the word for a kind, and the nodes of that kind."""

_NEED_NAMES = frozenset({"world", "link", "joint", "model", "frame", "visual", "collision", "sensor", "light"})


def name_of(node: Node) -> str:
    """The name of a node that has one."""
    return str(getattr(node, "name", None))


def report_names(kind: str, nodes: Iterable[Node], sink: DiagnosticSink) -> None:
    """Report names that are empty, blank, unprintable or not unique."""
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
    """Report names that several kinds of one scope share, and the faults within each kind."""
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
                message = f"{kind} {name!r} has an empty name before or behind '::'"
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


Found = Literal["link", "joint", "frame", "model", "unread", "twice"]
"""What a name stands for; `unread` where only the file of an include knows, `twice` where it means two things."""


class VerifiedScope:
    """One model or world. Names of what is in a nested model are written `model::name`, and so on inwards."""

    def __init__(self, holder: Model | World) -> None:
        self._kinds: dict[str, Found] = {}
        links = holder.links if isinstance(holder, Model) else ()
        self._add("link", links)
        self._add("joint", holder.joints)
        self._add("frame", holder.frames)
        self._add("model", holder.models)
        self._models = {model.name: model for model in holder.models}
        self._inner: dict[str, VerifiedScope] = {}
        self._unread = self._include(holder.includes)
        self._longest = max((len(name or "") for name in self._kinds), default=0)

    def _add(self, kind: Found, nodes: Iterable[Node]) -> None:
        for node in nodes:
            name = name_of(node)
            self._kinds[name] = "twice" if name in self._kinds else kind

    def _include(self, includes: Iterable[Include]) -> bool:
        """Enter the includes with a name; returns whether others remain, whose names only their files know."""
        unread = False
        for include in includes:
            if include.name is None or include.merge:
                unread = True
            else:
                self._kinds.setdefault(include.name, "model")
        return unread

    def names(self, *kinds: Found) -> Iterable[str]:
        """The names of these kinds, or of all, without those in nested models."""
        return (name for name, kind in self._kinds.items() if kind in kinds) if kinds else self._kinds

    def find(self, name: str) -> Found | None:
        """Return what a name stands for here; None for nothing."""
        here = self._kinds.get(name)
        if here is not None:
            return here
        outer, colons, inner = name.partition("::")
        while colons and len(outer) <= self._longest:
            found = self._find_in(outer, inner)
            if found is not None:
                return found
            more, colons, inner = inner.partition("::")  # before 1.8 names may have `::` in them
            outer = f"{outer}::{more}"
        return "unread" if self._unread else None

    def _find_in(self, outer: str, inner: str) -> Found | None:
        if outer not in self._models:
            return "unread" if self._kinds.get(outer) == "model" else None
        if inner == "__model__":
            return "model"
        if outer not in self._inner:
            self._inner[outer] = VerifiedScope(self._models[outer])
        return self._inner[outer].find(inner)
