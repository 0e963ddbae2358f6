"""Relative paths of an included model, said from where the include is."""

import re
from functools import partial
from posixpath import normpath
from typing import TypeVar

from twinform.ir import (
    Document,
    Element,
    GazeboExtension,
    Heightmap,
    Image,
    Include,
    Material,
    Mesh,
    Node,
    Script,
    map_children,
)
from twinform.passes.legalise.nodes import map_elements

AnyNode = TypeVar("AnyNode", bound=Node)

_FIELDS: dict[type[Node], tuple[str, ...]] = {
    Mesh: ("uri",),
    Heightmap: ("uri",),
    Image: ("uri",),
    Include: ("uri",),
    Material: ("albedo_map", "texture"),
}
_ELEMENTS = frozenset(
    {"uri", "albedo_map", "normal_map", "roughness_map", "metalness_map", "emissive_map", "light_map",
     "ambient_occlusion_map", "glossiness_map", "specular_map", "environment_map"}
)  # fmt: skip
_WITH_FILE_NAMES = frozenset({"skin", "animation"})
"""Elements of actors whose `filename` is a path."""
_ABSOLUTE = re.compile(r"[A-Za-z][\w+.-]*:|/|__")
"""A scheme, a path from the root, or a word such as `__default__`."""


def relocate(document: Document, folder: str) -> Document:
    """The document with relative paths that lead to the same files from where its folder is called `folder`."""
    return _node(document, folder)


def relocated(path: str | None, folder: str) -> str | None:
    """One path; what is absolute, a URI or empty stays."""
    if not path or not path.strip() or _ABSOLUTE.match(path.strip()) or folder in {"", "."}:
        return path
    scheme, separator, rest = folder.rpartition("://")
    return f"{scheme}{separator}{normpath(f'{rest}/{path.strip()}')}"


def _node(node: AnyNode, folder: str) -> AnyNode:
    node = map_children(node, lambda child: _node(child, folder))
    update: dict[str, object] = {}
    for name in _FIELDS.get(type(node), ()):
        value: str | None = getattr(node, name)
        moved = relocated(value, folder)
        if moved != value:
            update[name] = moved
    if isinstance(node, Script):
        update["uris"] = tuple(relocated(uri, folder) for uri in node.uris)
    if isinstance(node, GazeboExtension):
        update["content"] = tuple(_element(element, folder) for element in node.content)
    if node.opaque:
        update["opaque"] = map_elements(node.opaque, partial(_element, folder=folder))
    return node.model_copy(update=update) if update else node


def _element(element: Element, folder: str, inside: str = "") -> Element:
    text = element.text
    if element.name in _ELEMENTS or (element.name == "filename" and inside in _WITH_FILE_NAMES):
        text = relocated(text, folder)
    children = tuple(_element(child, folder, element.name) for child in element.children)
    return element.model_copy(update={"text": text, "children": children})
