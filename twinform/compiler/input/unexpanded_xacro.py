"""xacro in files that are not expanded: one finding about it, in the place of all that follows from it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from lxml import etree

from twinform.compiler.input.parsing import ASIDE
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, Rule, Severity, rules
from twinform.diagnostics.wording import cut, plural
from twinform.schemas import XmlElement
from twinform.schemas.xml import path_of

ELEMENTS = "xacro"
"""What is found where elements of xacro are."""
_EXPAND_HELP = "give the file the suffix .xacro, or pass --xacro"
# Neither part of the robot nor of what Gazebo makes of it: expressions there are for whoever reads
# them.
_SETTINGS = frozenset({"ros2_control", "transmission"})
_CUSTOM = "custom"
"""The section of MJCF for texts that MuJoCo keeps and does not read; some of them are our carriers."""
# Nearly no element has an expression, and libxml2 finds that out faster than Python.
_MAY_HAVE_EXPRESSIONS = etree.XPath("descendant-or-self::*[(text() | @*)[contains(., '${')]]")


def may_be_unexpanded(text: bytes) -> bool:
    """Tell whether a text has elements of xacro or expressions outside of its comments."""
    if not (b"<xacro:" in text or b"${" in text):
        return False
    without_comments = ASIDE.sub(lambda found: found[0] if found[0].startswith(b"<![") else b"", text)
    return b"<xacro:" in without_comments or b"${" in without_comments


def report_unexpanded(root: XmlElement, sink: DiagnosticSink) -> None:
    """Report elements of xacro and expressions as one: an error where the robot itself should be."""
    macros = list(elements_of_xacro(root))
    found = list(_with_expressions(root))
    if not (macros or found):
        return
    # A file that is not called `.xacro` and has `${...}` in its links or joints is a robot that
    # nobody wrote: an error. In <ros2_control> and <transmission> they are strings for another
    # program.
    expressions = [each for each in found if not each.is_aside]
    severity = Severity.ERROR if expressions else Severity.WARNING
    expressions = expressions or found
    shown = cut(expressions[0].text if expressions else ELEMENTS)
    parts = [f"{plural(len(macros), 'element')} of xacro"] if macros else []
    parts += [f"the expressions of {plural(len(expressions), 'element')}, such as {shown!r},"] if expressions else []
    if macros:
        where = Location(line=macros[0].sourceline or 0, path=f"/{root.tag}")
    else:
        where = Location(line=expressions[0].element.sourceline or 0, path=path_of(expressions[0].element))
    message = f"{' and '.join(parts)} will not be expanded"
    sink.report(
        rules.UNEXPANDED_XACRO,
        message,
        where,
        found=ELEMENTS if macros else shown,
        help=_EXPAND_HELP,
        severity=severity,
    )


def without_what_follows(
    found: Sequence[Diagnostic], sink: DiagnosticSink, follow: frozenset[Rule]
) -> Sequence[Diagnostic]:
    """Return what verification has found without what xacro would have made; that becomes the error in its place.

    Expressions are no values, and elements of xacro may make the parts that others name, by the rules that `follow`.
    """
    reported = next((each for each in sink.diagnostics if each.rule is rules.UNEXPANDED_XACRO), None)
    if reported is None:
        return found
    kept = [each for each in found if reported.found != ELEMENTS or each.rule not in follow]
    read = [each for each in sink.diagnostics if each.rule is not rules.INVALID_VALUE or "${" not in (each.found or "")]
    if len(kept) < len(found) or len(read) < len(sink.diagnostics):
        error = replace(reported, severity=Severity.ERROR)
        sink.diagnostics = [error if each is reported else each for each in read]
        sink.has_errors = True
    return kept


class _Expression(NamedTuple):
    """An element with `${...}`, and whether it is in a part that only other programs read."""

    element: XmlElement
    text: str
    is_aside: bool


def elements_of_xacro(root: XmlElement) -> Iterator[XmlElement]:
    """Yield the elements that only xacro reads."""
    for element in root.iter():
        tag = str(element.tag)
        if "xacro" in tag and tag.partition("}")[0].endswith("xacro"):
            yield element


def _with_expressions(root: XmlElement) -> Iterator[_Expression]:
    """Yield the elements that have `${...}`, except those that only plugins, programs of users or xacro read."""
    for element in _MAY_HAVE_EXPRESSIONS(root):
        around = {str(each.tag) for each in (element, *element.iterancestors())}
        if any(tag[0] == "{" or tag == "plugin" for tag in around) or _CUSTOM in around:
            continue
        texts = (element.text or "", *element.values())
        found = next((each.strip() for each in texts if "${" in each and "}" in each), None)
        if found is not None:
            yield _Expression(element, found, not _SETTINGS.isdisjoint(around))
