"""What of a robot a consumer cannot read, or needs and does not find: a table of demands held against its elements."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace

from twinform.profiles.reading import transmissions, tree_facts
from twinform.profiles.reading.forms import FORMS
from twinform.profiles.reading.nodes import Paths, RawNode
from twinform.profiles.reading.reads_notation import Demand, PlaceStep, Reads

IsThere = Callable[[str], bool]
"""Whether a URI leads to a file."""
_ITEMS = re.compile(r"[\w:.-]+\??")


@dataclass(frozen=True, slots=True)
class Shortfall:
    """A demand that a robot does not meet: `kind` is "value", "absent", "unread", "tree" or "text".

    `path` is that of the element or attribute that it is about, and `fact` the name of a fact of the tree.
    """

    kind: str
    effect: str
    about: str
    message: str
    line: int
    path: str = ""
    found: str | None = None
    expected: str | None = None
    pipeline: str = ""
    fact: str = ""
    node: RawNode | None = field(default=None, repr=False, compare=False)


def shortfalls(root: RawNode, table: Reads, is_there: IsThere) -> Iterator[Shortfall]:
    """All demands that are not met, in the order of the table."""
    paths = Paths(root)
    for each in _unmet(root, table, is_there):
        above = paths.of(each.node) if each.node else "/"
        yield replace(each, path=above + each.path)


def _unmet(root: RawNode, table: Reads, is_there: IsThere) -> Iterator[Shortfall]:
    for demand in table.demands:
        if demand.item in tree_facts.FACTS:
            for node, message in tree_facts.FACTS[demand.item](root):
                yield _short(demand, "tree", message, node, fact=demand.item)
            continue
        for node in _found(root, demand.place):
            if demand.form == "file":
                yield from _file(demand, node, is_there)
            else:
                yield from _held(demand, node)


def _file(demand: Demand, node: RawNode, is_there: IsThere) -> Iterator[Shortfall]:
    uri = node.attributes.get(demand.item[1:])
    if uri and not is_there(uri):
        message = f"{demand.item[1:]!r} of <{node.tag}> is {uri!r}, which is not there"
        yield _short(demand, "value", message, node, found=uri)


def _found(node: RawNode, place: tuple[PlaceStep, ...]) -> Iterator[RawNode]:
    if not place:
        yield node
        return
    step, *rest = place
    for child in _children(node, step):
        if not step.types or (child.attributes.get("type", "") in step.types) != step.other:
            yield from _found(child, tuple(rest))


def _children(node: RawNode, step: PlaceStep) -> Iterable[RawNode]:
    if step.first:
        return [child for child in node.children[:1] if child.tag == step.tag]
    # Readers in C++ take the first element of a name (`FirstChildElement`) and never look at a
    # second one.
    same = node.all(step.tag)
    return same if step.every else (child for child in (next(same, None),) if child is not None)


def _held(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    if demand.form == "known":
        yield from _unknown(demand, node)
    elif demand.form == "transmission":
        if message := transmissions.objection(node):
            yield _short(demand, "absent", message, node)
    elif demand.item.startswith("@"):
        yield from _attribute(demand, node)
    elif demand.item == "#text":
        yield from _value(demand, node, f"the text of <{node.tag}>", node.text)
    else:
        yield from _element(demand, node)


def _attribute(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    names = demand.item[1:].split("|")
    given = [name for name in names if name in node.attributes]
    if demand.form == "none":
        yield from (_strange(demand, node, name) for name in given)
        return
    if not given and demand.needed:
        wanted = " or ".join(map(repr, names))
        yield _short(demand, "absent", f"<{node.tag}> has no attribute {wanted}", node, expected=wanted)
    for name in given:
        yield from _value(demand, node, f"{name!r} of <{node.tag}>", node.attributes[name], f"/@{name}")


def _value(demand: Demand, node: RawNode, what: str, text: str, below: str = "") -> Iterator[Shortfall]:
    words, reads = FORMS[demand.form] if demand.form in FORMS else _one_of(demand.form)
    if not reads(text):
        yield _short(demand, "value", f"{what} is {text!r}", node, found=text, expected=words, below=below)


def _strange(demand: Demand, node: RawNode, name: str) -> Shortfall:
    return _short(demand, "unread", f"<{node.tag}> has an attribute {name!r}", node, below=f"/@{name}")


def _one_of(form: str) -> tuple[str, Callable[[str], bool]]:
    choice = form.removeprefix("=").split("|")
    return " or ".join(choice), choice.__contains__


def _element(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    names = demand.item.strip("<>").split("|")
    if demand.form == "none":
        yield from (
            _short(demand, "unread", f"<{node.tag}> has a <{tag.tag}>", tag)
            for tag in node.children
            if tag.tag in names
        )
    elif demand.form == "once" and (again := [tag for tag in node.children if tag.tag in names][1:]):
        yield _short(demand, "unread", f"<{node.tag}> has a second <{again[0].tag}>", again[0])
    elif demand.form in {"first", "single"}:
        if demand.form == "single" and len(node.children) != 1:
            yield _short(demand, "unread", f"<{node.tag}> has {len(node.children)} elements", node, expected="one")
        elif not node.children:
            yield _short(demand, "absent", f"<{node.tag}> is empty", node, expected=" or ".join(names))
        elif (shape := node.children[0]).tag not in names:
            yield _short(
                demand, "unread", f"<{node.tag}> begins with <{shape.tag}>", shape, expected=" or ".join(names)
            )
    elif demand.needed and not any(child.tag in names for child in node.children):
        wanted = " or ".join(f"<{name}>" for name in names)
        yield _short(demand, "absent", f"<{node.tag}> has no {wanted}", node, expected=wanted)


def _unknown(demand: Demand, node: RawNode) -> Iterator[Shortfall]:
    """Attributes or children that are not among those that are known, or are there twice and known once."""
    known = _ITEMS.findall(demand.item)
    names = {name.removesuffix("?") for name in known}
    if demand.item.startswith("@"):
        strange = (name for name in node.attributes if name not in names)
        yield from (_strange(demand, node, name) for name in strange)
        return
    once, met = {name[:-1] for name in known if name.endswith("?")}, set[str]()
    for child in node.children:
        if child.tag not in names:
            yield _short(demand, "unread", f"<{node.tag}> has a <{child.tag}>", child)
        elif child.tag in once and child.tag in met:
            yield _short(demand, "unread", f"<{node.tag}> has a second <{child.tag}>", child)
        met.add(child.tag)


def _short(
    demand: Demand,
    kind: str,
    message: str,
    node: RawNode,
    *,
    found: str | None = None,
    expected: str | None = None,
    below: str = "",
    fact: str = "",
) -> Shortfall:
    what = (kind, demand.effect, demand.about, message, node.line, below)
    return Shortfall(*what, found, expected, demand.pipeline, fact, node)
