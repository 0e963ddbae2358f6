"""Frames of poses: `relative_to` since SDF 1.7, `frame` before."""

from typing import ClassVar, TypeVar

from twinform.ir import OPAQUE, Document, Element, Model, Node, Opaque, Pose, map_children, replace_fields, rewrite
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign, map_own_elements

AnyNode = TypeVar("AnyNode", bound=Node)

_OLD = "frame"
_NEW = "relative_to"


class NamePoseFrames(VersionPass):
    """Call the frame of a pose `relative_to`, which SDF 1.5 and 1.6 call `frame`.

    Changes: every pose, those in untyped elements too.
    Never touches: an empty name, which means nothing; the pose of a model at the root of the file, which names no frame
    in newer versions; in an untyped element the pose in a frame of its own, which goes along with that frame.
    """

    name: ClassVar[str] = "name-pose-frames"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with poses in the syntax of 1.7."""
        models = tuple(map(_rename_in_root, document.models))
        rest = map_children(document.copy(models=()), _rename_in)
        return rest.copy(models=models)


def _rename_in_root(model: Model) -> Model:
    """A model at the root of the file, whose own pose stays."""
    return _rename_in(model).copy(pose=model.pose)


def _rename_in(node: AnyNode) -> AnyNode:
    return rewrite(node, Node, _rename_node, having=OPAQUE)


def _rename_node(node: Node) -> Node:
    return _rename_frame(node) if isinstance(node, Pose) else map_own_elements(node, _rename_in_element)


def _rename_frame(pose: Pose) -> Pose:
    found = next((part for part in pose.opaque if part.attribute and part.attribute[0] == _OLD), None)
    # The specification of 1.5 and 1.6 gives `frame` an empty default, and exporters write
    # `frame=""` into every pose.
    if found is None or not found.attribute or not found.attribute[1] or pose.relative_to is not None:
        return pose
    rest: tuple[Opaque, ...] = tuple(part for part in pose.opaque if part is not found)
    return pose.copy(**{_NEW: found.attribute[1], "opaque": rest})


def _rename_in_element(element: Element, own: frozenset[str | None] = frozenset()) -> Element:
    """An untyped element with its poses renamed; `own` are the frames of the one around it."""
    if element.name == "pose":
        return element if element.get(_OLD) in own else _rename_attribute(element)
    if not element.children or element.name == "plugin" or is_foreign(element):
        return element
    frames = frozenset(child.get("name") for child in element.find_all("frame"))
    return replace_fields(element, children=tuple(_rename_in_element(child, frames) for child in element.children))


def _rename_attribute(pose: Element) -> Element:
    if not pose.get(_OLD) or pose.get(_NEW) is not None:
        return pose
    attributes = tuple((_NEW if name == _OLD else name, value) for name, value in pose.attributes)
    return pose.copy(attributes=attributes)
