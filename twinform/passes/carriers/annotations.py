"""Annotations: elements of our namespace that record how the source wrote a part that the target writes differently.

An annotation never repeats what the target states, so that it stays true when the target is edited:

    <tf:made/>                                   a conversion made this link, joint or frame up
    <tf:from format="sdf" version="1.9"/>        in a model: what it was converted from
    <tf:offset xyz="0 0 0.1" rpy="0 0 0"/>       the frame that the source had, in the frame that stands here
    <tf:pose relative_to="base"/>                the frame, and the notation, in which the source wrote this pose
    <tf:axis expressed_in="base"/>               the frame in which the source wrote this axis
    <tf:extension/>                              the source has this joint in a `<gazebo>` element
    <tf:extension as="loop_joint" xyz="0 0 0"/>  or in this one, whose end on the parent is there in the joint's frame
    <tf:reversed/>                               parent and child of this joint were exchanged, and its axis turned

Other annotations stand beside what uses them: `joint_chains.py`, `to_sdf/shared_materials.py` and so on. They are
elements and never attributes: other readers skip foreign elements, and some fail on foreign attributes.
"""

from collections.abc import Mapping
from typing import TypeVar

from twinform.ir import Document, Element, Format, Model, Node, Opaque, rewrite
from twinform.passes.carriers.carriers import KEPT, NAMESPACE, ROOT, bits_of_ours
from twinform.schemas import parse_version, versions_of

AnyNode = TypeVar("AnyNode", bound=Node)

EXTENSION = "extension"
"""The annotation on a joint of SDF that URDF has in a `<gazebo>` element, or in an element that closes a loop."""
REVERSED = "reversed"
"""The annotation on a joint of URDF whose parent is its child in SDF."""
SYNTHESIZED = "made"
"""The annotation on a link, joint or frame that was not in the source."""
MADE_NAME = "made-name"
"""The annotation on a part without a name in MJCF: `<tf:made-name>NAME</tf:made-name>`, while it is still called so."""
WORLDBODY = "worldbody"
"""The made name of the static model, and of its link, with the shapes of MJCF that belong to no body."""
SAME_GEOM = "same-geom"
"""The annotation on a visual that is one geom of MJCF with the collision of its name, if both have the same shape."""

FITTED = "fitted"
"""The annotation on a shape of the size of a mesh, which MuJoCo fits to that."""


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
    for part in node.opaque:  # a generator would take twice as long, and all parts are asked
        if part.element is not None and part.element.name == name:
            return part.element
    return None


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


CONTINUOUS = "continuous"
"""The annotation on a continuous joint that is called so in SDF, where most files have revolute without limits."""
MIMIC = "mimic"
"""The annotation on a mimic joint with a `reference` in SDF, the position of the leader that counts as zero."""
OLD_NAME = "use_parent_model_frame"
"""The text of the annotation on an axis where the file called the model's frame so, and has newer syntax elsewhere."""


_SCOPES = (1, 8)
"""Since this version `::` in a name separates the scopes of nested models."""
FROM = "from"
"""The annotation on a model with the format and the version that it was converted from."""
_MIXED = "mixed"


def with_provenance(model: Model, document: Document) -> Model:
    """The model, annotated as converted from the format and version of a document."""
    attributes = {"format": document.format.value, "version": document.version or "1.0"}
    mixed = "true" if find_annotation(model, _MIXED) is not None else None
    return with_annotation(without_annotation(model, _MIXED), FROM, attributes={**attributes, "mixed": mixed})


def with_mixed_words(model: Model) -> Model:
    """The model, annotated as one whose file uses syntax of other versions."""
    return with_annotation(model, _MIXED)


def without_provenance(model: Model) -> Model:
    """The model without the annotation."""
    return without_annotation(model, FROM)


def came_from(model: Model, format_: Format) -> bool:
    """Whether a model was converted from a format; one that was read of MJCF is in the terms of SDF."""
    found = find_annotation(model, FROM)
    if found is None:
        return format_ is Format.SDF and _was_read_of_mjcf(model)
    return found.get("format") == format_.value


def _was_read_of_mjcf(model: Model) -> bool:
    kept = (part.element for part in model.opaque if part.element is not None and part.element.name == KEPT)
    return any(each.find(ROOT) is not None for each in kept)


def wrote_scopes(model: Model) -> bool:
    """Whether a model was converted from SDF before 1.8, where `::` may stand in any name."""
    found = find_annotation(model, FROM)
    return came_from(model, Format.SDF) and may_write_scopes((found and found.get("version")) or "")


def may_write_scopes(version: str) -> bool:
    """Whether `::` may stand in any name in a version of SDF; in one that does not exist it may not."""
    return version in versions_of("sdf") and parse_version(version) < _SCOPES


def has_mixed_words(document: Document) -> bool:
    """Whether the only model of a document came from a file with syntax of other versions."""
    found = find_annotation(document.models[0], FROM) if len(document.models) == 1 else None
    return found is not None and found.get("mixed") == "true"


def source_version(document: Document, format_: Format) -> str | None:
    """The version of a format that the only model of a document came from; None where it came from none."""
    if len(document.models) != 1 or not came_from(document.models[0], format_):
        return None
    found = find_annotation(document.models[0], FROM)
    return found.get("version") if found else None
