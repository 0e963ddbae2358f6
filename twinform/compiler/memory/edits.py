"""The changes that turn one XML tree into another, as XML, and making them where they still fit.

<tf:in part="link[arm]">                    go into a child
<tf:attribute name="k" was="1" value="2"/>  it said 1 and has to say 2; without `was` or `value` it was or is not there
<tf:text was="a">b</tf:text>                likewise for text; without `was` there is none
<tf:without part="inertial" was="..."/>     leave out a child that has this digest
<tf:instead part="origin" was="...">        put what is inside in its place
<tf:add part="link[b]" after="link[a]">     put what is inside behind this child; in front of all without `after`
<tf:move part="joint[j]" after="link[a]"/>  it stands elsewhere

Nothing is written as an empty attribute that can be left out: libsdformat prints an error for each that it reads.
"""

from bisect import bisect_left
from collections.abc import Iterator
from copy import deepcopy

from lxml import etree

from twinform.compiler.memory.keys import digest, keyed, same, stripped
from twinform.passes.legalise.carrier import NAMESPACE
from twinform.schemas import XmlElement

IN, ATTRIBUTE, TEXT, WITHOUT, INSTEAD, ADD, MOVE = (
    f"{{{NAMESPACE}}}{name}" for name in ("in", "attribute", "text", "without", "instead", "add", "move")
)
EDITS = frozenset({IN, ATTRIBUTE, TEXT, WITHOUT, INSTEAD, ADD, MOVE})


def changes(wanted: XmlElement, made: XmlElement) -> list[XmlElement]:
    """What has to be done to `made`, an element of the same tag, to say what `wanted` says; nothing if it does."""
    if same(wanted, made):
        return []
    here, there = keyed(wanted), keyed(made)
    found = [*_attributes(wanted, made), *_text(wanted, made)]
    found += [_edit(WITHOUT, part=key, was=digest(child)) for key, child in there.items() if key not in here]
    stay = _in_order([key for key in there if key in here], list(here))
    before: str | None = None
    for key, child in here.items():
        if key not in there:
            found.append(_edit(ADD, child, part=key, after=before))
        else:
            found += _inside(key, child, there[key])
            if key not in stay:
                found.append(_edit(MOVE, part=key, after=before))
        before = key
    return found


def _edit(tag: str, content: XmlElement | None = None, **attributes: str | None) -> XmlElement:
    made = etree.Element(tag, {name: value for name, value in attributes.items() if value is not None})
    if content is not None:
        made.append(deepcopy(content))
    return made


def _attributes(wanted: XmlElement, made: XmlElement) -> Iterator[XmlElement]:
    """In the order in which they are wanted: what stands behind its place is taken out, and put at the end again."""
    names = list(map(str, wanted.keys()))
    stay = [name for name in map(str, made.keys()) if name in names]
    ready = next((n for n, (one, other) in enumerate(zip(stay, names, strict=False)) if one != other), len(stay))
    for name in map(str, made.keys()):
        if name not in names[:ready]:
            yield _edit(ATTRIBUTE, name=name, was=made.get(name))
    for number, name in enumerate(names):
        was, value = made.get(name) if number < ready else None, wanted.get(name)
        if was != value:
            yield _edit(ATTRIBUTE, name=name, was=was, value=value)


def _text(wanted: XmlElement, made: XmlElement) -> Iterator[XmlElement]:
    if stripped(wanted.text) != stripped(made.text):
        edit = _edit(TEXT, was=stripped(made.text) or None)
        edit.text = stripped(wanted.text)
        yield edit


def _inside(key: str, wanted: XmlElement, made: XmlElement) -> list[XmlElement]:
    """The change of one child: of parts of it where most of it may stay, else of the whole."""
    if same(wanted, made):
        return []
    if stripped(wanted.tail) == stripped(made.tail):
        inner = changes(wanted, made)
        if _weight(inner) <= sum(1 for _ in wanted.iter()):
            edit = _edit(IN, part=key)
            edit.extend(inner)
            return [edit]
    return [_edit(INSTEAD, wanted, part=key, was=digest(made))]


def _weight(edits: list[XmlElement]) -> int:
    return sum(1 for edit in edits for _ in edit.iter())


def _in_order(made: list[str], wanted: list[str]) -> frozenset[str]:
    """As many of the keys as can stay where they are while the others move: the longest rising subsequence."""
    position = {key: index for index, key in enumerate(wanted)}
    ends: list[int] = []
    last: list[str] = []
    before: dict[str, str | None] = {}
    for key in made:
        place = bisect_left(ends, position[key])
        before[key] = last[place - 1] if place else None
        ends[place : place + 1], last[place : place + 1] = [position[key]], [key]
    stay: set[str] = set()
    key = last[-1] if last else None
    while key is not None:
        stay.add(key)
        key = before[key]
    return frozenset(stay)


def apply(edits: XmlElement, made: XmlElement, path: str = "") -> list[str]:
    """Make the changes inside `edits` to an element, and give the paths of those that do not fit it any more."""
    children = keyed(made)
    return [misfit for edit in edits for misfit in _apply(edit, made, children, path)]


def _apply(edit: XmlElement, made: XmlElement, children: dict[str, XmlElement], path: str) -> list[str]:
    key = edit.get("part") or ""
    where = f"{path}/{key}"
    if edit.tag == ATTRIBUTE:
        return _set(edit, made, path)
    if edit.tag == TEXT:
        return _write(edit, made, path)
    if edit.tag == ADD:
        children[key] = _put(deepcopy(edit[0]), edit, made, children)
        return []
    child = children.get(key)
    if child is None:
        return [] if edit.tag == WITHOUT else [where]
    if edit.tag == IN:
        return apply(edit, child, where)
    if edit.tag == MOVE:
        _put(child, edit, made, children)
        return []
    return [] if _replace(edit, child, made, children) else [where]


def _replace(edit: XmlElement, child: XmlElement, made: XmlElement, children: dict[str, XmlElement]) -> bool:
    """Put what the edit holds, if anything, in the place of a child, if that is still what it was."""
    if digest(child) != edit.get("was"):
        return False
    if edit.tag == WITHOUT:
        made.remove(child)
    else:
        content = children[edit.get("part") or ""] = deepcopy(edit[0])
        made.replace(child, content)
    return True


def _set(edit: XmlElement, made: XmlElement, path: str) -> list[str]:
    name, value = edit.get("name") or "", edit.get("value")
    if made.get(name) != edit.get("was"):
        return [f"{path}/@{name}"]
    if value is None:
        made.attrib.pop(name, None)
    else:
        made.set(name, value)
    return []


def _write(edit: XmlElement, made: XmlElement, path: str) -> list[str]:
    if stripped(made.text) != (edit.get("was") or ""):
        return [f"{path}/text()"]
    made.text = edit.text
    return []


def _put(child: XmlElement, edit: XmlElement, made: XmlElement, children: dict[str, XmlElement]) -> XmlElement:
    """Put a child behind the one that the edit names; at the end if that is gone."""
    after = edit.get("after") or ""
    if edit.tag == MOVE:
        made.remove(child)
    if not after:
        made.insert(0, child)
    elif after in children:
        children[after].addnext(child)
    else:
        made.append(child)
    return child
