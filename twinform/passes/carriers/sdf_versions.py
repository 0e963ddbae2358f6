"""Carriers of parts of other SDF versions, inside a file of a version that lacks them.

Such a carrier names the versions that have its part:

    <tf:version since="1.11" at="axis"><mimic/></tf:version>       an element that 1.11 brought
    <tf:version until="1.6" at="pose" attribute="frame" value=""/> an attribute that went after 1.6
    <tf:version since="1.7" index="0"><frame/></tf:version>        the first of several
    <tf:version since="1.8" without="pose"/>                       a field that is written only for older versions
    <tf:version since="1.9" instead="pose"><pose/></tf:version>    what stands for a sibling in an untyped element
"""

from dataclasses import replace
from typing import TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import Location, Rule
from twinform.ir import Element, Node, Opaque
from twinform.passes.carriers.carriers import NAMESPACE, Attributes, Keeper, is_carrier, pack, unpack
from twinform.schemas import Version, parse_version, print_version

DIALECT = "version"

AnyNode = TypeVar("AnyNode", bound=Node)


@dataclass(frozen=True, slots=True)
class VersionCondition:
    """The versions that have a carried part, and how it comes back.

    `index` is its place in a list, `without` are fields that it removes when it comes back, `instead` is the sibling
    that it replaces.
    """

    since: Version | None = None
    until: Version | None = None
    index: int | None = None
    without: tuple[str, ...] = ()
    instead: str = ""

    def fit(self, version: Version) -> bool:
        """Whether a version has the part."""
        return (self.since is not None and version >= self.since) or (self.until is not None and version <= self.until)

    def attributes(self) -> Attributes:
        """The attributes of the carrier."""
        bounds = {
            "since": print_version(self.since) if self.since else "",
            "until": print_version(self.until) if self.until else "",
            "index": "" if self.index is None else str(self.index),
            "without": " ".join(self.without),
            "instead": self.instead,
        }
        return tuple((name, text) for name, text in bounds.items() if text)


class VersionKeeper(Keeper):
    """Carries the parts that a version of SDF lacks, and enters them into the ledger."""

    __slots__ = ()

    def keep(
        self,
        node: AnyNode,
        pieces: list[Opaque],
        condition: VersionCondition,
        rule: Rule,
        message: str,
        where: Location,
        weight: int,
    ) -> AnyNode:
        """The node with the pieces in carriers, and an entry in the ledger."""
        self.account(rule, message, where, weight)
        if not self.carriers:
            return node
        return node.copy(opaque=(*node.opaque, *version_carriers(pieces, condition)))

    def keep_element(
        self, piece: Opaque, condition: VersionCondition, rule: Rule, message: str, where: Location
    ) -> tuple[Element, ...]:
        """The carriers of a part of an untyped element, and an entry in the ledger."""
        self.account(rule, message, where, max(1, piece.weight))
        carriers = version_carriers([piece], condition) if self.carriers else ()
        return tuple(part.element for part in carriers if part.element)


def version_carriers(pieces: list[Opaque], condition: VersionCondition) -> tuple[Opaque, ...]:
    """The carriers of pieces, and one that only names fields to remove; the last is unpacked first."""
    carriers = pack(pieces, DIALECT, replace(condition, without=()).attributes())
    if not condition.without:
        return carriers
    return (
        *carriers,
        Opaque.unchecked(
            element=Element.unchecked(name=f"{{{NAMESPACE}}}{DIALECT}", attributes=condition.attributes())
        ),
    )


def is_version_carrier(part: Opaque) -> bool:
    """Whether an opaque part is a carrier of another version of SDF."""
    return is_carrier(part, DIALECT)


def condition_of(part: Opaque) -> VersionCondition:
    """The condition of a carrier; one with invalid attributes fits no version."""
    bounds = dict(part.element.attributes) if part.element else {}
    try:
        return VersionCondition(
            parse_version(bounds["since"]) if "since" in bounds else None,
            parse_version(bounds["until"]) if "until" in bounds else None,
            int(bounds["index"]) if "index" in bounds else None,
            tuple(bounds.get("without", "").split()),
            bounds.get("instead", ""),
        )
    except ValueError:
        return VersionCondition()


def carried(part: Opaque) -> tuple[Opaque, ...]:
    """The pieces in a carrier; none in one that only names fields to remove."""
    element = part.element
    if element is None or (not element.children and element.get("attribute") is None and element.get("text") is None):
        return ()
    return unpack(part)
