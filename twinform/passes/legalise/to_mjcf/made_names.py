"""Names that bodies, joints and geoms have in SDF alone, taken out of the MJCF that they were read of.

SDF names each part, and MJCF need not. A name that another element of the file refers to stays.
"""

from collections.abc import Iterator

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

_OTHERS = frozenset({"name", "mesh", "hfield", "material", "texture", "file", "type", "objtype", "reftype"})
"""Attributes with other names than those of bodies, joints, geoms, cameras and lights."""


def remove_made_names(context: MjcfContext) -> None:
    """Write parts without the names that reading has made up. All sections are complete."""
    if not context.unnamed:
        return
    used = {value for each in _walk(context) for key, value in each.attributes if key not in _OTHERS}
    made = {(kind, name) for kind, name in context.unnamed if name not in used}
    for section in ("worldbody", "equality"):
        elements = context.sections.get(section, [])
        elements[:] = [_without(each, made) for each in elements]


def _walk(context: MjcfContext) -> Iterator[Element]:
    for elements in context.sections.values():
        for each in elements:
            yield from each.walk()


def _without(element: Element, made: set[tuple[str, str]]) -> Element:
    children = tuple(_without(each, made) for each in element.children)
    attributes = element.attributes
    if (element.name, element.get("name")) in made:
        attributes = tuple(pair for pair in attributes if pair[0] != "name")
    return element.copy(attributes=attributes, children=children)
