"""Which children of an element are which children of another state of it: the alignment of two lists of elements."""

from bisect import bisect_left
from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from collections.abc import Set as AbstractSet
from functools import partial

from twinform.schemas import XmlElement

BLANKS = " \t\r\n"
"""The white space of XML."""
Pair = tuple[int, int]
"""The places of a child in the lists before and after."""
Places = list[int]
_MANY = 2000
"""Lists of more elements that are alike are aligned from both ends only: difflib takes the square of their number."""


def stripped(text: str | None) -> str:
    """Strip the white space of XML from both ends of a text; None counts as empty."""
    return (text or "").strip(BLANKS)


def elements(parent: XmlElement) -> list[XmlElement]:
    """List the child elements, without comments and processing instructions."""
    return [child for child in parent if isinstance(child.tag, str)]


def spelled_alike(value: str) -> Hashable:
    """Make a key that two spellings of one value share: its numbers if it has nothing else, otherwise its words."""
    pieces = tuple(value.split())
    try:
        # Python reads 1_000 as a number; no reader of robots does.
        numbers = tuple(map(float, pieces))
    except ValueError:
        return pieces
    # Not a number differs from itself.
    return pieces if "_" in value or any(number != number for number in numbers) else numbers


def same_value(one: str | None, other: str | None) -> bool:
    """Tell whether two values differ in their spelling only."""
    if one is None or other is None:
        return one == other
    return one == other or spelled_alike(one) == spelled_alike(other)


def _as_written(value: str) -> Hashable:
    return value


class ElementContents:
    """Numbers elements by content, so that equal ones share a number; `value` makes the key to compare values by."""

    def __init__(self, value: Callable[[str], Hashable] = _as_written) -> None:
        self._value = value
        self._numbers: dict[Hashable, int] = {}
        self._of: dict[XmlElement, int] = {}

    def number(self, element: XmlElement) -> int:
        """Return the number of an element's content."""
        known = self._of.get(element)
        return known if known is not None else self._numbered(element)

    def _numbered(self, element: XmlElement) -> int:
        # From the inside out, so that each element is numbered once and no tree is too deep for it.
        for each in reversed([one for one in element.iter() if isinstance(one.tag, str)]):
            key = (
                each.tag,
                frozenset([(name, self._value(str(value))) for name, value in each.attrib.items()]),
                tuple(map(self._value, texts(each))),
                tuple(self._of[child] for child in elements(each)),
            )
            self._of[each] = self._numbers.setdefault(key, len(self._numbers))
        return self._of[element]


def texts(element: XmlElement) -> tuple[str, ...]:
    """Return the stripped texts directly in an element: before its first child element, and after each."""
    found = [element.text or ""]
    for child in element:
        if isinstance(child.tag, str):
            found.append(child.tail or "")
        else:
            found[-1] += child.tail or ""
    return tuple(map(stripped, found))


def aligned(before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents) -> list[Pair]:
    """Pair the elements of two lists that correspond, in order, by their places in the lists.

    First those that are equal, then between these those with the same tag and name, then those with the same tag. What
    is on the other side under its own name, if in another place, has not changed its name.
    """
    known = {key for each in before if (key := known_by(each))[1]} & set(map(known_by, after))
    numbers = [contents.number(each) for each in before], [contents.number(each) for each in after]
    pairs: list[Pair] = []
    for old, new, equal in blocks(*numbers):
        if equal:
            pairs.extend(zip(old, new, strict=True))
        else:
            pairs.extend(_by_name(before, after, old, new, known))
    return pairs


def known_by(element: XmlElement) -> tuple[str, str | None]:
    """Identify an element by its tag and its name, or by what a `<gazebo>` refers to."""
    return str(element.tag), element.get("name") or element.get("reference")


def matched(before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents) -> list[Pair]:
    """Pair the elements of two lists that correspond, whatever their order.

    First those that are equal, then those with the same tag and name, of several of a name the most similar ones, then
    those that have changed their names.
    """
    pairs = list(_in_groups(before, after, [], contents.number, _in_order))
    similar = partial(_most_similar, before, after, contents)
    pairs += _in_groups(before, after, pairs, known_by, similar)
    here, there = _unpaired(before, after, pairs)
    known = {known_by(before[i]) for i, _ in pairs}
    named = [i for i in here if known_by(before[i]) not in known], [j for j in there if known_by(after[j]) not in known]
    return pairs + list(_by_tag(before, after, *named))


