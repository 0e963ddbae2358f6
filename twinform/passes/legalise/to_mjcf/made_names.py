"""Names that bodies, joints and geoms have in SDF alone, taken out of the MJCF that they were read of.

SDF names each part, and MJCF need not. A name that another element of the file refers to stays, and so does one that
reading would not make again, since other parts are called otherwise by now.
"""

import re
from collections.abc import Iterator

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

_OTHERS = frozenset({"name", "mesh", "hfield", "material", "texture", "file", "type", "objtype", "reftype"})
"""Attributes with other names than those of bodies, joints, geoms, cameras and lights."""
_KINDS = {"body": "link", "joint": "joint"}
"""What the parts are in SDF whose names are told apart from those of others, which stands behind them then."""
_NAMED = frozenset({"body", "joint", "freejoint", "site"})


def keep_names_read_otherwise(context: MjcfContext) -> None:
    """Let bodies and joints have names that reading would not make again. All sections are complete but for the texts.

    Where what a name is made of is that of another part, the kind stands behind it.
    """
    asked = {key: wish for key, wish in context.wishes.items() if key in context.unnamed and key[0] in _KINDS}
    if not asked:
        return
    named = (each for body in context.sections.get("worldbody", ()) for each in body.walk() if each.name in _NAMED)
    written = {each.get("name") for each in named if (each.name, each.get("name")) not in context.unnamed}
    parts = (each for _, model in context.models for each in (*model.links, *model.joints, *model.frames))
    every = written | {each.name for each in parts}
    for (kind, name), (wish, own) in asked.items():
        rest = own.removeprefix(wish)
        is_apart = re.fullmatch(rf"_{_KINDS[kind]}(_\d+)?", rest) is not None
        is_again = wish in every if is_apart else not rest and wish not in written
        if not is_again:
            context.unnamed.discard((kind, name))


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
