"""URIs and file paths of a document, wherever they are written."""

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
from twinform.ir.rewrite import union_of
from twinform.passes.transforms.nodes import map_elements

Kind = Literal["mesh", "texture", "include"]
"""What a file is for; terrains, scripts and all else that is seen or heard count as textures."""
Change = Callable[[str, Kind, Location], str]
"""From a URI, what it is for and where it stands, to the URI as it is to be."""

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
_HOLDERS: dict[str, Kind] = {"mesh": "mesh", "skin": "mesh", "animation": "mesh", "include": "include"}
"""What a file is for, by the element that its URI stands in."""


def map_uris(node: AnyNode, change: Change) -> AnyNode:
    """The node with every URI of a file in it changed; parameters of plugins are theirs alone."""
    return rewrite(node, Node, partial(_with_uris, change), having=_HAVING)


def _with_uris(change: Change, node: Node) -> Node:
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
        update |= _in_elements(node, change)
    return node.copy(**update) if update else node


def _in_elements(node: Node, change: Change) -> dict[str, object]:
    """What changes in the parts of a node that have no typed form."""
    in_element = partial(_element, change=change, where=node.location)
    update: dict[str, object] = {}
    if isinstance(node, GazeboExtension):
        content = tuple(map(in_element, node.content))
        update |= {"content": content} if content != node.content else {}
    opaque = map_elements(node.opaque, in_element)
    return {**update, "opaque": opaque} if opaque != node.opaque else update


def _element(element: Element, change: Change, where: Location, inside: str = "") -> Element:
    if element.name == "plugin":
        return element
    where = element.location if element.source else where
    text = element.text
    is_uri = element.name in _ELEMENTS or (inside, element.name) in _INNER_ELEMENTS
    if is_uri and text and text.strip():
        text = change(text, _HOLDERS.get(inside, "texture"), where)
    children = tuple(_element(child, change, where, element.name) for child in element.children)
    if text == element.text and children == element.children:
        return element
    return element.copy(text=text, children=children)
