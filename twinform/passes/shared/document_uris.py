"""URIs and file paths of a document, wherever they are written, and the schemes of ROS and Gazebo.

An annotation on a visual or collision records the scheme of a URI where the reverse conversion would write the other:

    <tf:mesh scheme="package"/>   <tf:texture scheme="package"/>
"""

from collections.abc import Callable
from functools import partial
from typing import Literal, TypeVar

from twinform.diagnostics import Location
from twinform.ir import (
    OPAQUE,
    Element,
    GazeboExtension,
    Heightmap,
    Image,
    Include,
    Material,
    Mesh,
    Node,
    Plugin,
    Script,
    bits_of,
    rewrite,
)
from twinform.ir.record import Sourced
from twinform.ir.rewrite import union_of
from twinform.passes.carriers.carriers import KEPT
from twinform.passes.shared.nodes import map_elements

Kind = Literal["mesh", "texture", "include"]
"""The use of a file; terrains, scripts and other media count as textures."""
Change = Callable[[str, Kind, Location], str]
"""A function of a URI, its use and its location that returns the new URI."""

AnyNode = TypeVar("AnyNode", bound=Node)

_FIELDS: dict[type[Node], tuple[Kind, tuple[str, ...]]] = {
    Mesh: ("mesh", ("uri",)),
    Heightmap: ("texture", ("uri",)),
    Image: ("texture", ("uri",)),
    Include: ("include", ("uri",)),
    Material: ("texture", ("albedo_map", "texture")),
}
_HAVING = OPAQUE | union_of(map(bits_of, (*_FIELDS, Script)))
_ELEMENTS = frozenset(
    {"uri", "albedo_map", "normal_map", "roughness_map", "metalness_map", "emissive_map", "light_map",
     "ambient_occlusion_map", "glossiness_map", "specular_map", "environment_map", "color_range_image", "cubemap_uri"}
)  # fmt: skip
"""Elements whose text is a path wherever they stand."""
# Elements whose text is a path only inside another one: a terrain's texture has images where a
# material has colors.
_INNER_ELEMENTS = frozenset(
    {("skin", "filename"), ("animation", "filename"), ("projector", "texture"), ("texture", "diffuse"),
     ("texture", "normal")}
)  # fmt: skip
_MAY_HOLD = _ELEMENTS | {name for _, name in _INNER_ELEMENTS} | {KEPT}
FILES_OF_MJCF = ("file", "fileright", "fileleft", "fileup", "filedown", "filefront", "fileback")
"""Attributes of what only MJCF has that are paths: textures of skies, skins, and meshes of no shape."""
_HOLDERS: dict[str, Kind] = {"mesh": "mesh", "skin": "mesh", "animation": "mesh", "include": "include"}
"""The use of a file by the element that holds its URI."""


def map_uris(node: AnyNode, change: Change) -> AnyNode:
    """The node with every URI of a file in it changed, but for parameters of plugins."""
    return rewrite(node, Node, partial(_map_node_uris, change), having=_HAVING)


def _map_node_uris(change: Change, node: Node) -> Node:
    # A parameter of a plugin may be called <uri> and mean a server or a topic.
    if isinstance(node, Plugin):
        return node
    update: dict[str, object] = {}
    kind, names = _FIELDS.get(type(node), ("texture", ()))
    for name in names:
        value: str | None = getattr(node, name)
        changed = change(value, kind, node.location) if value and value.strip() else value
        if changed != value:
            update[name] = changed
    if isinstance(node, Script):
        uris = tuple(change(uri, "texture", node.location) for uri in node.uris)
        update |= {"uris": uris} if uris != node.uris else {}
    if isinstance(node, GazeboExtension) or node.opaque:
        update |= _map_untyped_uris(node, change)
    return node.copy(**update) if update else node


def _map_untyped_uris(node: Node, change: Change) -> dict[str, object]:
    """The updated untyped parts of a node, as fields to copy."""

    def in_element(element: Element) -> Element:
        # few elements have any, and to map all of them takes longer than to look
        has_none = _MAY_HOLD.isdisjoint([each.name for each in element.walk()])
        return element if has_none else _map_element_uris(element, change, node)

    update: dict[str, object] = {}
    if isinstance(node, GazeboExtension):
        content = tuple(map(in_element, node.content))
        update |= {"content": content} if content != node.content else {}
    opaque = map_elements(node.opaque, in_element)
    return {**update, "opaque": opaque} if opaque != node.opaque else update


def _map_element_uris(element: Element, change: Change, holder: Sourced, inside: str = "") -> Element:
    name, text, children = element.name, element.text, element.children
    if name == "plugin":
        return element
    if name == KEPT:
        return _map_files_of_mjcf(element, change, holder)
    if element.source:
        holder = element
    # The map of a shader is the name of a texture, which OGRE looks for in the folders of all scripts.
    is_name = inside == "shader" and "/" not in (text or "")
    if text and (name in _ELEMENTS or (inside, name) in _INNER_ELEMENTS) and text.strip() and not is_name:
        text = change(text, _HOLDERS.get(inside, "texture"), holder.location)
    if children:
        children = tuple([_map_element_uris(child, change, holder, name) for child in children])
    if text == element.text and children == element.children:
        return element
    return element.copy(text=text, children=children)


def _map_files_of_mjcf(element: Element, change: Change, holder: Sourced) -> Element:
    """The element of MJCF with its paths changed, and with those in it."""
    place = element if element.source else holder
    kind: Kind = "texture" if element.name in {"texture", "hfield"} else "mesh"
    attributes = tuple(
        (key, change(value, kind, place.location) if key in FILES_OF_MJCF and value.strip() else value)
        for key, value in element.attributes
    )
    children = tuple([_map_files_of_mjcf(child, change, place) for child in element.children])
    if attributes == element.attributes and children == element.children:
        return element
    return element.copy(attributes=attributes, children=children)


ROS, GAZEBO = "package", "model"
FUEL_SERVERS = ("fuel.gazebosim.org", "fuel.ignitionrobotics.org")
"""The server of Gazebo's models, under its present name and the older one."""
MESH_SCHEME, TEXTURE_SCHEME = "mesh", "texture"
"""The names of the annotations on a visual or collision."""


def package_uri(uri: str) -> tuple[str, bool]:
    """A URI of SDF for URDF, and whether converting it back would give another URI."""
    return with_scheme(uri, ROS, GAZEBO), scheme_of(uri) == ROS


def model_uri(uri: str) -> tuple[str, bool]:
    """A URI of URDF for SDF, and whether converting it back would give another URI."""
    return with_scheme(uri, GAZEBO, ROS), scheme_of(uri) == GAZEBO


def with_scheme(uri: str, scheme: str, instead_of: str) -> str:
    """The URI with one scheme replaced by another."""
    # Gazebo looks `model://` up in its resource path and ROS `package://` in its own; both name a
    # folder and a path in it, so the text behind the scheme stays.
    old = f"{instead_of}://"
    return f"{scheme}://{uri[len(old) :]}" if uri.startswith(old) else uri


def scheme_of(uri: str | None) -> str:
    """The scheme of a URI; empty without one."""
    return (uri or "").partition("://")[0] if "://" in (uri or "") else ""
