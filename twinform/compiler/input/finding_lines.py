"""Lines of findings: from the line of the node that holds a part to that of the part itself, by the path.

Nodes know where they were written, and their simple parts, such as the `<child>` of a joint, only the step to them.
Findings of the schema reader need none of this: it has the elements themselves.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from twinform.diagnostics import Diagnostic, Location
from twinform.schemas import XmlElement
from twinform.schemas.xml import prefix_of

_STEP = re.compile(
    r"/(?P<tag>[^/\[\]@]+)(?:\[@(?P<key>name|reference)='(?P<value>.*?)'\]|\[(?P<place>\d+)\])?(?=/|$)", re.DOTALL
)
_ATTRIBUTE = re.compile(r"/@[^/\]']+$")

Key = tuple[str, str | None, str | None]
"""The name of an element, and the attribute that tells it from others with its value; None where it may have any."""
_KEYS = ("name", "reference")


@dataclass(slots=True)
class _Children:
    """The children of elements by what paths call them; each element is looked through once."""

    of: dict[XmlElement, dict[Key, list[XmlElement]]] = field(
        default_factory=dict[XmlElement, dict[Key, list[XmlElement]]]
    )

    def named(self, element: XmlElement, key: Key) -> list[XmlElement]:
        found = self.of.get(element)
        if found is None:
            found = self.of[element] = defaultdict(list)
            for child in element:
                tag = _written_tag(child)
                found[tag, None, None].append(child)
                for name in _KEYS:
                    own = child.get(name)
                    if own is not None:
                        found[tag, name, own].append(child)
        return found.get(key, [])


class PartFinder:
    """Finds the parts of one tree that locations lead to."""

    def __init__(self, root: XmlElement) -> None:
        self.root = root
        self.children = _Children()

    def find(self, where: Location) -> XmlElement | None:
        """The part at a location; None where the path is not ours, or leads to several parts or beside the line."""
        return _found(self.root, where, self.children)

    def find_path(self, where: Location) -> XmlElement | None:
        """The part that a path leads to, whatever the line is; None where it leads to several."""
        return _found(self.root, where._replace(line=self.root.sourceline or 0), self.children)


def with_exact_lines(diagnostics: Iterable[Diagnostic], root: XmlElement, file: str) -> Iterator[Diagnostic]:
    """The findings, each at the line of the smallest part that its path leads to without a doubt."""
    parts = PartFinder(root)
    for each in diagnostics:
        where = each.location
        found = parts.find(where) if where.file == file and where.line else None
        line = found.sourceline if found is not None else None
        yield replace(each, location=where._replace(line=line)) if line and line != where.line else each


def _found(root: XmlElement, where: Location, children: _Children) -> XmlElement | None:
    """The part at a location; None where the path is not ours, or leads to several parts or beside the line.

    The line is that of the part, or of one around it.
    """
    steps = list(_STEP.finditer(_ATTRIBUTE.sub("", where.path)))
    path = "".join(step[0] for step in steps)
    if not steps or not where.path.startswith(path) or steps[0]["tag"] != root.tag:
        return None
    parts = [(root, root.sourceline == where.line)]
    for step in steps[1:]:
        parts = [
            (child, was or child.sourceline == where.line)
            for element, was in parts
            for child in _chosen(children.named(element, (step["tag"], step["key"], step["value"])), step["place"])
        ]
    found = [part for part, was in parts if was]
    return found[0] if len(found) == 1 else None


def _written_tag(element: XmlElement) -> str:
    """The name of an element as paths have it: with the prefix that it was written with."""
    tag = str(element.tag)
    prefix = prefix_of(element, tag)
    return f"{prefix}:{tag.partition('}')[2]}" if prefix else tag


def _chosen(found: list[XmlElement], place: str | None) -> list[XmlElement]:
    return found if place is None else found[int(place) - 1 : int(place)]


def line_of_text(root: XmlElement, where: Location, text: str) -> int:
    """The line of the first part in what a location leads to that has this text; 0 where there is none."""
    start = _found(root, where, _Children())
    if start is None:
        return 0
    lines = (
        each.sourceline or 0
        for each in start.iter()
        if (each.text or "").strip() == text or text in (value.strip() for value in each.attrib.values())
    )
    return next(lines, 0)
