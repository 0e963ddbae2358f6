"""Finds the piece of an element that a finding is about: the value, the text or the name that is wrong.

It is the smallest piece that contains what was found, or the name in the start tag where that is in doubt.
"""

import re
from collections.abc import Iterable
from itertools import islice

from twinform.diagnostics import Diagnostic, Rule, Span, nearest_name, rules
from twinform.lazy import lazy_pattern
from twinform.text import AttributeSpan, ElementSpan
from twinform.text.tokens import COMMENT, INSTRUCTION

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
