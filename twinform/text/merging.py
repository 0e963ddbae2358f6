"""Three-way merges of trees: what changed between two states of a document is changed in a third one too.

The third tree is how a person wrote the document. It may spell numbers otherwise and say more than the first. Where it
was changed too and says something else about a part that changed, that is a conflict, and nothing is decided.
"""

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from typing import NamedTuple

from twinform.schemas import XmlElement
from twinform.text.alignment import (
    ElementContents,
    aligned,
    elements,
    known_by,
    matched,
    same_value,
    spelled_alike,
    stripped,
    texts,
    with_renamed,
)


class Conflict(NamedTuple):
    """A change that cannot be merged: the element of the person's tree that it is about, and the reason."""

    element: XmlElement
    message: str


@dataclass(frozen=True, slots=True)
class Merge:
    """The result of a merge; `tree` must not be used if there are conflicts."""

    tree: XmlElement
    conflicts: tuple[Conflict, ...]


def merge(
    before: XmlElement,
    after: XmlElement,
    own: XmlElement,
    *,
    at: XmlElement | None = None,
    same: bool = False,
    additive: str | None = None,
) -> Merge:
    """Copy the tree `own`, and make in it all changes between `before` and `after`; `at` is the element they go into.

    `same` means that `before` was made of `own` and says the same, so that nothing can be a conflict: what differs
    between them is how they say it. Elements called `additive` in the root add up where they are known by the same, and
    any number of them stands for one.
    """
    made = deepcopy(own)
    originals = dict(zip(made.iter("*"), own.iter("*"), strict=True))
    merging = _Merging(originals, same, additive)
    target = made if at is None else next(copy for copy, each in originals.items() if each is at)
    merging.element(added_up(before, additive), added_up(after, additive), [target])
    return Merge(made, tuple(merging.conflicts))


def added_up(root: XmlElement, additive: str | None) -> XmlElement:
    """Copy a tree so that elements that add up stand as one; return the tree itself if there are none."""
    groups = defaultdict[Hashable, list[XmlElement]](list)
    for child in root.iterchildren(additive) if additive else ():
        groups[known_by(child), tuple(sorted(child.items()))].append(child)
    if all(len(group) == 1 for group in groups.values()):
        return root
    made = deepcopy(root)
    places = {each: i for i, each in enumerate(root)}
    children = [*made]
    for first, *others in groups.values():
        for other in others:
            child = children[places[other]]
            children[places[first]].extend([*child])
            made.remove(child)
    return made


