"""Fixes of xacro itself: misspelt names, braces without a dollar, degrees, and elements without the prefix."""

import re
from collections import defaultdict
from collections.abc import Iterator
from contextlib import suppress

from twinform.compiler.fixing.site import FixableFile, TextFixers, revealing, unsafe
from twinform.compiler.input.xacro_mistakes import ANGLE, EXPRESSION
from twinform.diagnostics import Diagnostic, Fix, Span, TextEdit, is_misspelt, meant_name, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import usual_namespace
from twinform.text import ElementSpan, UnplacedError, spans

_UNKNOWN = lazy_pattern(r"(?:^property|no (?P<kind>macro|parameter)) '")
_CALLED = lazy_pattern(r"\$\(arg\s+(?P<name>[\w.-]+)\s*\)")


def _unknown_name(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Write the name of a property, macro or parameter that is meant."""
    found, meant = finding.found, finding.expected
    kind = _UNKNOWN.search(finding.message)
    if not found or not meant or kind is None or not is_misspelt(found, meant):
        return None
    edits = [*_RENAMED[kind["kind"] or "property"](found, meant, finding.location.line, file)]
    return unsafe(f"Write {meant!r} instead of {found!r}", *edits) if edits else None


def _in_expressions(found: str, meant: str, line: int, file: FixableFile) -> Iterator[TextEdit]:
    """Rename a name in all expressions of the elements on a line."""
    word = re.compile(rf"(?<![\w.]){re.escape(found)}(?!\w)")
    for piece in _pieces_on(line, file):
        for expression in EXPRESSION.finditer(file.text, *piece):
            for each in word.finditer(file.text, *expression.span()):
                yield TextEdit(Span(*each.span()), meant)


def _in_tags(found: str, meant: str, line: int, file: FixableFile) -> Iterator[TextEdit]:
    """Rename the call of a macro."""
    old, new = f"xacro:{found}", f"xacro:{meant}"
    for element in _elements_on(line, file):
        if element.name.of(file.text) == old:
            yield from _renamed(element, old, new)


def _in_attributes(found: str, meant: str, line: int, file: FixableFile) -> Iterator[TextEdit]:
    """Rename an argument in the call of a macro."""
    for element in _elements_on(line, file):
        if found in element.attributes and meant not in element.attributes:
            yield TextEdit(element.attributes[found].name, meant)


_RENAMED = {"macro": _in_tags, "parameter": _in_attributes, "property": _in_expressions}


def _missing_argument(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Write the name of an argument that the file has."""
    found = _CALLED.fullmatch(finding.found or "")
    meant = meant_name((finding.help or "").partition("\n")[0])
    if found is None or meant is None or not is_misspelt(found["name"], meant):
        return None
    edits = [*_in_expressions(found["name"], meant, finding.location.line, file)]
    return unsafe(f"Write {meant!r} instead of {found['name']!r}", *edits) if edits else None


def _without_dollar(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Make an expression of a name in braces."""
    found = re.compile(rf"(?<![\w{{$]){re.escape(finding.found or '')}")
    edits = [
        TextEdit(Span(each.start(), each.start()), "$")
        for piece in _pieces_on(finding.location.line, file)
        for each in found.finditer(file.text, *piece)
    ]
    return unsafe(f"Write ${finding.found}", *edits) if finding.found and edits else None


def _degrees(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Convert the angles of trigonometric functions from degrees."""
    edits = [
        TextEdit(Span(*each.span("angle")), f"radians({each['angle']})")
        for piece in _pieces_on(finding.location.line, file)
        for each in ANGLE.finditer(file.text, *piece)
        if each["angle"] == finding.found
    ]
    return unsafe(f"Write radians({finding.found})", *edits) if edits else None


def _unprefixed(_: Diagnostic, file: FixableFile) -> Fix | None:
    """Write the prefix of xacro in all elements that lack it, since macros and their calls belong together."""
    if "unprefixed" not in file.memo:
        edits = [*_declared_prefix(file)]
        for each in file.loaded.diagnostics:
            if each.rule is rules.UNPREFIXED_ELEMENT and each.location.file == file.loaded.path:
                edits += _prefixed(each, file)
        file.memo["unprefixed"] = revealing("Write the prefix: <xacro:...>", *dict.fromkeys(edits)) if edits else None
    return file.memo["unprefixed"]


def _prefixed(finding: Diagnostic, file: FixableFile) -> Iterator[TextEdit]:
    found = finding.found or ""
    for element in _elements_on(finding.location.line, file):
        if element.name.of(file.text) == found:
            yield from _renamed(element, found, f"xacro:{found}")


def _declared_prefix(file: FixableFile) -> Iterator[TextEdit]:
    """Declare the prefix of xacro in the root, if nothing does."""
    if file.parts is not None and "xmlns:xacro" not in file.text:
        yield file.edit.set_attribute(file.root, "xmlns:xacro", usual_namespace("xacro"))


def _renamed(element: ElementSpan, old: str, new: str) -> Iterator[TextEdit]:
    """Rename an element in its tags."""
    yield TextEdit(element.name, new)
    if element.end_tag:
        start = element.end_tag.start + len("</")
        yield TextEdit(Span(start, start + len(old)), new)


def _pieces_on(line: int, file: FixableFile) -> Iterator[Span]:
    """Yield the values and texts of the elements on a line."""
    for element in _elements_on(line, file):
        yield from (each.value for each in element.own_attributes)
        yield from element.texts()


def _elements_on(line: int, file: FixableFile) -> list[ElementSpan]:
    """Return the elements whose start tag is on a line, or goes on there."""
    if "by line" not in file.memo:
        file.memo["by line"] = _by_line(file)
    found: dict[int, list[ElementSpan]] = file.memo["by line"]
    return found.get(line, [])


def _by_line(file: FixableFile) -> dict[int, list[ElementSpan]]:
    found: defaultdict[int, list[ElementSpan]] = defaultdict(list)
    with suppress(UnplacedError):
        for element in spans(file.text).walk():
            first, last = (file.lines.place(offset).line for offset in element.start_tag)
            for each in range(first, last + 1):
                found[each].append(element)
    return found


TEXT_FIXERS: TextFixers = {
    rules.DEGREES_IN_EXPRESSION.name: _degrees,
    rules.EXPRESSION_WITHOUT_DOLLAR.name: _without_dollar,
    rules.MISSING_ARGUMENT.name: _missing_argument,
    rules.UNPREFIXED_ELEMENT.name: _unprefixed,
    rules.XACRO_ERROR.name: _unknown_name,
}
