"""Random edits of two people who work on one model, and what has to become of both: the judge of merges.

An edit knows the element of the base that it is about, so what both together make of the base is known without
comparing any texts: the edits of both are made in one copy of it.
"""

import random
from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from copy import deepcopy
from typing import NamedTuple

from lxml import etree

from twinform.schemas import XmlElement

_VALUES = ("1 2 3", "0.1", "a<b", 'quick "brown"', "7", "0 0 0 0.5 0 0")
Elements = Sequence[XmlElement]


class Edit(NamedTuple):
    """A change of the element with a number; `touches` are the places in the base that it is about."""

    make: Callable[[Elements], None]
    touches: frozenset[Hashable]
    removes: frozenset[int] = frozenset()
    """The elements that are no longer there."""
    inside: frozenset[int] = frozenset()
    """The elements that have to be there for it."""
    renames: frozenset[int] = frozenset()
    """The elements inside of one that gets another name, and itself."""
    sets: bool = False
    """Whether it writes a value that nobody else would write."""
    is_order: bool = False
    """Whether it only puts elements into another order, which says nothing."""


class Side(NamedTuple):
    """What one person has made of the base, and the edits that this took."""

    tree: XmlElement
    edits: tuple[Edit, ...]


def made_by(edits: Sequence[Edit], base: XmlElement) -> XmlElement:
    """Return a copy of a tree with edits."""
    made = deepcopy(base)
    numbered = list(made.iter("*"))
    for edit in edits:
        edit.make(numbered)
    return made


def random_side(base: XmlElement, chance: random.Random, who: str, times: int) -> Side:
    """Make some random edits, none of which undoes another.

    What has got a new name is not changed inside as well: nobody could tell it from another element.
    """
    numbered = list(base.iter("*"))
    edits: list[Edit] = []
    for count in range(times):
        number = chance.randrange(len(numbered))
        edit = chance.choice(_EDITS)(numbered, number, chance, f"{who}{count}")
        if edit is not None and not any(
            collide(edit, other) or _hides(edit, other) or _hides(other, edit) for other in edits
        ):
            edits.append(edit)
    return Side(made_by(edits, base), tuple(edits))


def collide(one: Edit, other: Edit) -> bool:
    """Whether two edits touch one value, or one removes what the other changes."""
    return bool(one.touches & other.touches or one.removes & other.inside or other.removes & one.inside)


def _hides(rename: Edit, other: Edit) -> bool:
    return max(other.inside) in rename.renames


def both_touch(ours: Side, theirs: Side, *, orders: bool = False) -> bool:
    """Whether both touch one value and not in the same way; `orders` says that an order counts as a value."""
    pairs = [
        (one, other)
        for one in ours.edits
        for other in theirs.edits
        if one.touches != other.touches or one.sets or other.sets
    ]
    return any(collide(*pair) and (orders or not any(each.is_order for each in pair)) for pair in pairs)


def content(element: XmlElement) -> Hashable:
    """Make a key of all that an element says, whatever the order of what is in it."""
    texts = [(each or "").strip() for each in (element.text, *(child.tail for child in element))]
    inside = Counter(content(child) for child in element if isinstance(child.tag, str))
    return element.tag, frozenset(element.items()), tuple(filter(None, texts)), frozenset(inside.items())


def _around(numbered: Elements, number: int) -> frozenset[int]:
    places = {each: i for i, each in enumerate(numbered)}
    own = numbered[number]
    return frozenset([number, *(places[each] for each in own.iterancestors())])


def _set_value(numbered: Elements, number: int, chance: random.Random, who: str) -> Edit | None:
    names = [str(name) for name in numbered[number].attrib if name != "name"]
    if not names:
        return None
    name, value = chance.choice(names), f"{chance.choice(_VALUES)} {who}"

    def make(each: Elements) -> None:
        each[number].set(name, value)

    return Edit(make, frozenset({(number, name)}), inside=_around(numbered, number), sets=True)


def _drop_value(numbered: Elements, number: int, chance: random.Random, _: str) -> Edit | None:
    names = [str(name) for name in numbered[number].attrib if name != "name"]
    if not names:
        return None
    name = chance.choice(names)

    def make(each: Elements) -> None:
        each[number].attrib.pop(name, None)

    return Edit(make, frozenset({(number, name)}), inside=_around(numbered, number))


def _new_value(numbered: Elements, number: int, chance: random.Random, who: str) -> Edit | None:
    name = chance.choice(["more", "extra"])
    if name in numbered[number].attrib:
        return None

    def make(each: Elements) -> None:
        each[number].set(name, who)

    return Edit(make, frozenset({(number, name)}), inside=_around(numbered, number), sets=True)


def _set_text(numbered: Elements, number: int, chance: random.Random, who: str) -> Edit | None:
    if len(numbered[number]) or not (numbered[number].text or "").strip():
        return None
    value = f"{chance.choice(_VALUES)} {who}"

    def make(each: Elements) -> None:
        each[number].text = value

    return Edit(make, frozenset({(number, "text()")}), inside=_around(numbered, number), sets=True)


def _remove(numbered: Elements, number: int, _: random.Random, __: str) -> Edit | None:
    own = numbered[number]
    if own.getparent() is None or (own.tail or "").strip():
        return None
    places = {each: i for i, each in enumerate(numbered)}
    inside = _around(numbered, number) - {number}

    def make(each: Elements) -> None:
        parent = each[number].getparent()
        if parent is not None:
            parent.remove(each[number])

    gone = frozenset(places[each] for each in own.iter("*"))
    return Edit(make, frozenset({(number, "there")}), gone, inside)


def _add(numbered: Elements, number: int, chance: random.Random, who: str) -> Edit | None:
    if (numbered[number].text or "").strip():
        return None
    place, tag = chance.randint(0, len(numbered[number])), chance.choice(["link", "frame", "visual", "new"])

    def make(each: Elements) -> None:
        made = etree.Element(tag, {"name": who})
        etree.SubElement(made, "inner", {"value": who})
        each[number].insert(min(place, len(each[number])), made)

    return Edit(make, frozenset(), inside=_around(numbered, number))


def _move(numbered: Elements, number: int, chance: random.Random, _: str) -> Edit | None:
    own, parent = numbered[number], numbered[number].getparent()
    if parent is None or (own.tail or "").strip() or len(parent) < 2:
        return None
    place = chance.randrange(len(parent))

    def make(each: Elements) -> None:
        around = each[number].getparent()
        if around is None:
            return  # the element has been removed, in either order
        around.remove(each[number])
        around.insert(min(place, len(around)), each[number])

    return Edit(make, frozenset({(number, "place")}), inside=_around(numbered, number), is_order=True)


def _rename(numbered: Elements, number: int, _: random.Random, who: str) -> Edit | None:
    if not numbered[number].get("name") or not len(numbered[number]):
        return None

    def make(each: Elements) -> None:
        each[number].set("name", f"renamed_{who}")

    inside = frozenset(range(number, number + len(list(numbered[number].iter("*")))))
    return Edit(make, frozenset({(number, "name")}), inside=_around(numbered, number), renames=inside, sets=True)


_EDITS = (_set_value, _set_value, _drop_value, _new_value, _set_text, _set_text, _remove, _add, _move, _rename)
