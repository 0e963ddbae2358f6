"""Elements as a consumer's own XML parser sees them, their paths, and its refusal of a text."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field


class UnparsedError(Exception):
    """The text is no XML to a parser."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.message, self.line = message, line


@dataclass(slots=True, eq=False)
class RawNode:
    """An element with its raw attributes: what the parser at hand leaves of blanks and references in them."""

    tag: str
    line: int
    attributes: dict[str, str] = field(default_factory=dict[str, str])
    children: list["RawNode"] = field(default_factory=list["RawNode"])
    text: str = ""
    begins_with_comment: bool = False
    """Whether a comment stands before its text and its children; TinyXML's parsers alone tell."""

    def all(self, tag: str) -> Iterator["RawNode"]:
        """The children with a tag."""
        return (child for child in self.children if child.tag == tag)

    def first(self, tag: str) -> "RawNode | None":
        """The first child with a tag."""
        return next(self.all(tag), None)

    def value(self, *path: str) -> str | None:
        """The value of an attribute, the last of the names, of the first child of the first child, and so on."""
        node: RawNode | None = self
        for tag in path[:-1]:
            node = None if node is None else node.first(tag)
        return None if node is None else node.attributes.get(path[-1])


class Paths:
    """XPaths of the elements of a tree, as findings have them: `/robot[@name='r']/link[@name='b']/visual[2]`."""

    def __init__(self, root: RawNode) -> None:
        self._root = root
        self._paths: dict[int, str] = {}

    def of(self, node: RawNode) -> str:
        """The path of an element; all are counted when the first is asked for."""
        if not self._paths:
            self._count()
        return self._paths.get(id(node), "/")

    def _count(self) -> None:
        waiting = [(self._root, "/" + _step(self._root, 1, 1))]
        while waiting:
            node, path = waiting.pop()
            self._paths[id(node)] = path
            totals, met = Counter(child.tag for child in node.children), Counter[str]()
            for child in node.children:
                met[child.tag] += 1
                waiting.append((child, f"{path}/{_step(child, met[child.tag], totals[child.tag])}"))


def _step(node: RawNode, place: int, total: int) -> str:
    name = node.attributes.get("name")
    if name is not None:
        return f"{node.tag}[@name='{name}']"
    return node.tag if total == 1 else f"{node.tag}[{place}]"
