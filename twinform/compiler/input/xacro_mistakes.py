"""Reports mistakes in xacro files that expand without an error: unused definitions, and errors in expressions.

All of it is found in the texts, so that what stands in a branch that was not taken counts as well. What a file that
others include defines may be used by them, so unused definitions are looked for in the outermost file only.
"""

import math
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.input.parsing import UnreadableError, parse
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement

EXPRESSION = lazy_pattern(r"\$\{[^}]*\}|\$\([^)]*\)")
"""An expression, or a substitution."""
WORD = lazy_pattern(r"[A-Za-z_]\w*")
"""What may be a name in an expression."""
_BRACES = lazy_pattern(r"(?<![\w{])\{([A-Za-z_]\w*)\}")
ANGLE = lazy_pattern(r"(?<![\w.])(?:math\.)?(?P<call>(?P<function>sin|cos|tan)\(\s*(?P<angle>-?\d+(?:\.\d*)?)\s*\))")
MACRO_PARAMETER = lazy_pattern(r"(?<![*^|])[*^|]*+(?P<name>[A-Za-z_][\w.]*)(?:\s*:?=\s*(?:'[^']*'|\"[^\"]*\"|\S+))?")
"""One of the parameters of a macro, with its default."""
_EFFECT = lazy_pattern(r"xacro\.|\.\w+\(")
"""What a property can be defined for without being used, such as `${masses.append(mass)}`."""
_DEFINES = frozenset({"arg", "macro", "property"})
_FOR_OTHERS = frozenset({*_DEFINES, "include", "if", "unless", "material"})
_WORDS = {"arg": "argument", "macro": "macro", "property": "property"}
MOST_TAGS = 100_000
"""A file with more tags is not searched; no real one has half as many."""
_MOST = 100
"""So many findings of a kind are reported."""


class _File(NamedTuple):
    """A xacro file and its elements."""

    name: str
    elements: list[XmlElement]


class _Definition(NamedTuple):
    """A definition, and its place among the elements of its file."""

    kind: str
    name: str
    element: XmlElement
    number: int


def report_mistakes(main: str, texts: Mapping[str, bytes], sink: DiagnosticSink) -> None:
    """Report the mistakes in the files of an expansion, of which `main` is the outermost."""
    files = [_File(name, list(root.iter("*"))) for name, root in _roots(texts)]
    report_unprefixed(texts, sink)
    variables = _variables(files)
    for file in files:
        _report_overwritten(file, sink)
        _report_degrees(file, sink)
        _report_braces(file, variables, sink)
    own = next((file for file in files if file.name == main), None)
    if own is not None and _makes_a_robot(own):
        _report_unused(own, files, sink)


def report_unprefixed(texts: Mapping[str, bytes], sink: DiagnosticSink) -> None:
    """Report elements of xacro, and calls of macros, without the prefix: today's xacro leaves them as they are."""
    files = [_File(name, list(root.iter("*"))) for name, root in _roots(texts)]
    robots = [file for file in files if file.elements[0].tag == "robot"]
    macros = {str(each.get("name")) for file in robots for each in file.elements if _is_macro(each)}
    for file in robots:
        for each in file.elements:
            if _is_unprefixed(each) or (each.tag in macros and _is_call(each)):
                message = f"<{each.tag}> has no prefix, and xacro reads <xacro:{each.tag}> only"
                sink.report(rules.UNPREFIXED_ELEMENT, message, _place(file, each), found=str(each.tag))


