"""Three-way merges of trees: what changed between two states of a document is changed in a third one too.

The third tree is how a person wrote the document. It may spell numbers otherwise and say more than the first. Where it
was changed too and says something else about a part that changed, that is a conflict, and nothing is decided.
"""

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterator, Sequence
from copy import deepcopy
from dataclasses import field
from functools import cache
from itertools import takewhile
from typing import NamedTuple

from lxml import etree

from twinform.dataclass import dataclass
from twinform.schemas import Fact, XmlElement, table
from twinform.text.alignment import (
    ElementContents,
    elements,
    known_by,
    matched_children,
    moved_pairs,
    same_value,
    spelled_alike,
    stripped,
    texts,
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
        if before.tag != after.tag and own.tag not in (before.tag, after.tag) and not self.same:
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

    def _is_unchanged(self, old: str | None, here: str | None) -> bool:
        """Tell whether the person's value is still the one before the change."""
        return self.same or same_value(old, here)

    def _attributes(self, before: XmlElement, after: XmlElement, own: XmlElement) -> None:
        for name in dict.fromkeys(map(str, [*before.attrib, *after.attrib])):
            old, new, here = before.get(name), after.get(name), own.get(name)
            if old == new or same_value(new, here):
                continue
            if not self._is_unchanged(old, here):
                self._conflict(own, f"{name} of {_shown(own)} {_changes(old, new, here)}")
            elif new is None:
                own.attrib.pop(name, None)
            else:
                own.set(name, new)

    def _text(self, before: XmlElement, after: XmlElement, own: XmlElement) -> None:
        old, new, here = (texts(each)[0] for each in (before, after, own))
        if old == new or same_value(new, here):
            return
        if self._is_unchanged(old, here):
            _set_text(own, new)
        else:
            self._conflict(own, f"the text of {_shown(own)} {_changes(old or None, new or None, here or None)}")

    def _mixed(self, before: XmlElement, after: XmlElement, own: XmlElement) -> None:
        """Replace a content that has text between its elements, as a whole."""
        inside = [[texts(each), *map(self.alike.number, elements(each))] for each in (before, after, own)]
        if inside[0] == inside[1] or inside[1] == inside[2]:
            return
        if not self.same and inside[0] != inside[2]:
            self._conflict(own, f"what is in {_shown(own)} has changed here too")
            return
        own.text = after.text
        own[:] = [deepcopy(each) for each in elements(after)]

    def _children(
        self, before: XmlElement, after: XmlElement, owns: Sequence[XmlElement]
    ) -> Iterator[tuple[XmlElement, XmlElement, Sequence[XmlElement]]]:
        """Delete, move and insert children, and yield the ones that all three trees have."""
        old, new, mine = elements(before), elements(after), [each for own in owns for each in elements(own)]
        pairs = matched_children(old, new, self.exact)
        kept = {j: i for i, j in pairs}
        stay = {i for i, _ in pairs}
        moved = {j for _, j in moved_pairs(pairs)}
        here = {i: [mine[k], *self._like(mine, k)] for i, k in matched_children(old, mine, self.alike)}
        gone = [i for i in range(len(old)) if i not in stay]
        known = {id(each) for group in here.values() for each in group}
        added = _Additions([each for each in mine if id(each) not in known], self.alike)
        replaced = any(i not in here for i in gone)
        self._delete(old, [i for i in gone if i in here], here)
        behind: XmlElement | None = None
        for j, each in enumerate(new):
            own = here.get(kept[j]) if j in kept else None
            if own is not None:
                if j in moved:
                    behind = self._move(own, owns[0], behind)
                yield old[kept[j]], each, own
                behind = own[-1]
            elif j not in kept:
                behind, twins = self._add(each, owns[0], added, behind, replaced=replaced)
                yield from twins
            elif self.exact.number(old[kept[j]]) != self.exact.number(each):
                if self.same:
                    behind = self._insert(owns[0], deepcopy(each), behind)
                else:
                    self._conflict(owns[0], f"{_shown(each)} has changed, and is not there")

    def _add(
        self, each: XmlElement, own: XmlElement, added: "_Additions", behind: XmlElement | None, *, replaced: bool
    ) -> tuple[XmlElement | None, list[tuple[XmlElement, XmlElement, Sequence[XmlElement]]]]:
        """Insert a new child, unless the person has added it too; return what the next one stands behind.

        If the person has added another state of it, return both with an empty one, from which they come: what only one
        of them says is in both then.
        """
        if self.alike.number(each) in added.numbers:
            return behind, []
        twin = added.twin(each)
        if twin is not None:
            return behind, [(etree.Element(each.tag), each, [twin])]
        # Both have put something else in the place of what is gone, such as another shape.
        rivals = added.unnamed if replaced and not known_by(each)[1] else []
        if rivals and not self.same:
            self._conflict(rivals[0], f"{_shown(rivals[0])} stands here for what becomes {_shown(each)}")
            return behind, []
        behind = added.last_behind(behind, own)
        made = self._insert(own, deepcopy(each), behind)
        for one in rivals:
            own.remove(one)
        rivals.clear()
        return made, []

    @staticmethod
    def _move(own: Sequence[XmlElement], parent: XmlElement, behind: XmlElement | None) -> XmlElement | None:
        """Move an element to where the change has moved it; the blanks around it stay."""
        if len(own) > 1:
            return behind
        (moved,) = own
        around = moved.getparent()
        if around is not None:
            _keep_tail(around, moved)
            around.remove(moved)
        return _Merging._insert(parent, moved, behind)

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
        if any(_comments(own) - _comments(old) for own in owns):
            return True
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


def _set_text(element: XmlElement, text: str) -> None:
    """Write the text before the first child element, behind the comment that it stands behind."""
    asides = takewhile(lambda each: not isinstance(each.tag, str), element)
    behind = [each for each in asides if stripped(each.tail)]
    first = behind[0] if behind and not stripped(element.text) else None
    for each in behind:
        each.tail = None
    if first is None:
        element.text = text
    else:
        first.tail = text


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


def _comments(element: XmlElement) -> Counter[str]:
    return Counter(stripped(comment.text) for comment in element.iter(etree.Comment))


def _changes(old: str | None, new: str | None, here: str | None) -> str:
    """Say what a value was, is here, and becomes."""
    was, becomes, now = ("absent" if each is None else repr(each) for each in (old, new, here))
    return f"was {was}, is {now} here, and becomes {becomes}"


def _shown(element: XmlElement) -> str:
    name = element.get("name")
    return f"<{element.tag}> {name!r}" if name else f"<{element.tag}>"


class _Additions:
    """The children that the person has added to an element."""

    def __init__(self, added: Sequence[XmlElement], alike: ElementContents) -> None:
        self.numbers = {alike.number(each) for each in added}
        self.unnamed = [each for each in added if not known_by(each)[1]]
        self._by_name = {(each.tag, each.get("name")): each for each in reversed(added)}
        self._all = set(added)

    def twin(self, other: XmlElement) -> XmlElement | None:
        """Return the addition that is another state of an element: it has its name, or only one of them can stand."""
        found = self._by_name.get((other.tag, other.get("name")))
        if found is None or other.get("name"):
            return found
        parent = found.getparent()
        is_single = parent is not None and (str(parent.tag), str(found.tag)) in _single_parts()
        return found if is_single else None

    def last_behind(self, element: XmlElement | None, parent: XmlElement) -> XmlElement | None:
        """Return the last of the additions that follow an element, or without one those that begin the parent."""
        here = element.getnext() if element is not None else next(iter(parent), None)
        while here is not None and (here in self._all or not isinstance(here.tag, str)):
            element, here = here if isinstance(here.tag, str) else element, here.getnext()
        return element


@cache
def _single_parts() -> frozenset[tuple[str, str]]:
    """Return the elements that stand once in their parents in both formats, each behind its parent."""
    found: dict[tuple[str, str], bool] = {}
    tables = [table("urdf"), table("sdf")]
    pending: list[tuple[str, Fact]] = [
        (name, row) for each in tables for name, fact in each.definitions.items() for row in fact.children
    ]
    while pending:
        around, row = pending.pop()
        found[around, row.name] = found.get((around, row.name), True) and not row.repeats
        pending.extend((row.name, inner) for inner in row.children)
    return frozenset(pair for pair, single in found.items() if single)
