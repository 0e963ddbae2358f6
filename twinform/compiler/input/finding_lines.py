"""Exact lines of findings: finds the element that the path of a finding leads to, and the piece of it that is meant.

Nodes only know their own lines, and not those of simple parts, such as the `<child>` of a joint. Findings of the reader
have exact lines already, because it has the elements themselves.

The piece is the smallest one that contains what was found, or the name in the start tag where that is in doubt.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from itertools import chain, islice

from twinform.diagnostics import Diagnostic, Location, Rule, Span, nearest_name, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.schemas.xml import prefix_of
from twinform.text import AttributeSpan, ElementSpan
from twinform.text.tokens import COMMENT, INSTRUCTION

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


_NAMES: frozenset[Rule] = frozenset(
    {
        rules.UNKNOWN_ELEMENT,
        rules.UNKNOWN_ATTRIBUTE,
        rules.OUTSIDE_VERSION,
        rules.DEPRECATED_ELEMENT,
        rules.DIALECT,
        rules.REPEATED_ELEMENT,
        rules.MISSING_ELEMENT,
        rules.MISSING_PART,
        rules.GONE_FROM_SDF,
        rules.NOT_FOR_FORMAT,
        rules.PARAMETER_WITHOUT_COUNTERPART,
        rules.GAZEBO_TAG_WITHOUT_TARGET,
        rules.GAZEBO_CONFLICT,
    }
)
"""Findings about the name of an element or attribute, whatever its value is."""
_PARTS: dict[Rule, str] = {
    rules.DUPLICATE_NAME: "name",
    rules.EMPTY_NAME: "name",
    rules.SHARED_NAME: "name",
    rules.UNPRINTABLE_NAME: "name",
    rules.DANGLING_LINK: "link",
    rules.UNKNOWN_MATERIAL: "name",
    rules.LOWER_ABOVE_UPPER: "lower",
    rules.FRAME_CYCLE: "name",
    rules.CONFLICTING_MATERIAL: "name",
    rules.MIMIC_CYCLE: "joint",
    rules.NON_POSITIVE_MASS: "mass",
    rules.TWO_PARENTS: "child",
    rules.KINEMATIC_LOOP: "child",
    rules.SELF_JOINT: "child",
}
"""The attribute, or the child element, that a finding about an element is about, where it has one."""
_QUOTED = lazy_pattern(r"'((?:[^']|(?<=\w)'(?=\w))+)'")
_EXPRESSION = lazy_pattern(r"(?:when evaluating expression '|, in \$\{)(.*)['}]$", re.DOTALL)
_PARAMETER = lazy_pattern(r" has no parameter '(\S+)'$")
_ARGUMENT = lazy_pattern(r"^(?:argument|the arguments) '([^']+)'")
_ALIKE = 0.75
"""How similar an attribute's name has to be to that of a missing attribute to be taken for a typo of it."""
_SHORTEST = 4
"""Shorter names are not taken for typos."""
_TOKEN = lazy_pattern(r"[^\s,]+")
_ASIDE = lazy_pattern(f"{COMMENT}|{INSTRUCTION}")


def piece(finding: Diagnostic, element: ElementSpan, text: str) -> Span:
    """Return the piece that a finding is about, in the element that its path leads to."""
    attribute = finding.location.path.rpartition("/@")[2] if "/@" in finding.location.path else None
    if attribute is not None:
        written = element.attributes.get(attribute)
        return _piece_of_attribute(finding, written, text) if written else element.name
    if finding.rule is rules.STRAY_TEXT:
        return (finding.found and element.find_text(finding.found, text)) or element.name
    if finding.rule is rules.MISSING_ATTRIBUTE:
        return _misspelt_attribute(finding, element) or element.name
    if finding.rule in _NAMES:
        return element.name
    if finding.rule is rules.SPLIT_VALUE:
        return _own_text(element, text) or element.name
    return _piece_for_rule(finding, element, text) or _piece_with_found(finding, element, text) or element.name