def without_unprefixed(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Return findings without those that an element is unknown which lacks the prefix of xacro."""
    listed = list(findings)
    unprefixed = {_tag_and_line(each) for each in listed if each.rule is rules.UNPREFIXED_ELEMENT}
    return [each for each in listed if each.rule is not rules.UNKNOWN_ELEMENT or _tag_and_line(each) not in unprefixed]


def _tag_and_line(finding: Diagnostic) -> tuple[str, int, str | None]:
    return finding.location.file, finding.location.line, finding.found


def _is_macro(element: XmlElement) -> bool:
    return xacro_kind(element) == "macro" or (element.tag == "macro" and _is_unprefixed(element))


_MARKS = {
    "arg": {"name", "default"},
    "if": {"value"},
    "include": {"filename"},
    "insert_block": {"name"},
    "macro": {"name", "params"},
    "property": {"name", "value"},
    "unless": {"value"},
}
"""Elements that xacro once read without a prefix, and the attributes by which they are known."""
_OF_GAZEBO = ("gazebo", "plugin", "ros2_control", "transmission")


def _is_unprefixed(element: XmlElement) -> bool:
    marks = _MARKS.get(str(element.tag))
    if not marks or not marks.issubset(map(str, element.keys())):
        return False
    return next(element.iterancestors(*_OF_GAZEBO), None) is None


def _is_call(element: XmlElement) -> bool:
    """Whether an element with the name of a macro stands where no part of a robot has that name."""
    parent = element.getparent()
    return parent is not None and element.tag not in _PARTS and (parent.tag == "robot" or bool(xacro_kind(parent)))


_PARTS = frozenset({"gazebo", "joint", "link", "material", "robot", "ros2_control", "sensor", "transmission"})


def _roots(texts: Mapping[str, bytes]) -> Iterator[tuple[str, XmlElement]]:
    for name, text in texts.items():
        if text.count(b"<") > MOST_TAGS:
            continue
        try:
            yield name, parse(text, DiagnosticSink(name))
        except UnreadableError:
            continue


def xacro_kind(element: XmlElement) -> str:
    """Return the name of an element of xacro, such as `property`; empty for any other element."""
    uri, _, local = str(element.tag)[1:].rpartition("}")
    return local if uri.endswith("xacro") else ""


def _values(element: XmlElement) -> Iterator[str]:
    """Yield the attributes of an element and the texts in it and behind it."""
    yield from map(str, element.values())
    yield from filter(None, (element.text, element.tail))


def _words(text: str) -> set[str]:
    """Return the words in the expressions of a text."""
    if "$" not in text:  # as most texts, which go through here several times
        return set()
    return {word for expression in EXPRESSION.findall(text) for word in WORD.findall(expression)}


def _used_in(elements: Iterable[XmlElement]) -> set[str]:
    """Return all words that may be names which elements use, except those of macros."""
    used: set[str] = set()
    for element in elements:
        kind = xacro_kind(element)
        for value in _values(element):
            used |= _words(value)
        if kind == "insert_block":
            used.add(element.get("name") or "")
        if kind == "property":  # its value may be an expression of another one
            used.update(WORD.findall(element.get("value") or element.get("default") or ""))
        if kind == "macro" and "^" in (element.get("params") or ""):  # the parameter takes what a property holds
            used.update(WORD.findall(element.get("params") or ""))
    return used


def _definitions(file: _File) -> Iterator[_Definition]:
    for number, element in enumerate(file.elements):
        kind, name = xacro_kind(element), (element.get("name") or "").removeprefix("xacro:")
        if kind in _DEFINES and name and "$" not in name:
            yield _Definition(kind, name, element, number)


def _makes_a_robot(file: _File) -> bool:
    """Whether a file has parts of a robot, and not only definitions for the files that include it."""
    parts = [xacro_kind(child) or child.tag for child in file.elements[0].iterchildren("*")]
    return "name" in file.elements[0].attrib and any(part not in _FOR_OTHERS for part in parts)


def _report_unused(own: _File, files: Iterable[_File], sink: DiagnosticSink) -> None:
    """Report what a file defines and nothing in it and the files that it includes uses."""
    if not (defined := list(_definitions(own))):
        return
    everything = [element for file in files for element in file.elements]
    used, called = _used_in(everything), {xacro_kind(element).rpartition(".")[2] for element in everything}
    if any(xacro_kind(element) == "call" for element in everything):
        called |= {word for element in everything for value in _values(element) for word in WORD.findall(value)}
    unused = [
        each
        for each in defined
        if each.name not in (called if each.kind == "macro" else used)
        and not _EFFECT.search(each.element.get("value") or "")
    ]
    for each in unused[:_MOST]:
        message = f"nothing uses the {_WORDS[each.kind]} {each.name!r}"
        sink.report(rules.UNUSED_DEFINITION, message, _place(own, each.element), found=each.name)


def _report_overwritten(file: _File, sink: DiagnosticSink) -> None:
    """Report a property or macro that is defined again in the same place before anything can have used it."""
    last: dict[tuple[str, str, XmlElement | None], _Definition] = {}
    uses: _Uses | None = None
    for each in _definitions(file):
        if each.kind == "arg" or not _is_plain(each.element):
            continue
        key = (each.kind, each.name, each.element.getparent())
        before = last.get(key)
        last[key] = each
        if before is None:
            continue
        uses = uses or _Uses(file)
        if uses.may_be_between(before, each):
            continue
        line = each.element.sourceline or 0
        message = f"the {_WORDS[each.kind]} {each.name!r} is defined again in line {line}, and never used before"
        sink.report(rules.OVERWRITTEN_DEFINITION, message, _place(file, before.element), found=each.name)


def _is_plain(element: XmlElement) -> bool:
    """Whether a definition always counts, in its own scope."""
    return not any(name in element.attrib for name in ("default", "remove", "scope"))


class _Uses:
    """Where the elements of a file use names, by their numbers."""

    def __init__(self, file: _File) -> None:
        self._others: list[int] = []
        """Includes, calls and conditions, in which anything may be used."""
        self._words: dict[str, list[int]] = {}
        for number, element in enumerate(file.elements):
            if (kind := xacro_kind(element)) and kind not in _DEFINES:
                self._others.append(number)
            for word in _used_in((element,)):
                self._words.setdefault(word, []).append(number)

    def may_be_between(self, before: _Definition, after: _Definition) -> bool:
        """Tell whether anything may use a definition before another one takes its place."""
        end = before.number + sum(1 for _ in before.element.iter("*"))
        if _is_any(self._others, end, after.number) or _is_any(self._words.get(before.name, ()), end, after.number):
            return True
        return before.name in _words(after.element.get("value") or "")


def _is_any(numbers: Sequence[int], start: int, end: int) -> bool:
    """Tell whether any of some numbers in order lies in a range."""
    place = bisect_left(numbers, start)
    return place < len(numbers) and numbers[place] < end


def _report_degrees(file: _File, sink: DiagnosticSink) -> None:
    """Report angles in degrees that a function takes for radians."""
    for element, expression in _expressions(file):
        for found in ANGLE.finditer(expression):
            if abs(float(found["angle"])) > 2 * math.pi:
                function, angle = found["function"], found["angle"]
                message = f"{found['call']} takes {angle} radians, which is {float(angle) / (2 * math.pi):.1f} turns"
                advice = f"write {function}(radians({angle})) if it is meant in degrees"
                sink.report(rules.DEGREES_IN_EXPRESSION, message, _place(file, element), found=angle, help=advice)


def _expressions(file: _File) -> Iterator[tuple[XmlElement, str]]:
    for element in file.elements:
        for value in _values(element):
            for expression in EXPRESSION.findall(value) if "$" in value else ():
                yield element, expression


def _variables(files: Iterable[_File]) -> set[str]:
    """Return the names of all properties and parameters."""
    found: set[str] = set()
    for file in files:
        for each in _definitions(file):
            if each.kind == "property":
                found.add(each.name)
            if each.kind == "macro":
                found.update(one["name"] for one in MACRO_PARAMETER.finditer(each.element.get("params") or ""))
    return found


def _report_braces(file: _File, known: set[str], sink: DiagnosticSink) -> None:
    """Report a property or parameter in braces without the dollar that makes an expression of them."""
    for element in file.elements:
        for value in map(str, (*element.values(), element.text or "")):
            for name in _BRACES.findall(EXPRESSION.sub(" ", value)) if "{" in value else ():
                if name in known:
                    message = f"{{{name}}} is the text itself: an expression begins with a dollar"
                    place = _place(file, element)
                    advice = f"write ${{{name}}}"
                    sink.report(rules.EXPRESSION_WITHOUT_DOLLAR, message, place, found=f"{{{name}}}", help=advice)


def _place(file: _File, element: XmlElement) -> Location:
    return Location(file.name, element.sourceline or 0)


def with_calls(findings: Iterable[Diagnostic], texts: Mapping[str, bytes]) -> list[Diagnostic]:
    """Add to findings about names that one place has made twice which calls of a macro have made them."""
    files = {name: _File(name, list(root.iter("*"))) for name, root in _roots(texts)}
    advice: dict[Location, str | None] = {}
    found: list[Diagnostic] = []
    for each in findings:
        place = Location(each.location.file, each.location.line)
        twice = each.rule is rules.DUPLICATE_NAME and any(
            (other.file, other.line) == (place.file, place.line) for other in each.related
        )
        if twice and place not in advice:
            advice[place] = _repeated_calls(place, files)
        found.append(replace(each, help=advice[place]) if twice and advice[place] else each)
    return found


def _repeated_calls(place: Location, files: Mapping[str, _File]) -> str | None:
    """Say where the macro around a place is called twice with the same values."""
    here = [each for each in files[place.file].elements if each.sourceline == place.line] if place.file in files else []
    around = (outer for each in here for outer in each.iterancestors("*") if xacro_kind(outer) == "macro")
    macro = next(around, None)
    if macro is None:
        return None
    name = (macro.get("name") or "").removeprefix("xacro:")
    calls: dict[tuple[tuple[str, str], ...], list[str]] = {}
    for file in files.values():
        for each in file.elements:
            if xacro_kind(each).rpartition(".")[2] == name:
                values = tuple(sorted((str(key), str(value)) for key, value in each.items()))
                calls.setdefault(values, []).append(f"{Path(file.name).name}:{each.sourceline}")
    several = [each for each in calls.items() if len(each[1]) > 1]
    if not several:
        return None
    values, places = several[0]
    shown = "".join(f' {key}="{value}"' for key, value in values)
    return f"<xacro:{name}{shown}> is called at {' and '.join(places[:3])}"
