"""Copies what refers to the contents of a `<replicate>` of MJCF: sensors, actuators, tendons and constraints.

They stand in other sections. An index by name finds them, since a file may have thousands of replicates and of sensors,
and how many copies there are in all is limited before they are made.
"""

from collections.abc import Container, Iterable, Sequence
from copy import deepcopy

from twinform.compiler.input.mjcf.copy_budget import CopyBudget, weight_of_tree
from twinform.compiler.input.mjcf.element_findings import TURN, ElementFindings
from twinform.schemas import XmlElement
from twinform.schemas.mjcf_references import KINDS, own_references, references_in, rename

_SECTIONS = ("contact", "tendon", "equality", "actuator", "sensor", "custom")
"""The sections whose elements are copied with what they refer to, each behind those that it may refer to."""
_NAMED_BY_SECTION = {"tendon": "tendon", "actuator": "actuator"}
_HELD_TOGETHER = frozenset({"connect", "weld", "joint", "tendon"})
_KINDS_OF_BODIES = frozenset(KINDS.values())

Names = dict[str, set[str]]


class Followers:
    """The elements of other sections by the names that they refer to, and how many may be made."""

    def __init__(self, root: XmlElement, budget: CopyBudget) -> None:
        self._budget = budget
        self._places: dict[XmlElement, int] = {}
        self._by_name: dict[str, list[XmlElement]] = {}
        self._sections = [each for tag in _SECTIONS for each in root.iterchildren(tag)]
        for section in self._sections:
            self._add(section.iterchildren("*"))

    def _add(self, elements: Iterable[XmlElement]) -> None:
        for element in elements:
            self._places[element] = len(self._places)
            for reference in references_in(element):
                self._by_name.setdefault(reference.name, []).append(element)

    def copy(
        self,
        names: Names,
        suffixes: Sequence[str],
        before: Container[str],
        replicate: XmlElement,
        findings: ElementFindings,
    ) -> None:
        """Copy all that refers to what a replicate has copied, once for each suffix, and take it out.

        All else that such an element refers to has to be among the names `before` the copies. As in MuJoCo, others are
        not copied, and constraints between what was copied and anything else are left out. Where there would be too
        many, this is reported, and none is made.
        """
        known = {kind: set(each) for kind, each in names.items()}
        found = self._find(known, before)
        kept = [each for each in found if _is_whole(each, known)]
        weight = sum(weight_of_tree(each, len(replicate.get("sep", ""))) for each in kept) * len(suffixes)
        if not self._budget.spend(weight, replicate, findings):
            return
        for suffix in suffixes:
            for each in kept:
                copy = deepcopy(each)
                if copy.get("name"):
                    copy.set("name", f"{copy.get('name')}{suffix}")
                rename(copy, known, lambda name, suffix=suffix: f"{name}{suffix}")
                if TURN in replicate.attrib:
                    copy.set(TURN, replicate.get(TURN, ""))
                section = each.getparent()
                if section is not None:
                    section.append(copy)
                    self._add([copy])
        for each in found:
            section = each.getparent()
            if section is not None:
                section.remove(each)

    def sort(self) -> None:
        """Let what is attached and what is copied stand in the order of attachments and replicates, as in MuJoCo."""
        for section in self._sections:
            if any(TURN in each.attrib for each in section):
                section[:] = sorted(section, key=lambda each: int(each.get(TURN, "0")))
            for each in section:
                each.attrib.pop(TURN, None)

    def _find(self, known: Names, before: Container[str]) -> list[XmlElement]:
        """Return all followers in the order of their sections, and add the names of those that have followers too."""
        found: list[XmlElement] = []
        pool = self._referring(name for each in known.values() for name in each)
        for section in self._sections:
            here = [each for each in pool if each.getparent() is section and _follows(each, known)]
            here = sorted((each for each in here if _can_follow(each, known, before)), key=self._places.__getitem__)
            found += here
            kind = _NAMED_BY_SECTION.get(str(section.tag))
            added = {name for each in here if (name := each.get("name"))} if kind else set[str]()
            if kind and added:
                known.setdefault(kind, set()).update(added)
                pool |= self._referring(added)
        return found

    def _referring(self, names: Iterable[str]) -> set[XmlElement]:
        return {each for name in names for each in self._by_name.get(name, ())}


def _follows(element: XmlElement, names: Names) -> bool:
    """Whether an element refers to one of some names."""
    return any(each.name in names.get(each.kind, ()) for each in references_in(element))


def _can_follow(element: XmlElement, names: Names, before: Container[str]) -> bool:
    """Whether all that an element refers to is copied, or known when the copies are made."""
    if element.tag in _HELD_TOGETHER:
        return True
    of_bodies = (each for each in references_in(element) if each.kind in _KINDS_OF_BODIES)
    return all(each.name in names.get(each.kind, ()) or each.name in before for each in of_bodies)


def _is_whole(element: XmlElement, names: Names) -> bool:
    """Whether all that a constraint holds together was copied: MuJoCo leaves others out."""
    if element.tag not in _HELD_TOGETHER:
        return True
    return all(each.name in names.get(each.kind, ()) for each in own_references(element))
