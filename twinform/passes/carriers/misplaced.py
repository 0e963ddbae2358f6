"""Carriers and annotations that stand where no conversion puts any, as somebody copied them there: dropping them."""

from collections.abc import Iterator
from functools import cache, partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import OPAQUE, Frame, Model, Node, Opaque, Pose, replace_fields, rewrite
from twinform.passes.carriers.absorb import definition_of
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, is_carrier, is_memory, is_ours
from twinform.passes.carriers.sdf_versions import carried, condition_of, is_version_carrier
from twinform.passes.framework.pass_base import ModelPass
from twinform.schemas import Fact, node_class, table

AnyNode = TypeVar("AnyNode", bound=Node)


def without_misplaced(node: AnyNode, sink: DiagnosticSink) -> AnyNode:
    """Remove the misplaced carriers and annotations of a node and of all nodes in it, with a warning for each."""
    return rewrite(node, Node, partial(_without_misplaced, sink), having=OPAQUE)


def _without_misplaced(sink: DiagnosticSink, node: Node) -> Node:
    if not node.opaque:
        return node
    kept: list[Opaque] = []
    for part in node.opaque:
        if not is_misplaced(part, node):
            kept.append(part)
            continue
        message = f"{part.name.replace(f'{{{NAMESPACE}}}', f'{PREFIX}:')} means nothing where it stands, and is dropped"
        where = part.location_in(node)
        sink.account(Fate.DROPPED, STALE_CARRIER, message, where, part.weight)
        sink.report(STALE_CARRIER, message, where, found=part.name)
    return replace_fields(node, opaque=tuple(kept))


def is_misplaced(part: Opaque, node: Node) -> bool:
    """Tell whether an opaque part of a node is a carrier or annotation that means nothing there.

    No conversion puts one into an element that is a value of the node, such as `<izz>`, or into a pose. Everywhere else
    its path has to lead to something that the format, for carriers of versions some version of SDF, has in the node.
    """
    if not is_ours(part) or part.element is None or is_memory(part):
        return False
    if part.at or isinstance(node, Pose):
        return True
    at = part.element.get("at") or ""
    if is_carrier(part, "urdf"):
        fact = _urdf_facts().get(type(node))
        return bool(at) and not isinstance(node, Frame) and (fact is None or _row("urdf", fact, at) is None)
    fact = table("sdf").definitions.get(definition_of(node) or "")
    if is_version_carrier(part):
        return not _is_of_sdf(part, fact, at) or bool(condition_of(part).instead and not isinstance(node, Model))
    return is_carrier(part, "sdf") and bool(at) and (fact is None or _row("sdf", fact, at) is None)


def _is_of_sdf(part: Opaque, fact: Fact | None, at: str) -> bool:
    """Tell whether some version of SDF has everything that a carrier holds at its path in an element."""
    holder = _row("sdf", fact, at) if fact else None
    names = {f"@{piece.attribute[0]}" if piece.attribute else piece.name.strip("<>") for piece in carried(part)}
    return holder is not None and (holder.any or names <= {row.name for row in table("sdf").resolve(holder).rows})


def _row(format: str, fact: Fact, path: str) -> Fact | None:
    """Find the row of the element at a path inside another; an empty path leads to the outer one."""
    found: Fact | None = fact
    for step in filter(None, path.split("/")):
        rows = table(format).resolve(found).children if found else ()
        found = next((row for row in rows if row.name == step), None)
    return found


@cache
def _urdf_facts() -> dict[type[Node], Fact]:
    """Map each class of nodes to the fact that lists what URDF has in its element."""
    facts = table("urdf")
    found: dict[type[Node], Fact] = {}
    for kind, fact in _classes_in(Model, facts.definitions[facts.root]):
        found.setdefault(kind, fact)
    return found


def _classes_in(kind: type[Node], fact: Fact) -> Iterator[tuple[type[Node], Fact]]:
    yield kind, fact
    for row in fact.children:
        inner = table("urdf").resolve(row)
        if row.place == ".":
            yield from ((each, rows) for each, rows in _classes_in(kind, inner) if each is not kind)
        elif row.place and not fact.any:
            outer, _, field = row.place.rpartition(".")
            holder = node_class(kind, outer) if outer else kind
            yield from _classes_in(node_class(holder, field, row.kind), inner)


class DropMisplaced(ModelPass):
    """Drop the carriers and annotations that stand where no conversion puts them.

    Changes: a carrier inside a number or a pose goes, and so does one about an element that cannot be where it stands.
    An edit copied it there; unpacked, it would become content that nobody wrote.
    Never touches: other carriers. The passes that unpack them find out whether they still match the file.
    Diagnostics: `stale-carrier` for each.
    """

    name: ClassVar[str] = "drop-misplaced"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with carriers only where they mean something."""
        return without_misplaced(model, sink)