@dataclass(slots=True)
class _Merging:
    """One merge; `originals` maps each element of the copy to the person's own."""

    originals: dict[XmlElement, XmlElement]
    same: bool
    additive: str | None = None
    exact: ElementContents = field(default_factory=ElementContents)
    alike: ElementContents = field(default_factory=lambda: ElementContents(spelled_alike))
    conflicts: list[Conflict] = field(default_factory=list[Conflict])

    def element(self, before: XmlElement, after: XmlElement, owns: Sequence[XmlElement]) -> None:
        """Change an element in place, with all in it; `owns` has several if they add up."""
        # What our writer spells otherwise than the author is the same in `before` and `after`, and
        # so is never touched.
        if self.exact.number(before) == self.exact.number(after):
            return
        own = owns[0]
        if before.tag != after.tag and own.tag != before.tag:
            self._conflict(own, f"<{before.tag}> becomes <{after.tag}>")
            return
        for each in owns:
            each.tag = each.tag if before.tag == after.tag else after.tag
            self._attributes(before, after, each)
        if any(texts(before)[1:]) or any(texts(after)[1:]):
            self._mixed(before, after, own)
            return
        pairs = [*self._children(before, after, owns)]
        self._text(before, after, own)
        for triple in pairs:
            self.element(*triple)

    def _conflict(self, own: XmlElement, message: str) -> None:
        self.conflicts.append(Conflict(self.originals.get(own, own), message))

    def _is(self, old: str | None, here: str | None) -> bool:
        """Tell whether the person's value is still the one before the change."""
        return self.same or same_value(old, here)

    def _attributes(self, before: XmlElement, after: XmlElement, own: XmlElement) -> None:
        for name in dict.fromkeys(map(str, [*before.attrib, *after.attrib])):
            old, new, here = before.get(name), after.get(name), own.get(name)
            if old == new or same_value(new, here):
                continue
            if not self._is(old, here):
                self._conflict(own, f"{name} is {here!r} here and was {old!r}, and becomes {new!r}")
            elif new is None:
                own.attrib.pop(name, None)
            else:
                own.set(name, new)

    def _text(self, before: XmlElement, after: XmlElement, own: XmlElement) -> None:
        old, new, here = stripped(before.text), stripped(after.text), stripped(own.text)
        if old == new or same_value(new, here):
            return
        if self._is(old, here):
            own.text = new
        else:
            self._conflict(own, f"the text is {here!r} here and was {old!r}, and becomes {new!r}")

    def _mixed(self, before: XmlElement, after: XmlElement, own: XmlElement) -> None:
        """Replace a content that has text between its elements, as a whole."""
        inside = [[texts(each), *map(self.alike.number, elements(each))] for each in (before, after, own)]
        if inside[0] == inside[1] or inside[1] == inside[2]:
            return
        if not self.same and inside[0] != inside[2]:
            self._conflict(own, "what is in it has changed here too")
            return
        own.text = after.text
        own[:] = [deepcopy(each) for each in elements(after)]

    def _children(
        self, before: XmlElement, after: XmlElement, owns: Sequence[XmlElement]
    ) -> Iterator[tuple[XmlElement, XmlElement, Sequence[XmlElement]]]:
        """Delete and insert children, and yield the ones that all three trees have."""
        old, new, mine = elements(before), elements(after), [each for own in owns for each in elements(own)]
        kept = {j: i for i, j in with_renamed(aligned(old, new, self.exact), old, new, self.exact)}
        here = {i: [mine[k], *self._like(mine, k)] for i, k in matched(old, mine, self.alike)}
        stay = set(kept.values())
        gone = [i for i in range(len(old)) if i not in stay]
        known = {id(each) for group in here.values() for each in group}
        added = {self.alike.number(each) for each in mine if id(each) not in known}
        moved = {self.exact.number(old[i]): here[i][0] for i in gone if i in here}
        self._delete(old, [i for i in gone if i in here], here)
        behind: XmlElement | None = None
        for j, each in enumerate(new):
            if j in kept and kept[j] in here:
                yield old[kept[j]], each, here[kept[j]]
                behind = here[kept[j]][-1]
            elif j in kept:
                if self.exact.number(old[kept[j]]) == self.exact.number(each):
                    continue
                if self.same:
                    behind = self._insert(owns[0], deepcopy(each), behind)
                else:
                    self._conflict(owns[0], f"{_shown(each)} has changed, and is not there")
            elif self.alike.number(each) not in added:
                behind = self._insert(owns[0], deepcopy(moved.get(self.exact.number(each), each)), behind)

    def _like(self, mine: Sequence[XmlElement], k: int) -> Iterator[XmlElement]:
        """Yield the other elements that add up with one."""
        if mine[k].tag == self.additive:
            yield from (each for i, each in enumerate(mine) if i != k and known_by(each) == known_by(mine[k]))

    def _delete(self, old: Sequence[XmlElement], gone: list[int], here: dict[int, list[XmlElement]]) -> None:
        for i in gone:
            if not self.same and self._differs(old[i], here[i]):
                self._conflict(here[i][0], f"{_shown(old[i])} is deleted, and has been changed here")
                continue
            for each in here[i]:
                parent = each.getparent()
                if parent is not None:
                    _keep_tail(parent, each)
                    parent.remove(each)

    def _differs(self, old: XmlElement, owns: Sequence[XmlElement]) -> bool:
        """Tell whether the person changed an element, or one that adds up with it."""
        if len(owns) == 1:
            return self.alike.number(old) != self.alike.number(owns[0])
        inside = Counter(self.alike.number(each) for own in owns for each in elements(own))
        return inside != Counter(map(self.alike.number, elements(old)))

    @staticmethod
    def _insert(own: XmlElement, made: XmlElement, behind: XmlElement | None) -> XmlElement:
        made.tail = None
        parent = own if behind is None else behind.getparent()
        if parent is None or behind is None:
            own.insert(0, made)
        else:
            parent.insert(parent.index(behind) + 1, made)
            made.tail, behind.tail = behind.tail, None
        return made


def _keep_tail(parent: XmlElement, child: XmlElement) -> None:
    """Move the text behind a child to where it stays when the child is removed."""
    tail = stripped(child.tail)
    previous = child.getprevious()
    if not tail:
        return
    if previous is None:
        parent.text = (parent.text or "") + tail
    else:
        previous.tail = (previous.tail or "") + tail


def _shown(element: XmlElement) -> str:
    name = element.get("name")
    return f"<{element.tag}> {name!r}" if name else f"<{element.tag}>"
