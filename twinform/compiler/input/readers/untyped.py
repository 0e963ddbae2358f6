"""Makes the nodes of untyped parts, `Element` and `Opaque`, from an XML tree."""

from twinform.diagnostics import Source
from twinform.ir import Element, Opaque
from twinform.ir.record import maker
from twinform.schemas import Data, XmlElement, locate

_make_element = maker(Element)
_make_opaque = maker(Opaque)


class NodesOfParts:
    """Makes nodes of what has no typed field, for the schema reader, which does not import the IR."""

    def __init__(self, file: str) -> None:
        self._file = file

    def element(self, element: XmlElement, above: Source | None, *, kept: bool) -> Element:
        """An untyped element; one that is `kept` is without the text that follows it."""
        return read_element(element, self._file, above, kept=kept)

    def opaque(self, part: Data) -> Opaque:
        """A part of a node that has no field."""
        return _make_opaque(part)


def read_element(element: XmlElement, file: str, above: Source | None, *, kept: bool = False) -> Element:
    """The subtree, with sources below the one that is given; one that is `kept` has no text behind it."""
    tag = str(element.tag)
    if above is not None:
        above = locate(Source, (file, element.sourceline or 0, above, tag, element.get("name")))
    attributes = tuple(element.items())
    text = (element.text or "").strip() or None
    children = tuple([read_element(child, file, above) for child in element]) if len(element) else ()
    tail = None if kept else (element.tail or "").strip() or None
    values = {
        "source": above,
        "name": tag,
        "attributes": attributes,
        "text": text,
        "children": children,
        "tail": tail,
    }
    return _make_element(values)
