"""Joints that close loops, in place of the constraints of MJCF that do: they come back while these hold the same links.

A hinge that closes a loop is two points at which bodies are held together. What a carrier has of it is the whole joint.
"""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Joint, Model, Opaque
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.mjcf_texts import LOOP
from twinform.passes.carriers.partial_nodes import REST, WRITTEN, written_names
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT
from twinform.schemas import XmlElement

Ends = tuple[str | None, str | None]


class LoopsBack(NamedTuple):
    """A model with the joints that closed loops, and the names of the constraints that these stand for."""

    model: Model
    names: frozenset[str]


def is_loop(partial: Joint) -> bool:
    """Whether a partial joint closed a loop."""
    return find_annotation(partial, LOOP) is not None


def loops_back(
    model: Model, loops: Iterable[Joint], links: Mapping[str, str], root: XmlElement, sink: DiagnosticSink
) -> LoopsBack:
    """Put joints that closed loops in place of the constraints that do, if these still do.

    `links` has the names of links by those of bodies.
    """
    loops = tuple(loops)
    if not loops:
        return LoopsBack(model, frozenset())
    joints, beside = {each.name: each for each in model.joints}, _held_together(root, links)
    opened: set[str] = set()
    closed: list[Joint] = []
    for partial in loops:
        names = written_names(partial)
        parts = [joints[each] for each in names if each in joints]
        ends: list[Ends] = [(each.parent, each.child) for each in parts]
        ends += [beside[each] for each in names if each in beside] if not ends else ()
        if len(ends) != len(names) or set(ends) != {(partial.parent, partial.child)}:
            message = f"the loop that joint {partial.name!r} closed is another one now"
            report_stale(sink, message, partial.source)
            continue
        opened.update(names)
        bare = without_annotation(partial, LOOP, REST, WRITTEN)
        closed.append(bare.copy(opaque=(*bare.opaque, *_kept(parts))))
    left = (each for each in model.joints if each.name not in opened)
    return LoopsBack(model.copy(joints=(*left, *closed)), frozenset(opened))


def _held_together(root: XmlElement, links: Mapping[str, str]) -> Mapping[str, Ends]:
    """The links that each equality holds together, by its name: bodies of several trees have no joint for it."""
    found = ((each.get("name"), each.get("body1"), each.get("body2")) for each in root.iterfind("equality/*"))
    return {name: (links.get(one or "", one), links.get(other or "", other)) for name, one, other in found if name}


def _kept(parts: Iterable[Joint]) -> Iterable[Opaque]:
    """What only MJCF says of the first of the constraints, which are alike."""
    first = next(iter(parts), None)
    opaque = first.opaque if first is not None else ()
    return (part for part in opaque if part.element is not None and part.element.name == KEPT)
