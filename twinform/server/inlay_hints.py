"""Inlay hints: angles in degrees beside those in radians, and the parameters that a call of a macro leaves out."""

import math
from bisect import bisect_left
from collections.abc import Iterator

from lsprotocol import types

from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.server.completion.names import definitions_of
from twinform.server.documents import TextDocument
from twinform.server.names import Name, parameter_names
from twinform.server.schema import PREFIX
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

_TURNING = frozenset({"revolute", "continuous", "revolute2", "universal", "ball", "gearbox", "screw"})
_OF_JOINTS = frozenset({"lower", "upper", "soft_lower_limit", "soft_upper_limit", "initial_position"})
"""What is an angle for joints that turn, and a length for those that slide."""
_POSE = 6
_NUMBER = lazy_pattern(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_MOST_ARGUMENTS = 5


def inlay_hints(session: Session, document: TextDocument, where: types.Range) -> list[types.InlayHint]:
    """Return the hints in a range of a document."""
    piece = document.positions.span(where)
    nodes = document.tree.nodes
    first = bisect_left(nodes, piece.start, key=lambda node: node.start)
    has_calls = f"<{PREFIX}" in document.text
    macros = {each.text: each for each in definitions_of(session, document, "macro")} if has_calls else {}
    found: list[tuple[int, str]] = []
    for node in nodes[max(0, first - 1) :]:
        if node.start > piece.end:
            break
        found += _angles(document, node)
        macro = macros.get(node.tag.removeprefix(PREFIX)) if node.tag.startswith(PREFIX) and node.whole_tag else None
        found += _defaults(node, macro) if macro is not None else ()
    return [
        types.InlayHint(document.positions.position(offset), label, padding_left=True)
        for offset, label in found
        if piece.start <= offset <= piece.end
    ]


def _angles(document: TextDocument, node: TolerantNode) -> Iterator[tuple[int, str]]:
    """Yield the angles of an element in degrees, each behind its value."""
    for attribute, span in node.attributes.items():
        text = _in_degrees(_radians(document, node, attribute, node.values[attribute]))
        if text:
            yield span.whole.end, text
    if not node.children and node.closed and not node.empty:
        place = document.tree.text_of(node)
        text = _in_degrees(_radians(document, node, None, place.of(document.text)))
        if text:
            yield place.end, text


def _radians(document: TextDocument, node: TolerantNode, attribute: str | None, value: str) -> list[str]:
    """Return the numbers in a value that are angles in radians; none of a value with expressions."""
    row = document.schema.row(node, attribute)
    words = value.split()
    if row is None or not words or not all(_NUMBER.fullmatch(each) for each in words):
        return []
    name = row.fact.name.removeprefix("@")
    if name == "pose" and attribute is None and node.get("degrees") != "true":
        return words[3:] if len(words) == _POSE else []
    if name in _OF_JOINTS:
        return words if _joint_type(node) in _TURNING else []
    return words if row.fact.unit == "rad" else []


def _joint_type(node: TolerantNode) -> str | None:
    here: TolerantNode | None = node
    while here is not None and here.tag != "joint":
        here = here.parent
    return here.get("type") if here is not None else None


def _in_degrees(words: list[str]) -> str:
    angles = [math.degrees(float(each)) for each in words]
    if not any(angles) or not all(map(math.isfinite, angles)):
        return ""
    return " ".join(f"{each:.4g}°" for each in angles)


def _defaults(node: TolerantNode, macro: Name) -> Iterator[tuple[int, str]]:
    """Yield the parameters that a call of a macro leaves to their defaults, behind what it gives."""
    left = [
        each.written
        for each in parameter_names(macro.node)
        if not each.needed and not each.block and each.name not in node.attributes
    ]
    if left:
        more = ["…"] if len(left) > _MOST_ARGUMENTS else []
        ends = [Span(node.name.start, node.name.end), *(each.whole for each in node.attributes.values())]
        yield max(each.end for each in ends), " ".join(left[:_MOST_ARGUMENTS] + more)
