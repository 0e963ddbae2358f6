"""From the IR to text: what the generated writers of `schemas/generated/` share.

A writer takes a node and returns its element as text, with the line break and the indent before it. It writes what has
a typed field; `TextOutput.unusual` adds what has none, and notes where a node stands in the text.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from functools import lru_cache
from itertools import count
from typing import Any

from lxml import etree

from twinform.dataclass import dataclass
from twinform.ir.versions import Version
from twinform.lazy import lazy_pattern
from twinform.schemas.facts import in_order
from twinform.schemas.value_types import format_numbers, format_value, parse_bool

Write = Callable[[Any, "TextOutput", str], str]
"""Writes a node: (node, output, indent)"""
Item = tuple[Any, Any]
"""A node, and what writes it."""
Arrange = Callable[[Any, list[Item]], tuple[list[Item], list[Item]]]
"""Puts the parts of a node in the order in which they have to stand; the second ones stand behind all others."""
WrittenParts = list[tuple[Any, int]]
"""Parts that know their source, each with the place in the text where the start tag of its element begins."""

NEW_LINE = "\n"
"""The indent of the root."""


class _NoIndent(str):
    """The indent of a text without layout, in which that of what is inside is none either."""

    __slots__ = ()

    def __add__(self, value: str, /) -> str:
        return self


NO_LAYOUT = _NoIndent()
_STEP = "  "
_ZERO = (0.0, 0.0, 0.0)
_PLAIN_NAME = lazy_pattern(r"[A-Za-z_][A-Za-z0-9_.-]*")
_NOT_IN_XML = "\0-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff"
# Whatever is not here stands as it is, so that each "<" in a text written here begins a tag.
_ODD_IN_TEXT = lazy_pattern(f"[&<>\r{_NOT_IN_XML}]")
_ODD_IN_ATTRIBUTE = lazy_pattern(f'[&<>"\n\t\r{_NOT_IN_XML}]')
_NEVER = lazy_pattern(f"[{_NOT_IN_XML}]")
_INCOMPATIBLE = "All strings must be XML compatible: Unicode or ASCII, no NULL bytes or control characters"
_REFERENCES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\n": "&#10;", "\t": "&#9;", "\r": "&#13;"}
# XML declares this prefix itself.
_KNOWN = {"": "", "http://www.w3.org/XML/1998/namespace": "xml:"}
_MOST_NAMES = 4096
# Stands around the number of a part, behind the name of its element: no text of XML can hold it.
_MARK = "\0"


def in_text(value: str) -> str:
    """A string as the text of an element.

    Raises:
        ValueError: XML cannot hold it.
    """
    return value if value.isidentifier() or not _ODD_IN_TEXT.search(value) else _ODD_IN_TEXT.sub(_reference, value)


def in_attribute(value: str) -> str:
    """A string as the value of an attribute, between double quotes.

    Raises:
        ValueError: XML cannot hold it.
    """
    if value.isidentifier() or not _ODD_IN_ATTRIBUTE.search(value):
        return value
    if _NEVER.search(value):
        raise ValueError(_INCOMPATIBLE)
    for character, reference in _REFERENCES.items():  # in a carrier there are dozens, and a substitution takes longer
        value = value.replace(character, reference)
    return value


def _reference(found: re.Match[str]) -> str:
    if found[0] not in _REFERENCES:
        raise ValueError(_INCOMPATIBLE)
    return _REFERENCES[found[0]]


def bool_text(node: Any, field: str) -> str:
    """A truth value of a node, in its own spelling, as the text of an element."""
    return in_text(_spelling(node, field))


def bool_attribute(node: Any, field: str) -> str:
    """A truth value of a node, in its own spelling, as the value of an attribute."""
    return in_attribute(_spelling(node, field))


def _spelling(node: Any, field: str) -> str:
    # `1` and `true` are the same boolean and different text, so that a file comes out as it
    # went in. A spelling that no longer fits the value is not used: a pass has changed it.
    spelt, value = node.spelling.get(field) if node.spelling else None, getattr(node, field)
    return spelt if spelt is not None and parse_bool(spelt) == value else format_value(value)


def vector3(values: Sequence[float]) -> str:
    """Write a vector; nearly all have three numbers."""
    x, y, z = values
    return f"{x!r} {y!r} {z!r} ".replace(".0 ", " ")[:-1]


def pose_numbers(pose: Any) -> str | None:
    """Return the six or seven numbers of a pose; none if it has none."""
    xyz, rotation = pose.xyz, pose.quat_xyzw
    if rotation is None:
        rotation = pose.rpy
        if xyz is None and rotation is None:
            return None
    turn = vector3(rotation or _ZERO) if not rotation or len(rotation) == 3 else format_numbers(rotation)
    return f"{vector3(xyz or _ZERO)} {turn}"


def namespace_of(name: str) -> str:
    """Return the namespace of a name in the notation `{namespace}name`; empty where it has none."""
    return name[1:].partition("}")[0] if name.startswith("{") else ""


class _PrefixNames(dict[str, str]):
    """Names with their prefixes, by their names in the IR; KeyError for a namespace without a prefix."""

    def __init__(self, prefixes: Mapping[str, str]) -> None:
        super().__init__()
        self.prefixes = prefixes

    def __missing__(self, name: str) -> str:
        local = name.rpartition("}")[2]
        if not _PLAIN_NAME.fullmatch(local):
            etree.QName(name)  # ValueError for what is no name
        written = self.prefixes[namespace_of(name)] + local
        if len(self) < _MOST_NAMES:  # they outlive the file
            self[name] = written
        return written


@dataclass(slots=True)
class _Additions:
    """What is added to an element beside its typed fields; `inner` has what is added to its children, by name.

    `order` has what is written behind all else: untyped parts, and the names of children that may have to be made.
    """

    attributes: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    texts: list[str] = field(default_factory=list[str])
    order: list[Any] = field(default_factory=list[Any])
    inner: "dict[str, _Additions]" = field(default_factory=dict[str, Any])

    @classmethod
    def of(cls, parts: Iterable[Any]) -> "_Additions":
        """Some untyped parts of a node."""
        made = cls()
        for part in parts:
            holder = made
            for step in filter(None, part.at.split("/")):
                if step not in holder.inner:
                    holder.inner[step] = cls()
                    holder.order.append(step)
                holder = holder.inner[step]
            if part.attribute is not None:
                holder.attributes.append(part.attribute)
            elif part.element is not None:
                holder.order.append(part)
            else:
                holder.texts.append(part.text)
        return made


# Building a tree with lxml, indenting and serializing it takes more than twice as long as putting
# the same text together. A property holds that both give the same bytes.
class TextOutput:
    """What the writers know of a document; its arguments are those of `root_text`."""

    def __init__(
        self,
        version: Version,
        namespaces: dict[str | None, str],
        arrange: Arrange | None = None,
        parts: list[Any] | None = None,
    ) -> None:
        self.version = version
        self.arrange = arrange
        self.parts = parts
        self.declarations, self._names = _declared_names(tuple(namespaces.items()))
        self._taken = namespaces
        self._made_up = count()
        self._late: dict[int, list[Item]] = {}

    def children(self, node: Any, indent: str, *groups: tuple[Iterable[Any], Write]) -> str:
        """Write the repeated parts of a node, in the order of the file."""
        items = [(child, write) for children, write in groups for child in children]
        if len(items) > 1:
            items = in_order(items)
        if self.arrange:
            items, late = self.arrange(node, items)
            if late and node.opaque:
                self._late[id(node)] = late
            else:
                items += late
        texts: list[str] = []
        for child, write in items:  # a comprehension would make the recursion deeper
            texts.append(write(child, self, indent))
        return "".join(texts)

    def unusual(
        self,
        node: Any,
        tag: str,
        indent: str,
        *,
        attributes: str = "",
        body: str | None = "",
        content: Iterable[Any] = (),
        keep: bool = False,
    ) -> str:
        """The element of a node with `content`, its parts that have no typed field, and its mark if it has one.

        `attributes` and `body` are what of it is written already. If it is empty, it is nothing unless it is kept.
        """
        if content or node.opaque:
            attributes, body = self._filled(node, indent + _STEP, attributes, body or "", content)
        if not (attributes or body or keep):
            return ""
        return _joined(tag, indent, self._mark(node) + attributes, body or "")

    def _filled(self, node: Any, indent: str, attributes: str, body: str, content: Iterable[Any]) -> tuple[str, str]:
        """Return the attributes and the body of a node with its content and its untyped parts."""
        pieces = [body]
        for element in content:
            made = self._element(element, indent, self._names)
            pieces.append(_behind(pieces[-1], made, indent))
        for number, part in enumerate(node.opaque):
            if part.at or part.element is None:  # few are; the others take the short way
                additions = _Additions.of(node.opaque[number:])
                attributes, body = self._added(attributes, "".join(pieces), indent, additions)
                pieces = [body]
                break
            made = self._element(part.element, indent, self._names, self._mark(part))
            pieces.append(_behind(pieces[-1], made, indent))
        for child, write in self._late.pop(id(node), ()) if self._late else ():
            made = write(child, self, indent)
            pieces.append(_behind(pieces[-1], made, indent))
        return attributes, "".join(pieces)

    def _mark(self, part: Any) -> str:
        if self.parts is None or part.source is None:
            return ""
        self.parts.append(part)
        return f"{_MARK}{len(self.parts) - 1}{_MARK}"

    def _added(self, attributes: str, body: str, indent: str, additions: _Additions) -> tuple[str, str]:
        """Return the attributes and the body of an element with its additions."""
        if additions.attributes:
            names, declared = self._declared([name for name, _ in additions.attributes], self._names)
            added = {names[name]: in_attribute(value) for name, value in additions.attributes}
            attributes = declared + _with_attributes(attributes, added)
        if additions.texts:
            body = _with_text(body, in_text(" ".join(additions.texts)), indent)
        for each in additions.order:
            if isinstance(each, str):
                body = self._added_inside(body, indent, each, additions.inner[each])
            else:
                made = self._element(each.element, indent, self._names, self._mark(each))
                body += _behind(body, made, indent)
        return attributes, body

    def _added_inside(self, body: str, indent: str, step: str, additions: _Additions) -> str:
        """Return the body of an element with additions made in its child of this name, which is created if missing."""
        names, declared = self._declared([step], self._names)
        name = names[step]
        span = _span_of_child(body, name, indent)
        head, _, rest = (body[slice(*span)] or f"{indent}<{name}{declared}/>").partition(">")
        attributes = head.removesuffix("/")[len(indent) + 1 + len(name) :]
        inside = "" if head[-1] == "/" else rest.rpartition("</")[0].removesuffix(indent)
        child = _joined(name, indent, *self._added(attributes, inside, indent + _STEP, additions))
        if span[0] < len(body):
            return body[: span[0]] + child + body[span[1] :]
        return body + _behind(body, child, indent)

    def _element(self, element: Any, indent: str, names: _PrefixNames, mark: str = "") -> str:
        """Write an untyped element, and the text behind it."""
        try:
            name, attributes = names[element.name], _attributes(element.attributes, names)
        except KeyError:
            names, declared = self._declared_in(element, names)
            name, attributes = names[element.name], declared + _attributes(element.attributes, names)
        if self.parts is not None:
            attributes = mark + self._mark(element) + attributes
        if element.children:
            made = _joined(name, indent, attributes, self._content(element, indent + _STEP, names))
        else:
            end = "/>" if element.text is None else f">{in_text(element.text)}</{name}>"
            made = f"{indent}<{name}{attributes}{end}"
        return made if element.tail is None or element.tail.isspace() else made + in_text(element.tail)

    def _content(self, element: Any, indent: str, names: _PrefixNames) -> str:
        """The text of an untyped element and its children."""
        children, text = element.children, element.text
        if self.arrange:
            first, late = self.arrange(element, [(child, None) for child in children])
            children = [child for child, _ in (*first, *late)]
        pieces = ["" if text is None or text.isspace() else in_text(text)]
        for child in children:
            made = self._element(child, indent, names)
            pieces.append(_behind(pieces[-1], made, indent))
        return "".join(pieces)

    def _declared_in(self, element: Any, names: _PrefixNames) -> tuple[_PrefixNames, str]:
        """Names where an untyped element declares namespaces: its own is the default, if all names in it have one."""
        namespace = namespace_of(element.name)
        attributes = [name for name, _ in element.attributes]
        in_use = attributes and any(name.startswith(f"{{{namespace}}}") for name in attributes)
        is_mixed = not namespace or (element.children and any(each.name[0] != "{" for each in element.walk()))
        if namespace in names.prefixes or in_use or is_mixed:
            return self._declared([element.name, *attributes], names)
        next(self._made_up)  # lxml counts these too
        prefixes = {uri: prefix for uri, prefix in names.prefixes.items() if prefix or not uri}
        names, declared = self._declared(attributes, _PrefixNames(prefixes | {namespace: ""}))
        return names, f' xmlns="{in_attribute(namespace)}"{declared}'

    def _declared(self, wanted: Iterable[str], names: _PrefixNames) -> tuple[_PrefixNames, str]:
        """Return prefixed names for the namespaces that are wanted, and the declarations of their prefixes."""
        made = dict[str, str]()
        for namespace in map(namespace_of, wanted):
            if namespace not in names.prefixes and namespace not in made:
                made[namespace] = next(p for p in (f"ns{n}" for n in self._made_up) if p not in self._taken)
        if not made:
            return names, ""
        declared = "".join([f' xmlns:{prefix}="{in_attribute(uri)}"' for uri, prefix in made.items()])
        return _PrefixNames({**names.prefixes, **{uri: f"{prefix}:" for uri, prefix in made.items()}}), declared


@lru_cache(maxsize=16)  # a file has a thousand carriers, each of which is an output of its own
def _declared_names(namespaces: tuple[tuple[str | None, str], ...]) -> tuple[str, _PrefixNames]:
    """Return the declarations of namespaces, in the form that lxml accepts, and the names with their prefixes."""
    holder = etree.tostring(etree.Element("holder", nsmap=dict(namespaces)), encoding="unicode")
    # Of two prefixes of a namespace lxml takes the first.
    prefixes = {uri: f"{prefix}:" for prefix, uri in reversed(namespaces)}
    return holder.removeprefix("<holder").removesuffix("/>"), _PrefixNames(_KNOWN | prefixes)


def _attributes(attributes: Iterable[tuple[str, str]], names: _PrefixNames) -> str:
    values = dict(attributes)
    if _ODD_IN_ATTRIBUTE.search("".join(values.values())):  # hardly any, and to look at each takes twice as long
        values = {name: in_attribute(value) for name, value in values.items()}
    return "".join([f' {names[name]}="{value}"' for name, value in values.items()])


def _with_attributes(attributes: str, added: Mapping[str, str]) -> str:
    """Attributes with more of them, which replace those of the same name."""
    new: list[str] = []
    for name, value in added.items():
        written = f' {name}="{value}"'
        if f' {name}="' in attributes:
            attributes = re.sub(rf' {re.escape(name)}="[^"]*"', lambda _, written=written: written, attributes, count=1)
        else:
            new.append(written)
    return attributes + "".join(new)


def _with_text(body: str, text: str, indent: str) -> str:
    """Put a text into a body, behind the text that it begins with."""
    before, bracket, rest = body.partition("<")
    if before.isspace() and bracket:  # there is no text but the indent
        return body if text.isspace() else text + body.removeprefix(indent)
    return f"{before} {text}{bracket}{rest}" if before else text + body


def _behind(body: str, element: str, indent: str) -> str:
    """Put an element behind a body; after text it stays on the same line."""
    return element if not body or body[-1] == ">" else element.removeprefix(indent)


def _joined(tag: str, indent: str, attributes: str, body: str) -> str:
    """Close an element; no line break is added after a body that ends with text."""
    if not body:
        return f"{indent}<{tag}{attributes}/>"
    return f"{indent}<{tag}{attributes}>{body}{indent if body[-1] == '>' else ''}</{tag}>"


def _span_of_child(body: str, name: str, indent: str) -> tuple[int, int]:
    """Return where the first child of a name begins, with its indent, and ends; the end of the body if there is none.

    One that stands behind text is not meant.
    """
    start = body.find("<")
    while start >= 0:
        end, first = end_of_element(body, start), start - len(indent)
        is_behind_text = first > 0 and body[first - 1] != ">"
        if not is_behind_text and re.compile(rf"<{re.escape(name)}[ />{_MARK}]").match(body, start):
            return first, end
        start = body.find("<", end)
    return len(body), len(body)


def end_of_element(text: str, start: int) -> int:
    """Return where the element ends that starts at an offset of a text written here."""
    name = re.compile(rf"[^ />{_MARK}]+").match(text, start + 1)
    depth = 0
    for tag in re.compile(rf"<(/?){re.escape(name[0] if name else '')}(?=[ />{_MARK}])[^>]*").finditer(text, start):
        depth += -1 if tag[1] else tag[0][-1] != "/"
        if not depth:
            return tag.end() + 1
    raise ValueError("the text ends inside of an element")


def without_marks(text: str, parts: list[Any]) -> tuple[str, WrittenParts]:
    """Remove the marks from a text, and return the parts that had one."""
    pieces = text.split(_MARK)
    return "".join(pieces[::2]), list(_placed(pieces, parts))


def _placed(pieces: list[str], parts: list[Any]) -> Iterator[tuple[Any, int]]:
    done = start = 0
    for piece, part in zip(pieces[::2], pieces[1::2], strict=False):
        if piece:  # an element may have two marks
            start = done + piece.rindex("<")
            done += len(piece)
        yield parts[int(part)], start
