"""Where meshes and textures are."""

from typing import ClassVar

from twinform.diagnostics import Notes
from twinform.ir import Collision, Link, Material, Mesh, Model, Node, Visual, map_children
from twinform.passes.legalise.model_pass import ModelPass

_ROS, _GAZEBO = "package://", "model://"


class MeshUris(ModelPass):
    """Write `package://` as `model://`, which Gazebo looks up in its own resource path.

    Changes: 1. URIs of meshes; 2. URIs of textures.
    Never touches: files, relative paths and other schemes.
    Diagnostics: none.
    """

    name: ClassVar[str] = "mesh-uris"

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model with URIs that Gazebo resolves."""
        return model.model_copy(update={"links": tuple([_link(link) for link in model.links])})


def _link(link: Link) -> Link:
    shapes = (*link.visuals, *link.collisions)
    return map_children(link, _rewrite) if any(map(_names_a_package, shapes)) else link


def _names_a_package(shape: Visual | Collision) -> bool:
    mesh = shape.geometry.shape if shape.geometry else None
    material = shape.material if isinstance(shape, Visual) else None
    return (isinstance(mesh, Mesh) and _is_ros(mesh.uri)) or (material is not None and _is_ros(material.albedo_map))


def _rewrite(node: Node) -> Node:
    """The node, and all below it, with URIs for Gazebo."""
    if isinstance(node, Mesh):
        return node.model_copy(update={"uri": _gazebo(node.uri)}) if _is_ros(node.uri) else node
    if isinstance(node, Material):
        return node.model_copy(update={"albedo_map": _gazebo(node.albedo_map)}) if _is_ros(node.albedo_map) else node
    return map_children(node, _rewrite)


def _is_ros(uri: str | None) -> bool:
    return uri is not None and uri.startswith(_ROS)


def _gazebo(uri: str | None) -> str:
    return _GAZEBO + (uri or "")[len(_ROS) :]
