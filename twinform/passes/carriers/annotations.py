"""Annotations: elements of our namespace that record how the source wrote a part that the target writes differently.

An annotation never repeats what the target states; it holds the rest, so that it stays true when the other part is
edited:

    <tf:made/>                                   a conversion made this link, joint or frame up
    <tf:from format="sdf" version="1.9"/>        in a model: what it was converted from
    <tf:offset xyz="0 0 0.1" rpy="0 0 0"/>       the frame that the source had, in the frame that stands here
    <tf:pose relative_to="base"/>                the frame, and the notation, in which the source wrote this pose
    <tf:axis expressed_in="base"/>               the frame in which the source wrote this axis
    <tf:extension/>                              the source has this joint in a `<gazebo>` element
    <tf:reversed/>                               parent and child of this joint were exchanged, and its axis turned

Other annotations stand beside what uses them: `joint_chains.py`, `to_sdf/shared_materials.py` and so on. They are
elements and never attributes: other readers skip foreign elements, and some fail on foreign attributes.
"""

from collections.abc import Mapping
from typing import TypeVar

from twinform.ir import Element, Node, Opaque, rewrite
from twinform.passes.carriers.carriers import NAMESPACE, bits_of_ours

AnyNode = TypeVar("AnyNode", bound=Node)

EXTENSION = "extension"
"""The annotation on a joint of SDF that URDF has in a `<gazebo>` element."""
REVERSED = "reversed"
"""The annotation on a joint of URDF whose parent is its child in SDF."""
SYNTHESIZED = "made"
"""The annotation on a link, joint or frame that was not in the source."""


def annotation(kind: str, text: str | None = None, attributes: Mapping[str, str | None] | None = None) -> Opaque:
    """An annotation; attributes that are None are left out."""
    written = tuple((name, value) for name, value in (attributes or {}).items() if value is not None)
    return Opaque.unchecked(element=Element.unchecked(name=f"{{{NAMESPACE}}}{kind}", text=text, attributes=written))


def with_annotation(
    node: AnyNode, kind: str, text: str | None = None, attributes: Mapping[str, str | None] | None = None
) -> AnyNode:
    """The node with one more annotation, before its other opaque parts."""
    # Before the other parts, so that comments and elements of other tools keep their order among
    # themselves.
    return node.copy(opaque=(annotation(kind, text, attributes), *node.opaque))


def is_annotation(part: Opaque, kind: str) -> bool:
    """Whether an opaque part is an annotation of this kind."""
    return part.element is not None and part.element.name == f"{{{NAMESPACE}}}{kind}"


def find_annotation(node: Node, kind: str) -> Element | None:
    """The first annotation of a kind on the node."""
    if not node.opaque:
        return None
    name = f"{{{NAMESPACE}}}{kind}"
    return next((part.element for part in node.opaque if part.element is not None and part.element.name == name), None)


def without_annotation(node: AnyNode, *kinds: str) -> AnyNode:
    """The node without its annotations of these kinds."""
    if not node.opaque:
        return node
    kept = tuple(part for part in node.opaque if not any(is_annotation(part, kind) for kind in kinds))
    return node if len(kept) == len(node.opaque) else node.copy(opaque=kept)


def annotate_synthesized(node: AnyNode) -> AnyNode:
    """The node, annotated as synthesized by a pass, so that the reverse conversion leaves it out."""
    return node if is_synthesized(node) else with_annotation(node, SYNTHESIZED)


def is_synthesized(node: Node) -> bool:
    """Whether a pass has synthesized the node."""
    return find_annotation(node, SYNTHESIZED) is not None


def without_synthesized(node: AnyNode) -> AnyNode:
    """The node without annotations of what was synthesized, on it and in it."""
    return rewrite(node, Node, lambda each: without_annotation(each, SYNTHESIZED), having=bits_of_ours(SYNTHESIZED))
