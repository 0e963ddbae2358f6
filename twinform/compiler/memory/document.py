"""The memory of a source in the document that was made of it: one element of our namespace at the end of the model.

<tf:source format="urdf" version="1.0" of="...">   what the way back to this format makes of the model, and the source
...                                              does not; the changes to that; `edits.py` has their words
</tf:source>
"""

from copy import deepcopy
from dataclasses import dataclass
from typing import TypeVar

from lxml import etree

from twinform.compiler.memory.edits import EDITS
from twinform.compiler.orders import DEFAULT_SDF_VERSION
from twinform.ir import Document, Node, Opaque, map_children
from twinform.passes.legalise.carrier import NAMESPACE, PREFIX, SOURCE
from twinform.schemas import XmlElement, element_xml

AnyNode = TypeVar("AnyNode", bound=Node)


@dataclass(frozen=True, slots=True)
class Memory:
    """What a source said where its way back would not find it.

    `edits` holds the changes to the tree that the way back makes; where there is no way back, the only thing in it is
    the whole source. `beside` is the digest of the document that was made of the source, and tells whether somebody
    has edited that. `bare` says that the source has nothing of our own namespace, so that whatever of that is on the
    way back does not count.
    """

    format: str
    version: str
    edits: XmlElement
    beside: str
    bare: bool = True

    @property
    def is_whole(self) -> bool:
        """Whether this is the source itself, and no changes to its way back."""
        return len(self.edits) == 1 and self.edits[0].tag not in EDITS

    @property
    def says_nothing(self) -> bool:
        """Whether the way back finds everything."""
        return not len(self.edits)

    @property
    def goes_without_saying(self) -> bool:
        """Whether the way back finds everything, the version too."""
        return self.says_nothing and self.version in (DEFAULT_SDF_VERSION, "1.0")

    def to_xml(self, namespaces: dict[str | None, str]) -> XmlElement:
        """The element that travels; `namespaces` are the prefixes of the source."""
        made = etree.Element(SOURCE, nsmap={**namespaces, PREFIX: NAMESPACE})
        made.set("format", self.format)
        made.set("version", self.version)
        made.set("of", self.beside)
        if not self.bare:
            made.set("with", PREFIX)
        made.extend(map(deepcopy, self.edits))
        return made


def take_memory(document: Document) -> tuple[Document, Memory | None]:
    """The document without what is remembered anywhere in it, and the memory of its only model, if it has one."""
    if NAMESPACE not in {uri for _, uri in document.namespaces}:
        return document, None
    own = document.models[0].opaque if len(document.models) == 1 else ()
    memories = [_memory(part) for part in own if _is_memory(part)]
    return forget(document), memories[0] if len(memories) == 1 else None


def forget(node: AnyNode) -> AnyNode:
    """The node without memories, at any depth."""
    kept = tuple(part for part in node.opaque if not _is_memory(part))
    if len(kept) != len(node.opaque):
        node = node.model_copy(update={"opaque": kept})
    models = getattr(node, "models", None) or getattr(node, "worlds", None)
    return map_children(node, forget) if models else node


def _is_memory(part: Opaque) -> bool:
    """Whether an opaque part is the memory of a source."""
    return part.element is not None and part.element.name == SOURCE


def _memory(part: Opaque) -> Memory:
    element = element_xml(part.element)
    bare = element.get("with") is None
    return Memory(element.get("format") or "", element.get("version") or "", element, element.get("of") or "", bare)