def quoted(message: str, element: ElementSpan, text: str) -> Span | None:
    """Return the value, text or xacro expression of an element that a message quotes."""
    wanted = set(_QUOTED.findall(message)) | {word.strip(".,:;[]'\"") for word in message.split()}
    expression = _EXPRESSION.search(message)
    argument = _ARGUMENT.search(message)
    parameter = _PARAMETER.search(message)
    if parameter is not None:
        written = element.attributes.get(parameter[1])
        return written.name if written else None
    if argument is not None:
        return _find_word(f"$(arg {argument[1]})", element, text)
    if expression is not None:
        begin = [
            at for form in ("${%s}", "$(%s)") if (at := _find_word(form % expression[1], element, text)) is not None
        ]
        return begin[0] if len(begin) == 1 else None
    ends = [each for each in values(element, text) if "." in each.of(text) and f"/{each.of(text)}'" in message]
    return _only_equal(values(element, text), wanted, text) or _only(ends)


def values(element: ElementSpan, text: str) -> list[Span]:
    """Return the text of an element and the values of its attributes, except empty ones."""
    own = _own_text(element, text)
    return [
        *((own,) if own else ()),
        *(each.value for each in element.attributes.values() if each.value.of(text)),
    ]


def _misspelt_attribute(finding: Diagnostic, element: ElementSpan) -> Span | None:
    """Return the name of an attribute that is a typo of a missing one; short names, such as ixx, are too similar."""
    missing = _QUOTED.search(finding.message)
    near = nearest_name(missing[1], element.attributes, _ALIKE) if missing and len(missing[1]) >= _SHORTEST else None
    return element.attributes[near].name if near else None


def _find_word(word: str, element: ElementSpan, text: str) -> Span | None:
    """Return where a word stands in a start tag or text, if it is there once."""
    inside = Span(element.start_tag.start, (_own_text(element, text) or element.start_tag).end)
    start = text.find(word, *inside)
    if start < 0 or text.find(word, start + 1, inside.end) >= 0:
        return None
    return Span(start, start + len(word))


def _piece_for_rule(finding: Diagnostic, element: ElementSpan, text: str) -> Span | None:
    name = _PARTS.get(finding.rule)
    if name is None:
        return None
    if (named := element.attributes.get(name)) is not None:
        return named.value if named.value.of(text) else named.whole
    child = next((each for each in element.children if each.name.of(text) == name), None)
    if child is None:
        return None
    value = child.attributes.get("value") or child.attributes.get("link")
    return _own_text(child, text) or (value.value if value else child.name)


def _piece_of_attribute(finding: Diagnostic, attribute: AttributeSpan, text: str) -> Span:
    if finding.rule in _NAMES:
        return attribute.name
    found = _only_token(attribute.value, finding.found, text)
    return found or (attribute.value if attribute.value.of(text) else attribute.whole)


def _piece_with_found(finding: Diagnostic, element: ElementSpan, text: str) -> Span | None:
    """Return the text or value in an element that contains what was found, or what the message quotes."""
    parts = values(element, text)
    found = finding.found
    if found is not None:
        words = (word for part in parts if (word := _only_token(part, found, text)))
        return _only_equal(parts, {found}, text) or _only(words) or _in_children(element, found, text)
    name = element.attributes.get("name")
    others = [part for part in parts if name is None or part != name.value]
    return _only_equal(others, set(_QUOTED.findall(finding.message)), text)


def _only_equal(parts: list[Span], wanted: set[str], text: str) -> Span | None:
    return _only(each for each in parts if each.of(text) in wanted)


def _in_children(element: ElementSpan, found: str, text: str) -> Span | None:
    """Return the only text or value of a child that is equal to what was found."""
    return _only_equal([part for child in element.children for part in values(child, text)], {found}, text)


def _only(found: Iterable[Span]) -> Span | None:
    spans = [*islice(found, 2)]
    return spans[0] if len(spans) == 1 else None


def _only_token(part: Span, wanted: str | None, text: str) -> Span | None:
    """Return a word in a text or value, if it is there exactly once."""
    if not wanted or not _TOKEN.fullmatch(wanted):
        return None
    words = (found for found in _TOKEN.finditer(text, part.start, part.end) if found[0] == wanted)
    return _only(Span(*found.span()) for found in words)


def _own_text(element: ElementSpan, text: str) -> Span | None:
    """Return the text of an element without blanks and comments around it; None where it has children."""
    if element.children or element.content is None:
        return None
    written = _ASIDE.sub(lambda aside: " " * len(aside[0]), element.content.of(text))
    start = element.content.start + len(written) - len(written.lstrip())
    end = element.content.start + len(written.rstrip())
    return Span(start, end) if start < end else None
