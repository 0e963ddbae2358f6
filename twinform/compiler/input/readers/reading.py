"""One run of a generated reader over a document: its way to the schema reader, for all that is not usual."""

from typing import Any

from twinform.compiler.input.readers.untyped import NodesOfParts, read_element
from twinform.compiler.input.readers.values import only_text, text_of
from twinform.diagnostics import Source
from twinform.ir import Element
from twinform.schemas import (
    Context,
    Data,
    ElementReader,
    Reader,
    XmlElement,
    keep_element,
    locate,
    reader,
)


class Reading:
    """State of the run, and the calls of the schema reader.

    `path` names an element by its path in the facts, such as `link/inertial`, and `at` is the path from the node to the
    element. `is_unsure` is whether there may be text where the facts have none. `broken` is whether some node
    lacks what its class needs, so that there is no document; then there is a finding as well.
    """

    def __init__(self, context: Context) -> None:
        context.parts = NodesOfParts(context.file)
        self.context = context
        self.file, self.version = context.file, context.version
        self.is_unsure = not context.simple
        self.text_of = text_of if context.simple else only_text
        self.broken = False
        # Made on the first unusual part. There is no second attempt at the document, so findings
        # keep their order; 62 % of the time for URDF files of the corpus goes into files with a
        # dialect or a slip somewhere.
        self._reader: Reader | None = None

    def _element(self, path: str) -> ElementReader:
        if self._reader is None:
            self._reader = reader(self.context.format, self.version)
        return self._reader.elements[path]

    def attribute(self, path: str, element: XmlElement, name: str, text: str, node: Data, at: str = "") -> None:
        """Read an attribute that is unknown, or whose value is unusual."""
        self._element(path).attribute(element, name, text, node, at, self.context)

    def missing_attributes(self, path: str, element: XmlElement) -> None:
        """Report the attributes that should be there, if any are not."""
        self._element(path).missing_attributes(element, self.context)

    def text(self, path: str, element: XmlElement, node: Data, at: str = "") -> None:
        """Read a text that is unusual."""
        self._element(path).text(element, node, at, self.context)

    def child(self, path: str, child: XmlElement, node: Data, place: int, at: str = "") -> None:
        """Read a child that has no field, or is unusual."""
        self._element(path).child(child, node, at, place, self.context)

    def children(self, path: str, element: XmlElement, node: Data, at: str = "") -> None:
        """Read the children of an element that should have none."""
        self._element(path).children(element, node, at, self.context)

    def tail(self, path: str, element: XmlElement, child: XmlElement, node: Data, at: str = "") -> None:
        """Read the text after a child."""
        if not self.context.clean:
            self._element(path).tail(element, child, node, at, self.context)

    def missing_children(self, path: str, element: XmlElement, counts: dict[Any, int]) -> None:
        """Report the children that should be there, if any are not, and those that are too many."""
        self._element(path).missing_children(element, counts, self.context)

    def other_version(self, path: str, child: XmlElement) -> None:
        """Report a child that only other versions have."""
        self._element(path).other_version(child, self.context)

    def keep(self, child: XmlElement, node: Data, at: str = "") -> None:
        """Keep an empty child."""
        keep_element(child, node, at, self.context)

    def content(self, child: XmlElement, source: Source) -> Element:
        """A child in free content."""
        return read_element(child, self.file, source)

    def source(self, above: Source | None, element: XmlElement, step: str, key: str | int | None) -> Source:
        """Where an element was written."""
        return locate(Source, (self.file, element.sourceline or 0, above, step, key))

    def holder(self, node: Data, field: str, element: XmlElement) -> dict[str, Any]:
        """The values of a node between this one and the element, which has no element of its own."""
        found: dict[str, Any] | None = node.get(field)
        if found is None:
            found = node[field] = {"source": self.source(node["source"], element, str(element.tag), None)}
        return found