def matched_children(
    before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents
) -> list[Pair]:
    """Pair the elements of two lists of which one is another state of the other, in the order of the list before.

    Where the name has changed, or the tag, most of what is inside has to be the same: of two parts that only resemble
    each other, one would get the edits of the other.
    """
    pairs = sorted(
        (i, j)
        for i, j in matched(before, after, contents)
        if known_by(before[i]) == known_by(after[j]) or _has_new_name(before[i], after[j], contents)
    )
    moved = set(moved_pairs(pairs))
    in_order = [pair for pair in pairs if pair not in moved]
    taken = {i for i, _ in moved}, {j for _, j in moved}
    found = with_renamed(in_order, before, after, contents)
    return sorted([*moved, *(pair for pair in found if pair[0] not in taken[0] and pair[1] not in taken[1])])


def _has_new_name(old: XmlElement, new: XmlElement, contents: ElementContents) -> bool:
    """Tell whether an element has only got another name, or another tag, by how many of its values it still has."""
    if old.tag != new.tag:
        return renamed(old, new, contents)
    values = _values(old), _values(new)
    return (values[0] & values[1]).total() >= max(1, _SHARE * max(each.total() for each in values))


def _values(element: XmlElement) -> Counter[Hashable]:
    """Count all attributes and texts in an element, except its own name."""
    inside = [(each.tag, *pair) for each in element.iter("*") for pair in (*each.items(), ("", stripped(each.text)))]
    return Counter(value for value in inside if value[2] and value != (element.tag, "name", element.get("name")))


def moved_pairs(pairs: Sequence[Pair]) -> list[Pair]:
    """Return the fewest pairs without which the others, given by their first places, are in order in both lists."""
    ends: list[int] = []
    """Of the runs of each length, the smallest last place, as in patience sorting."""
    lengths: list[int] = []
    for _, j in pairs:
        length = bisect_left(ends, j)
        ends[length : length + 1] = [j]
        lengths.append(length)
    moved: list[Pair] = []
    wanted = len(ends) - 1
    for pair, length in zip(reversed(pairs), reversed(lengths), strict=True):
        if length == wanted:
            wanted -= 1
        else:
            moved.append(pair)
    return moved[::-1]


def _unpaired(
    before: Sequence[XmlElement], after: Sequence[XmlElement], pairs: Sequence[Pair]
) -> tuple[Places, Places]:
    """Return the places in both lists that no pair has."""
    taken = {i for i, _ in pairs}, {j for _, j in pairs}
    return [i for i in range(len(before)) if i not in taken[0]], [j for j in range(len(after)) if j not in taken[1]]


def _in_groups(
    before: Sequence[XmlElement],
    after: Sequence[XmlElement],
    pairs: Sequence[Pair],
    key: Callable[[XmlElement], Hashable],
    pair: Callable[[Places, Places], Iterable[Pair]],
) -> Iterator[Pair]:
    """Pair elements with equal keys that no pair has yet."""
    here, there = _unpaired(before, after, pairs)
    groups = defaultdict[Hashable, tuple[Places, Places]](lambda: ([], []))
    for i in here:
        groups[key(before[i])][0].append(i)
    for j in there:
        groups[key(after[j])][1].append(j)
    for old, new in groups.values():
        if old and new:
            yield from pair(old, new)


def _in_order(old: Places, new: Places) -> Iterable[Pair]:
    return zip(old, new, strict=False)


def _most_similar(
    before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents, old: Places, new: Places
) -> Iterable[Pair]:
    """Pair the elements that have most in common; if one side has more, those with nothing in common stay alone."""
    if len(old) == len(new) == 1 or len(old) * len(new) > _MANY:
        return _in_order(old, new)
    parts = {i: _parts(before[i], contents) for i in old}, {j: _parts(after[j], contents) for j in new}
    common = {(i, j): (parts[0][i] & parts[1][j]).total() for i in old for j in new}
    pairs: list[Pair] = []
    for i, j in sorted(common, key=lambda pair: (-common[pair], *pair)):
        taken = any(i == here or j == there for here, there in pairs)
        if not taken and (common[i, j] or len(old) == len(new)):
            pairs.append((i, j))
    return pairs


def _parts(element: XmlElement, contents: ElementContents) -> Counter[Hashable]:
    """Count an element's attributes and all elements inside it."""
    inside: list[Hashable] = [contents.number(each) for each in element.iter("*") if each is not element]
    return Counter([*inside, *element.items()])


