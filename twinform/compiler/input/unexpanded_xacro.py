"""Detects xacro in files that are not named so: macros and `${...}` that nobody will expand."""

from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink, Location, Severity
from twinform.diagnostics.rules import xacro as rules
from twinform.schemas import XmlElement
from twinform.schemas.xml import path_of

_HELP = "give the file the suffix .xacro, or pass --xacro"
_SETTINGS = frozenset({"ros2_control", "transmission"})
"""What is neither the robot nor becomes a part of it in Gazebo: expressions there are for whoever reads it."""


def report_unexpanded(root: XmlElement, sink: DiagnosticSink) -> None:
    """Report elements of xacro, and, as an error, expressions where the robot itself should be."""
    macros = [element for element in root.iter() if str(element.tag).partition("}")[0].endswith("xacro")]
    if macros:
        where = Location(line=macros[0].sourceline or 0, path=f"/{root.tag}")
        message = f"{_count(len(macros), 'element')} of xacro will not be expanded"
        sink.report(rules.UNEXPANDED_XACRO, message, where, found="xacro", help=_HELP)
    expressions, severity = list(_with_expressions(root, aside=_SETTINGS)), Severity.ERROR
    if not expressions:
        expressions, severity = list(_with_expressions(root)), Severity.WARNING
    if expressions:
        element, text = expressions[0]
        shown = text if len(text) <= 60 else text[:57] + "..."
        message = f"xacro expressions in {_count(len(expressions), 'element')} are not expanded: {shown!r}"
        where = Location(line=element.sourceline or 0, path=path_of(element))
        sink.report(rules.UNEXPANDED_XACRO, message, where, found=shown, help=_HELP, severity=severity)


def _with_expressions(root: XmlElement, aside: frozenset[str] = frozenset()) -> Iterator[tuple[XmlElement, str]]:
    """The elements that have `${...}`, but for those `aside`: what only plugins and xacro read is theirs."""
    stack = [root]
    while stack:
        element = stack.pop()
        if str(element.tag).startswith("{") or element.tag == "plugin" or element.tag in aside:
            continue
        texts = (element.text or "", *element.attrib.values())
        said = next((each.strip() for each in texts if "${" in each and "}" in each), None)
        if said is not None:
            yield element, said
        stack.extend(reversed(element))


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
