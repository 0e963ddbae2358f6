"""Elements of URDF as the XML parser of a consumer sees them, joints between links, and XPaths of elements."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field

from twinform.dataclass import dataclass


class UnparsedError(Exception):
    """A parser refuses a text."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.message, self.line = message, line


@dataclass(slots=True, eq=False)
class RawNode:
    """An element with its raw attributes, as a parser leaves blanks and references in them."""

    tag: str
    line: int
    attributes: dict[str, str] = field(default_factory=dict[str, str])
    children: list["RawNode"] = field(default_factory=list["RawNode"])
    text: str = ""
    begins_with_comment: bool = False
    """Whether a comment stands before its text and its children; only set by the parsers of TinyXML."""

    def all(self, tag: str, *below: str) -> Iterator["RawNode"]:
        """The children with a tag; with more tags, the elements at this path."""
        found = (child for child in self.children if child.tag == tag)
        return (each for child in found for each in child.all(*below)) if below else found

    @property
    def name(self) -> str:
        """The name; empty where there is none."""
        return self.attributes.get("name", "")

    @property
    def type(self) -> str | None:
        """The type, if there is one."""
        return self.attributes.get("type")

    def first(self, tag: str) -> "RawNode | None":
        """The first child with a tag."""
        return next(self.all(tag), None)

    def value(self, *path: str) -> str | None:
        """The value of an attribute, the last of these names, at the path of first children with the other names."""
        node: RawNode | None = self
        for tag in path[:-1]:
            node = None if node is None else node.first(tag)
        return None if node is None else node.attributes.get(path[-1])


Fact = Iterator[tuple[RawNode, str]]
"""The elements of which something is true, and what that is."""
FactTable = Mapping[str, Callable[[RawNode], Fact]]
"""Functions that look for something in a robot, by the names that tables of reads use."""


def joint_ends(joint: RawNode) -> tuple[str, str]:
    """The names of the parent and the child of a joint; empty where they are not written."""
    return joint.value("parent", "link") or "", joint.value("child", "link") or ""


def fixed_children(root: RawNode) -> dict[str, list[str]]:
    """The names of the links that are fixed to each link directly."""
    found: dict[str, list[str]] = {}
    for joint in root.all("joint"):
        if joint.type == "fixed":
            parent, child = joint_ends(joint)
            found.setdefault(parent, []).append(child)
    return found


def add_fixed(links: Iterable[str], fixed: Mapping[str, list[str]]) -> set[str]:
    """The links and all that are fixed to them, directly or not."""
    found, waiting = set[str](), [*links]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += fixed.get(name, ())
    return found


class Paths:
    """XPaths of the elements of a tree, as findings have them: `/robot[@name='r']/link[@name='b']/visual[2]`."""

    def __init__(self, root: RawNode) -> None:
        self._root = root
        self._paths: dict[int, str] = {}

    def of(self, node: RawNode) -> str:
        """The path of an element; the first call computes all of them."""
        if not self._paths:
            self._compute_all()
        return self._paths.get(id(node), "/")

    def _compute_all(self) -> None:
        waiting = [(self._root, "/" + _path_step(self._root, 1, 1))]
        while waiting:
            node, path = waiting.pop()
            self._paths[id(node)] = path
            totals, met = Counter(child.tag for child in node.children), Counter[str]()
            for child in node.children:
                met[child.tag] += 1
                waiting.append((child, f"{path}/{_path_step(child, met[child.tag], totals[child.tag])}"))


def _path_step(node: RawNode, place: int, total: int) -> str:
    name = node.attributes.get("name")
    if name is not None:
        return f"{node.tag}[@name='{name}']"
    return node.tag if total == 1 else f"{node.tag}[{place}]"
