"""Findings about the elements of a rewritten MJCF tree, reported where the file has the element that each came from.

A rewritten tree has other paths than the file: frames are gone, replicates are copied. Each element carries the number
of the one in the file that it came from, which copies of it carry too, until the numbers are taken out.
"""

from collections.abc import Iterator
from copy import deepcopy
from typing import Unpack

from lxml import etree

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Rule
from twinform.schemas import Context, XmlElement
from twinform.schemas.messages import FindingDetails

NUMBER = "twinform-number"
"""The attribute that has the number of an element."""
SLOT = "twinform-slot"
"""The attribute that has the number of a part in the keyframes of an attached model."""

TURN = "twinform-turn"
"""The attribute that has the place of a replicate or an attached model among them, which orders what comes of it."""


@dataclass(slots=True)
class ElementFindings:
    """Reports at elements of a file; `count` is how many there were."""

    context: Context
    originals: list[XmlElement]
    count: int = 0

    def report(
        self, rule: Rule, element: XmlElement, message: str, step: str = "", **more: Unpack[FindingDetails]
    ) -> None:
        """Report at the element of the file that one of the tree came from, or at a step below it."""
        self.count += 1
        number = element.get(NUMBER, "0")
        self.context.report(rule, self.originals[int(number)], message, step, **more)

    def silent(self) -> "ElementFindings":
        """Return findings about the same file that nobody is told of."""
        context = self.context
        return ElementFindings(Context(DiagnosticSink(), context.file, context.format, context.version), self.originals)


def numbered_copy(root: XmlElement) -> tuple[XmlElement, list[XmlElement]]:
    """Copy a tree, with the number of each element in the list of those that were copied; comments are left out."""
    copy = deepcopy(root)
    originals: list[XmlElement] = []
    for number, (original, element) in enumerate(zip(_elements(root), _elements(copy), strict=True)):
        element.set(NUMBER, str(number))
        originals.append(original)
    return copy, originals


def give_number(element: XmlElement, other: XmlElement) -> None:
    """Let the findings about an element, and all below it, be reported where those about another one are."""
    number = other.get(NUMBER, "0")
    for each in _elements(element):
        each.set(NUMBER, number)
        set_line(each, other)


def set_line(element: XmlElement, other: XmlElement) -> None:
    """Let an element be on the line of another one."""
    element.sourceline = other.sourceline  # pyright: ignore[reportAttributeAccessIssue] - lxml lets it be set


def take_numbers_out(root: XmlElement) -> None:
    """Remove the numbers from a tree, and those of attached models."""
    etree.strip_attributes(root, NUMBER, SLOT, TURN)


def _elements(root: XmlElement) -> Iterator[XmlElement]:
    return root.iter("*")
