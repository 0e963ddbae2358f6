"""Exact lines of findings: finds the element that the path of a finding leads to.

Nodes only know their own lines, and not those of simple parts, such as the `<child>` of a joint. Findings of the reader
have exact lines already, because it has the elements themselves.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from itertools import chain

from twinform.diagnostics import Diagnostic, Location
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.schemas.xml import prefix_of

_STEP = lazy_pattern(
    r"/(?P<tag>[^/\[\]@]+)(?:\[@(?P<key>name|reference)='(?P<value>.*?)'\]|\[(?P<place>\d+)\])?(?=/|$)", re.DOTALL
)
_ATTRIBUTE = lazy_pattern(r"/@[^/\]']+$")

_KEYS = ("name", "reference")
_SEVERAL = 2


class _Parts:
    """The elements that a path leads to, with an index of their children, so that each element is looked at once."""

    def __init__(self, elements: list[XmlElement]) -> None:
        self.elements = elements
        self._inside: dict[str, _Parts] = {}

    def inside(self, step: re.Match[str]) -> "_Parts":
        """Return the elements that another step leads to."""
        if step[0] not in self._inside:
            self._inside[step[0]] = _Parts(self._found(step["tag"], step["key"], step["value"], step["place"]))
        return self._inside[step[0]]

    def only_one_at(self, line: int) -> XmlElement | None:
        """Return the only element that begins on a line, or is inside one that does; None where there are several."""
        found = self._by_line.get(line, [])
        return found[0] if len(found) == 1 else None

    def _found(self, tag: str, key: str | None, value: str | None, place: str | None) -> list[XmlElement]:
        if place is None:
            return self._children.get((tag, key, value), [])
        if len(self.elements) == 1:
            return self._children.get((tag, None, None), [])[int(place) - 1 : int(place)]
        return self._numbered.get((tag, int(place)), [])

    @cached_property
    def _children(self) -> dict[tuple[str, str | None, str | None], list[XmlElement]]:
        """All children by tag, and by tag with the name and value of an attribute that identifies them."""
        found: defaultdict[tuple[str, str | None, str | None], list[XmlElement]] = defaultdict(list)
        for child in chain.from_iterable(self.elements):
            tag = _written_tag(child)
            found[tag, None, None].append(child)
            for name in _KEYS:
                own = child.get(name)
                if own is not None:
                    found[tag, name, own].append(child)
        return found

    @cached_property
    def _numbered(self) -> dict[tuple[str, int], list[XmlElement]]:
        """All children by tag, and their number among those of one tag in one element."""
        found: defaultdict[tuple[str, int], list[XmlElement]] = defaultdict(list)
        for element in self.elements:
            count = Counter[str]()
            for child in element:
                tag = _written_tag(child)
                count[tag] += 1
                found[tag, count[tag]].append(child)
        return found

    @cached_property
    def _by_line(self) -> dict[int | None, list[XmlElement]]:
        """The elements by the lines on which they or elements around them begin; at most two for a line."""
        found: defaultdict[int | None, list[XmlElement]] = defaultdict(list)
        for element in self.elements:
            for line in {element.sourceline, *(each.sourceline for each in element.iterancestors())}:
                if len(found[line]) < _SEVERAL:
                    found[line].append(element)
        return found


class PartFinder:
    """Finds the elements of one tree that locations lead to."""

    def __init__(self, root: XmlElement) -> None:
        self.root = root
        self._parts = _Parts([root])

    def find(self, where: Location) -> XmlElement | None:
        """Return the element at a location; None where there is none, or several.

        The line of the location may be that of an element around it.
        """
        steps = _steps(_ATTRIBUTE.sub("", where.path))
        if not steps or steps[0]["tag"] != self.root.tag:
            return None
        parts = self._parts
        for step in steps[1:]:
            parts = parts.inside(step)
        return parts.only_one_at(where.line)

    def find_path(self, where: Location) -> XmlElement | None:
        """Return the element that a path leads to, whatever the line is; None where it leads to several."""
        return self.find(where._replace(line=self.root.sourceline or 0))


def with_exact_lines(diagnostics: Iterable[Diagnostic], root: XmlElement, file: str) -> Iterator[Diagnostic]:
    """Yield findings with the line of the element that their path leads to, where it is the only one."""
    parts = PartFinder(root)
    for each in diagnostics:
        where = each.location
        found = parts.find(where) if where.file == file and where.line else None
        line = found.sourceline if found is not None else None
        yield replace(each, location=where._replace(line=line)) if line and line != where.line else each


def _steps(path: str) -> list[re.Match[str]]:
    """Return the steps of a path, or nothing where a part of it is not a step."""
    steps: list[re.Match[str]] = []
    end = 0
    while found := _STEP.match(path, end):
        steps.append(found)
        end = found.end()
    return steps if end == len(path) else []


def _written_tag(element: XmlElement) -> str:
    """Return the tag of an element with the prefix that it was written with, as in paths."""
    tag = str(element.tag)
    prefix = prefix_of(element, tag)
    return f"{prefix}:{tag.partition('}')[2]}" if prefix else tag


def line_of_text(parts: PartFinder, where: Location, text: str) -> int:
    """Return the line of the first element with a text or value at a location; 0 where there is none."""
    start = parts.find(where)
    if start is None:
        return 0
    lines = (
        each.sourceline or 0
        for each in start.iter()
        if (each.text or "").strip() == text or text in (value.strip() for value in each.attrib.values())
    )
    return next(lines, 0)
