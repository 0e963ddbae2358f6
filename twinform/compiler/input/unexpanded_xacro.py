"""Detects xacro in files that are not named so: macros and `${...}` that nobody will expand."""

from collections.abc import Iterator
from typing import NamedTuple

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Location, Severity, rules
from twinform.schemas import XmlElement
from twinform.schemas.xml import path_of

_HELP = "give the file the suffix .xacro, or pass --xacro"
# Neither part of the robot nor of what Gazebo makes of it: expressions there are for whoever reads
# them.
_SETTINGS = frozenset({"ros2_control", "transmission"})
# Nearly no element has an expression, and libxml2 finds that out faster than Python.
_MAY_HAVE_EXPRESSIONS = etree.XPath("descendant-or-self::*[(text() | @*)[contains(., '${')]]")


def report_unexpanded(root: XmlElement, sink: DiagnosticSink) -> None:
    """Report elements of xacro, and, as an error, expressions where the robot itself should be."""
    macros = [element for element in root.iter() if "xacro" in (tag := str(element.tag)) and _is_of_xacro(tag)]
    if macros:
        where = Location(line=macros[0].sourceline or 0, path=f"/{root.tag}")
        message = f"{_count(len(macros), 'element')} of xacro will not be expanded"
        sink.report(rules.UNEXPANDED_XACRO, message, where, found="xacro", help=_HELP)
    found = list(_with_expressions(root))
    # A file that is not called `.xacro` and has `${...}` in its links or joints is a robot that
    # nobody wrote: an error. In <ros2_control> and <transmission> they are strings for another
    # program.
    expressions, severity = [each for each in found if not each.is_aside], Severity.ERROR
    if not expressions:
        expressions, severity = found, Severity.WARNING
    if expressions:
        element, text, _ = expressions[0]
        shown = text if len(text) <= 60 else text[:57] + "..."
        message = f"xacro expressions in {_count(len(expressions), 'element')} are not expanded: {shown!r}"
        where = Location(line=element.sourceline or 0, path=path_of(element))
        sink.report(rules.UNEXPANDED_XACRO, message, where, found=shown, help=_HELP, severity=severity)


class _Expression(NamedTuple):
    """An element that has `${...}`, and whether it is in what only others read."""

    element: XmlElement
    text: str
    is_aside: bool


def _is_of_xacro(tag: str) -> bool:
    return tag.partition("}")[0].endswith("xacro")


def _with_expressions(root: XmlElement) -> Iterator[_Expression]:
    """The elements that have `${...}`; what only plugins and xacro read is theirs."""
    for element in _MAY_HAVE_EXPRESSIONS(root):
        around = {str(each.tag) for each in (element, *element.iterancestors())}
        if any(tag[0] == "{" or tag == "plugin" for tag in around):
            continue
        texts = (element.text or "", *element.values())
        found = next((each.strip() for each in texts if "${" in each and "}" in each), None)
        if found is not None:
            yield _Expression(element, found, not _SETTINGS.isdisjoint(around))


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