def _by_name(
    before: Sequence[XmlElement], after: Sequence[XmlElement], old: range, new: range, known: AbstractSet[Hashable]
) -> Iterator[Pair]:
    keys = [known_by(before[i]) for i in old], [known_by(after[i]) for i in new]
    for inner_old, inner_new, equal in blocks(*keys):
        here, there = [old[i] for i in inner_old], [new[i] for i in inner_new]
        if equal:
            yield from zip(here, there, strict=True)
        else:
            renamed = (
                [i for i in here if known_by(before[i]) not in known],
                [j for j in there if known_by(after[j]) not in known],
            )
            yield from _by_tag(before, after, *renamed)


def _by_tag(
    before: Sequence[XmlElement], after: Sequence[XmlElement], old: list[int], new: list[int]
) -> Iterator[Pair]:
    """Pair elements that were renamed, if there are as many with their tag before and after."""
    tags = [str(before[i].tag) for i in old], [str(after[j].tag) for j in new]
    counts = Counter(tags[0]), Counter(tags[1])
    # Where the number differs, nobody knows which of them has gone: guessed wrongly, one part would
    # get the edits of another.
    kept = [i for i, tag in zip(old, tags[0], strict=True) if counts[0][tag] == counts[1][tag]]
    waiting: dict[str, list[int]] = defaultdict(list)
    for j, tag in zip(reversed(new), reversed(tags[1]), strict=True):
        waiting[tag].append(j)
    last = -1
    for i in kept:
        j = waiting[str(before[i].tag)].pop()
        if j > last:
            yield i, j
            last = j


def blocks(before: Sequence[Hashable], after: Sequence[Hashable]) -> Iterator[tuple[range, range, bool]]:
    """Split both lists into ranges, each with whether the lists are equal there."""
    from difflib import SequenceMatcher  # noqa: PLC0415 - few texts differ

    # Most lists differ in one place. What is equal at both ends costs linear time and leaves little
    # for difflib, which takes the square.
    begin, end = _common(before, after)
    if begin:
        yield range(begin), range(begin), True
    old, new = range(begin, len(before) - end), range(begin, len(after) - end)
    if len(old) * len(new) > _MANY**2:
        yield old, new, False
    elif old or new:
        matcher = SequenceMatcher(None, [before[i] for i in old], [after[j] for j in new], autojunk=False)
        for kind, i, i_end, j, j_end in matcher.get_opcodes():
            yield old[i:i_end], new[j:j_end], kind == "equal"
    if end:
        yield range(old.stop, len(before)), range(new.stop, len(after)), True


def _common(before: Sequence[Hashable], after: Sequence[Hashable]) -> tuple[int, int]:
    """Count the equal elements at the beginning of both lists, and at the end of what remains."""
    most = min(len(before), len(after))
    begin = next((i for i in range(most) if before[i] != after[i]), most)
    left = most - begin
    end = next((i for i in range(left) if before[-1 - i] != after[-1 - i]), left)
    return begin, end


def same_element(one: XmlElement, other: XmlElement) -> bool:
    """Tell whether two elements differ in the spelling of numbers only."""
    contents = ElementContents(spelled_alike)
    return contents.number(one) == contents.number(other)


_SHARE = 0.5
"""How much of the children of two elements is equal where one is the other with a new name."""
_MOST = 10_000
"""So many pairs are compared between two that stay; where there are more, nothing is taken for renamed."""


def renamed(old: XmlElement, new: XmlElement, contents: ElementContents) -> bool:
    """Tell whether an element has only got another name; one in a namespace never has."""
    if "{" in f"{old.tag}{new.tag}":
        return False
    before, after = elements(old), elements(new)
    if not before or not after:
        return len(before) == len(after) and stripped(old.text) == stripped(new.text) != ""
    same = Counter(map(contents.number, before)) & Counter(map(contents.number, after))
    return sum(same.values()) >= _SHARE * max(len(before), len(after))


def with_renamed(
    pairs: Sequence[Pair], before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents
) -> list[Pair]:
    """Return the pairs with the renamed children added, in order."""
    found: list[Pair] = []
    last = (-1, -1)
    for pair in (*pairs, (len(before), len(after))):
        old, new = range(last[0] + 1, pair[0]), range(last[1] + 1, pair[1])
        if old and new and len(old) * len(new) <= _MOST:
            found += _between(old, new, before, after, contents)
        found.append(pair)
        last = pair
    return found[:-1]


def _between(
    old: range, new: range, before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents
) -> Iterator[Pair]:
    here = new.start
    for i in old:
        j = next((j for j in range(here, new.stop) if renamed(before[i], after[j], contents)), None)
        if j is not None:
            yield i, j
            here = j + 1
