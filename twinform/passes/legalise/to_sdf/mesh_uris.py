"""Where meshes and textures are."""

from typing import ClassVar

from twinform.diagnostics import Notes
from twinform.ir import Collision, Geometry, Link, Material, Mesh, Model, Node, Visual, map_children
from twinform.passes.legalise.model_pass import ModelPass

_ROS, _GAZEBO = "package://", "model://"


class MeshUris(ModelPass):
    """Write `package://` as `model://`, which Gazebo looks up in its own resource path.

    Changes: 1. URIs of meshes; 2. URIs of textures.
    Never touches: files, relative paths and other schemes.
    Diagnostics: none.
    """

    name: ClassVar[str] = "mesh-uris"

    def run_model(self, model: Model, notes: Notes) -> Model:  # noqa: ARG002 - the signature of a pass
        """The model with URIs that Gazebo resolves."""
        return map_children(model, _rewrite)


def _rewrite(node: Node) -> Node:
    """The node, and all below it, with URIs for Gazebo; only what can hold one is looked into."""
    if isinstance(node, Mesh):
        return node.model_copy(update={"uri": _gazebo(node.uri)}) if _is_ros(node.uri) else node
    if isinstance(node, Material):
        return node.model_copy(update={"albedo_map": _gazebo(node.albedo_map)}) if _is_ros(node.albedo_map) else node
    return map_children(node, _rewrite) if isinstance(node, Link | Visual | Collision | Geometry) else node


def _is_ros(uri: str | None) -> bool:
    return uri is not None and uri.startswith(_ROS)


def _gazebo(uri: str | None) -> str:
    return _GAZEBO + (uri or "")[len(_ROS) :]
