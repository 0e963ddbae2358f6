"""Elements as a consumer's own XML parser sees them, and its refusal of a text."""

from collections.abc import Iterator
from dataclasses import dataclass, field


class UnparsedError(Exception):
    """The text is no XML to a parser."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.message, self.line = message, line


@dataclass(slots=True, eq=False)
class Node:
    """An element with its raw attributes: what the parser at hand leaves of blanks and references in them."""

    tag: str
    line: int
    attributes: dict[str, str] = field(default_factory=dict[str, str])
    children: list["Node"] = field(default_factory=list["Node"])
    text: str = ""
    begins_with_comment: bool = False
    """Whether a comment stands before its text and its children; TinyXML's parsers alone tell."""

    def all(self, tag: str) -> Iterator["Node"]:
        """The children with a tag."""
        return (child for child in self.children if child.tag == tag)

    def first(self, tag: str) -> "Node | None":
        """The first child with a tag."""
        return next(self.all(tag), None)

    def value(self, *path: str) -> str | None:
        """The value of an attribute, the last of the names, of the first child of the first child, and so on."""
        node: Node | None = self
        for tag in path[:-1]:
            node = None if node is None else node.first(tag)
        return None if node is None else node.attributes.get(path[-1])
