"""Assets of MJCF that a model names, such as meshes and materials: they go with the model out of its world.

What a world was read with stands in the world, since all of its models may name it.
"""

from collections.abc import Collection, Iterator
from typing import NamedTuple, Self

from twinform.ir import Element, Model, Opaque, World, walk
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT, asset_name, kept_elements
from twinform.schemas.mjcf_references import ASSET_KINDS, naming_attributes

_SECTION = "asset"
Name = tuple[str, str]
"""The kind and the name of an asset."""


class NamedAssets(NamedTuple):
    """The assets that a world keeps, in their order, by their kinds and names."""

    kept: dict[Name, Element]

    @classmethod
    def of(cls, world: World) -> Self:
        """Look through what a world keeps."""
        sections = [each for each in kept_elements(world) if each.name == _SECTION]
        return cls({(each.name, asset_name(each)): each for section in sections for each in section.children})

    def with_model(self, model: Model) -> Model:
        """The model, keeping the assets that it names, and those that these name."""
        found = self.named_in(model)
        if not found:
            return model
        section = Element.unchecked(name=_SECTION, children=found)
        own = next((part for part in model.opaque if part.element is not None and part.element.name == KEPT), None)
        if own is None or own.element is None:
            kept = Opaque.unchecked(element=Element.unchecked(name=KEPT, children=(section,)))
            return model.copy(opaque=(*model.opaque, kept))
        kept = own.copy(element=own.element.copy(children=(*own.element.children, section)))
        return model.copy(opaque=tuple(kept if part is own else part for part in model.opaque))

    def named_in(self, model: Model) -> tuple[Element, ...]:
        """Return the assets that a model names, directly or by way of others."""
        if not self.kept:
            return ()
        found: set[Name] = set()
        elements = (each for node in walk(model) if node.opaque for kept in kept_elements(node) for each in kept.walk())
        left = [key for element in elements for key in names_of_assets(element)]
        while left:
            key = left.pop()
            if key in self.kept and key not in found:
                found.add(key)
                left += (name for each in self.kept[key].walk() for name in names_of_assets(each))
        return tuple(each for key, each in self.kept.items() if key in found)


def without_assets(part: Opaque, gone: Collection[Element]) -> Opaque | None:
    """What a world keeps without some of its assets; None where that was all."""
    if not gone or part.element is None or part.element.name != KEPT:
        return part
    taken = {id(each) for each in gone}

    def rest(section: Element) -> Element | None:
        children = tuple(each for each in section.children if id(each) not in taken)
        return section.copy(children=children) if children or section.name != _SECTION else None

    left = tuple(kept for each in part.element.children if (kept := rest(each)) is not None)
    return part.copy(element=part.element.copy(children=left)) if left else None


def names_of_assets(element: Element) -> Iterator[Name]:
    """Yield the kinds and names of the assets that an element names."""
    attributes = dict(element.attributes)
    for key, kind in naming_attributes(element.name, attributes):
        if kind in ASSET_KINDS:
            yield kind, attributes[key]
