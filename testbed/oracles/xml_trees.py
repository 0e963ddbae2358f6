"""Whether two XML files say the same, judged without the compiler.

Free are: white space, comments, processing instructions, the spelling of numbers, namespace declarations, and the
order of siblings with different names. Everything else counts: names, attributes, text, and the order of siblings with
the same name. Inside `FREE_CONTENT`, which belongs to other programs, all order counts and text has one spelling.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from lxml import etree
from lxml.etree import _Element as XmlElement  # pyright: ignore[reportPrivateUsage] - lxml has no public name for it

FREE_CONTENT = frozenset({"plugin", "gazebo", "transmission", "ros2_control"})
IDENTIFIERS = frozenset(
    {"attached_to", "canonical_link", "child", "filename", "frame", "joint", "link", "name", "parent"}
    | {"placement_frame", "reference", "relative_to", "type", "uri", "version"}
)
"""Elements and attributes whose text is a name, where `1` and `1.0` are two different things."""

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\Z")
_LOST = "is missing"
_NEW = "was added"


class Pair(NamedTuple):
    """The same place in the two files."""

    source: XmlElement
    result: XmlElement
    path: str
    free: bool = False


@dataclass(frozen=True, slots=True)
class Names:
    """How elements and attributes are called: by namespace, or as written where a file leaves prefixes unbound."""

    as_written: bool

    def of(self, element: XmlElement) -> str:
        """The name that two elements must share."""
        if not self.as_written:
            return str(element.tag)
        return f"{element.prefix}:{_local(element)}" if element.prefix else _local(element)

    def attributes(self, element: XmlElement) -> dict[str, str]:
        """The attributes by the names that two elements must share."""
        if not self.as_written:
            return {str(name): str(value) for name, value in element.attrib.items()}
        prefixes = {uri: prefix for prefix, uri in element.nsmap.items() if prefix}
        return {_written(str(name), prefixes): str(value) for name, value in element.attrib.items()}


def first_difference(source: bytes, result: bytes) -> str | None:
    """The first thing in which the result differs from the source, or None.

    The source may be as malformed as real files are, and is then read as far as libxml2 can repair it; the result
    must be well-formed.
    """
    before, after = _parse_leniently(source), etree.fromstring(result, _parser())
    names = Names(as_written=_has_unbound_prefix(before))
    return next(_differences(Pair(before, after, f"/{names.of(before)}"), names), None)


def is_well_formed(data: bytes) -> bool:
    """Whether a strict XML parser takes it."""
    try:
        etree.fromstring(data, _parser())
    except etree.XMLSyntaxError:
        return False
    return True


def _parser(*, recover: bool = False) -> etree.XMLParser:
    return etree.XMLParser(
        recover=recover, remove_comments=True, remove_pis=True, resolve_entities=False, no_network=True
    )


def _parse_leniently(data: bytes) -> XmlElement:
    try:
        return etree.fromstring(data, _parser())
    except etree.XMLSyntaxError:
        # a declaration without its bracket leaves libxml2 with no element at all
        return etree.fromstring(b"<" + data if data.startswith(b"?xml") else data, _parser(recover=True))


def _has_unbound_prefix(root: XmlElement) -> bool:
    return any(":" in str(name).rpartition("}")[2] for node in root.iter("*") for name in (node.tag, *node.attrib))


def _local(element: XmlElement) -> str:
    return str(element.tag).rpartition("}")[2]


def _written(name: str, prefixes: dict[str, str]) -> str:
    if not name.startswith("{"):
        return name
    uri, _, local = name[1:].partition("}")
    return f"{prefixes[uri]}:{local}" if uri in prefixes else f"xml:{local}"


def _differences(pair: Pair, names: Names) -> Iterator[str]:
    if names.of(pair.source) != names.of(pair.result):
        yield f"{pair.path}: <{names.of(pair.source)}> became <{names.of(pair.result)}>"
        return
    free = pair.free or _local(pair.source) in FREE_CONTENT
    pair = pair._replace(free=free)
    yield from _attribute_differences(pair, names)
    before, after = _text(pair.source), _text(pair.result)
    if not _same_text(before, after, exact=free or names.of(pair.source) in IDENTIFIERS):
        yield f"{pair.path}: text {before!r} became {after!r}"
    yield from _child_differences(pair, names)


def _attribute_differences(pair: Pair, names: Names) -> Iterator[str]:
    before, after = names.attributes(pair.source), names.attributes(pair.result)
    for name, value in before.items():
        if name not in after:
            yield f"{pair.path}/@{name}: {value!r} {_LOST}"
        elif not _same_text(value, after[name], exact=pair.free or name in IDENTIFIERS):
            yield f"{pair.path}/@{name}: {value!r} became {after[name]!r}"
    yield from (f"{pair.path}/@{name}: {value!r} {_NEW}" for name, value in after.items() if name not in before)


def _child_differences(pair: Pair, names: Names) -> Iterator[str]:
    before, after = _by_name(pair.source, names), _by_name(pair.result, names)
    for name in dict.fromkeys([*before, *after]):
        mine, theirs = before.get(name, []), after.get(name, [])
        for index in range(max(len(mine), len(theirs))):
            path = f"{pair.path}/{_step(name, max(mine, theirs, key=len), index)}"
            if index >= len(theirs):
                yield f"{path} {_LOST}"
            elif index >= len(mine):
                yield f"{path} {_NEW}"
            else:
                yield from _differences(Pair(mine[index], theirs[index], path, pair.free), names)
    if pair.free and [names.of(child) for child in pair.source] != [names.of(child) for child in pair.result]:
        yield f"{pair.path}: the order of the children changed"


def _by_name(element: XmlElement, names: Names) -> dict[str, list[XmlElement]]:
    groups: dict[str, list[XmlElement]] = {}
    for child in element:
        groups.setdefault(names.of(child), []).append(child)
    return groups


def _step(name: str, siblings: list[XmlElement], index: int) -> str:
    own = siblings[index].get("name")
    if own is not None:
        return f"{name}[@name='{own}']"
    return name if len(siblings) == 1 else f"{name}[{index + 1}]"


def _text(element: XmlElement) -> str:
    # a blank stands for each child, so that text on its two sides does not run together
    pieces = [element.text or "", *(child.tail or "" for child in element)]
    return " ".join(" ".join(pieces).split())


def _same_text(before: str, after: str, *, exact: bool) -> bool:
    mine, theirs = before.split(), after.split()
    if exact or mine == theirs:
        return mine == theirs
    return len(mine) == len(theirs) and all(_same_token(*tokens) for tokens in zip(mine, theirs, strict=True))


def _same_token(before: str, after: str) -> bool:
    if before == after:
        return True
    return bool(_NUMBER.match(before) and _NUMBER.match(after)) and float(before) == float(after)
