"""Readers of attribute values and texts: parsed, checked, and stored for the fields of the IR; makers of nodes."""

from collections.abc import Callable, Mapping
from dataclasses import MISSING
from typing import Any, Literal, get_args, get_origin

from lxml import etree

from twinform.diagnostics import Source, meant_name
from twinform.ir import Element, Node, Opaque
from twinform.ir.record import fields_of, filler, maker
from twinform.ir.rewrite import classes_in
from twinform.ir.versions import Version
from twinform.schemas import messages
from twinform.schemas.facts import Fact
from twinform.schemas.hints import hint_for_word
from twinform.schemas.messages import Context, StandIn
from twinform.schemas.value_types import ValueType
from twinform.schemas.xml import BLANKS, XmlElement, is_blank

Data = dict[str, Any]
"""The values of a node by their fields, while it is read."""

_FORMAT = "format"
"""The one required field that no element gives: whoever reads a document knows it."""


class NodeMaker:
    """Makes nodes of one class.

    `inner` are the classes of nodes that no element of their own makes, by their fields. `gathers` is whether values
    have to be completed before a node is made, even where nothing of it is opaque.
    """

    def __init__(self, kind: type[Node], inner: Mapping[str, type[Node]]) -> None:
        self._tuples = [name for name, each in fields_of(kind).items() if each.default == ()]
        self._inner = [(name, NodeMaker(each, {})) for name, each in inner.items()]
        self.gathers = len(self._tuples) > 1 or bool(inner)
        self.make = maker(kind)

    def complete(self, data: Data) -> None:
        """Turn gathered lists into tuples and gathered dicts into nodes."""
        for name in self._tuples:
            if name in data:
                data[name] = tuple(data[name])
        for name, inner in self._inner:
            if name in data:
                inner.complete(data[name])
                data[name] = inner.make(data[name])


def required_words(kind: type[Node]) -> Mapping[str, tuple[str, ...]]:
    """Return the required fields of a class, with the allowed words of those that take only some."""
    return {
        name: get_args(each.type) if get_origin(each.type) is Literal else ()
        for name, each in fields_of(kind).items()
        if each.default is MISSING and name != _FORMAT
    }


def stand_in(node: Data, field: str, words: tuple[str, ...], context: Context, guess: str | None = None) -> None:
    """Fill a required field that the file leaves open, so that the rest can be checked.

    The value is the `guess`, or else the first of the allowed words, or an empty name.
    """
    context.broken = True
    node[field] = guess or (words[0] if words else "")
    if guess is None:
        source: Source = node["source"]
        name = source.key if isinstance(source.key, str) else ""
        context.stand_ins.append(StandIn(source.path, field, name))


def node_class(holder: type[Node], field: str, kind: str | None = None) -> type[Node]:
    """Return the class of the nodes in a field; of several, the one of a kind.

    Raises:
        ValueError: there is no such field, or it does not hold nodes of one class.
    """
    require_place(holder, field)
    found = [each for each in classes_in(holder, field) if kind in {None, _kind(each)}]
    if len(found) != 1:
        raise ValueError(f"{holder.__name__}.{field} does not hold nodes of one class")
    return found[0]


def require_place(holder: type[Node], place: str) -> None:
    """Check that the place of a row is a field of the class that the row fills, or of a node inside it.

    Raises:
        ValueError: it is not.
    """
    steps = place.removeprefix("/").split(".")
    for step in filter(None, steps):
        if step not in fields_of(holder):
            raise ValueError(f"{holder.__name__} has no field {step!r}")
        if step != steps[-1]:
            (holder,) = classes_in(holder, step)


def _kind(node: type[Node]) -> object:
    return fields_of(node)["kind"].default if "kind" in fields_of(node) else None


locate: Callable[[type[Source], tuple[object, ...]], Source] = tuple.__new__  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] - typeshed leaves the items open
"""Makes a Source without the detour through its own constructor: the reader makes one for every node."""
_make_element = filler(Element)
_make_opaque = filler(Opaque)

LAST_LINE = 65535
"""libxml2 keeps no number beyond it."""


def element_xml(element: Any, parent: XmlElement | None = None) -> XmlElement:
    """Return the XML of an IR `Element`, below `parent` if one is given."""
    attributes = dict(element.attributes)
    if parent is None:
        made = etree.Element(element.name, attributes)
    else:
        made = etree.SubElement(parent, element.name, attributes)
    made.text, made.tail = element.text, element.tail
    if element.source is not None:
        made.sourceline = min(element.source.line, LAST_LINE)  # pyright: ignore[reportAttributeAccessIssue] - it can be set
    for child in element.children:
        element_xml(child, made)
    return made


def read_element(element: XmlElement, file: str, above: Source | None, *, kept: bool = False) -> Element:
    """Read a subtree as an `Element`, with sources below the given one; a `kept` one has no text behind it."""
    tag, text, tail = element.tag, element.text, None if kept else element.tail
    if above is not None:
        above = locate(Source, (file, element.sourceline or 0, above, tag, element.get("name")))
    children = tuple([read_element(child, file, above) for child in element]) if len(element) else ()
    text, tail = (text.strip() or None) if text else None, (tail.strip() or None) if tail else None
    return _make_element((above, tag, tuple(element.items()), text, children, tail))


def keep_content(child: XmlElement, node: Data, field: str, context: Context) -> None:
    """Keep a child in a field for free content, which knows where it was written."""
    node.setdefault(field, []).append(read_element(child, context.file, node["source"]))


def keep_element(child: XmlElement, node: Data, at: str, context: Context) -> None:
    """Keep a child with all inside it; `at` is the path from the node to the element around it.

    Of an element with a namespace, such as one that holds what only MJCF says, each part knows where it was written.
    """
    tag = str(child.tag)
    element = read_element(child, context.file, node["source"] if tag.startswith("{") else None, kept=True)
    _keep(child, node, context, tag, (at, element, None, None))


def keep_attribute(element: XmlElement, node: Data, at: str, context: Context, attribute: tuple[str, str]) -> None:
    """Keep an attribute of the element at a path from the node."""
    _keep(element, node, context, f"@{attribute[0]}", (at, None, attribute, None))


def keep_text(element: XmlElement, node: Data, at: str, context: Context, text: str) -> None:
    """Keep text between the children of the element at a path from the node."""
    _keep(element, node, context, "text()", (at, None, None, " ".join(text.split())))


def _keep(element: XmlElement, node: Data, context: Context, called: str, part: tuple[Any, ...]) -> None:
    at = part[0]
    step = f"{at}/{called}" if at else called
    source = locate(Source, (context.file, element.sourceline or 0, node["source"], step, None))
    opaque: list[Opaque] = node.setdefault("opaque", [])
    opaque.append(_make_opaque((source, *part)))


Types = Mapping[str, ValueType]
"""The value types of a format by their names."""
ReadAttribute = Callable[[XmlElement, str, str, Data, Context], None]
"""Reads an attribute: (element, name, text, node, context)"""
ReadText = Callable[[XmlElement, Data, Context], bool]
"""Reads the text of an element: (element, node, context); it returns whether there was any"""
Check = Callable[[XmlElement, Any, Context], None]
"""Reports what is wrong with a value beyond its type: (element, value, context)"""
Store = Callable[[XmlElement, Data, Any, str, Context], None]
"""Puts a value into a node: (element, node, value, text, context)"""

SCALARS = frozenset({"double", "int", "uint"})


def attribute_reader(
    row: Fact, types: Types, version: Version, at: str, words: tuple[str, ...] = (), *, keep: bool
) -> ReadAttribute:
    """Return the reader of an attribute: it checks the value and stores it, or keeps the text if `keep` says so.

    `at` is the path from the node to the element, and `words` are those without one of which there is no node.
    """
    read = _value_reader(row, types, at, words, keep=keep)
    if row.exists_in(version):
        return read

    def read_late(element: XmlElement, name: str, text: str, node: Data, context: Context) -> None:
        messages.outside_version(context, element, row)
        if context.format == "sdf":
            read(element, name, text, node, context)
        elif keep:  # in URDF it means nothing
            keep_attribute(element, node, at, context, (name, text))

    return read_late


def _value_reader(row: Fact, types: Types, at: str, words: tuple[str, ...], *, keep: bool) -> ReadAttribute:
    value_type = types[row.type or "string"]
    parse, check, dialect, deprecated = value_type.parse, value_check(row), row.dialect, row.deprecated
    store = value_store(row, row.place) if keep and row.place else None

    def read(element: XmlElement, name: str, text: str, node: Data, context: Context) -> None:
        if dialect:
            messages.dialect_attribute(context, element, name, dialect)
        if deprecated:
            messages.deprecated_attribute(context, element, name)
        try:
            value = parse(text)
        except ValueError:
            messages.invalid_value(context, element, row.name, text, value_type.expected)
            return
        if check is not None:
            check(element, value, context)
        if store is not None:
            store(element, node, value, text, context)
        elif keep:
            keep_attribute(element, node, at, context, (name, text))
        if words and value not in words and row.place:
            stand_in(node, row.place, words, context, meant_name(hint_for_word(str(value), row.enum)))

    return read


def text_reader(row: Fact, types: Types, *, keep: bool) -> ReadText:
    """Return the reader of an element's text, which tells whether there was any; blank text means the default."""
    value_type = types[row.type or "string"]
    if row.type == "pose":
        return _pose_reader(row, value_type, keep=keep)
    parse, check = value_type.parse, value_check(row)
    if row.type == "string":
        parse, check = stripped, _blank_check(row, value_type, check)
    store = value_store(row, row.place) if keep and row.place else None

    def read(element: XmlElement, node: Data, context: Context) -> bool:
        text = element.text or ""
        try:
            value = parse(text)
        except ValueError:
            return _report_text(row, value_type, element, context)
        if check is not None:
            check(element, value, context)
        if store is not None:
            store(element, node, value, text, context)
        return True

    return read


def _pose_reader(row: Fact, value_type: ValueType, *, keep: bool) -> ReadText:
    parse: Callable[[str], Any] = value_type.parse

    def read(element: XmlElement, node: Data, context: Context) -> bool:
        try:
            values = parse(element.text or "")
        except ValueError:
            return _report_text(row, value_type, element, context)
        if len(values) != 6 or element.keys():
            check_pose(element, len(values), context)
        if keep:
            node["xyz"] = values[:3]
            node["rpy" if len(values) == 6 else "quat_xyzw"] = values[3:]
        return True

    return read


def _report_text(row: Fact, value_type: ValueType, element: XmlElement, context: Context) -> bool:
    """Report a text that is no value of its type; returns whether there was a text."""
    text = element.text or ""
    if not is_blank(text):
        messages.invalid_value(context, element, "", text.strip(), value_type.expected)
        return True
    if row.needs_text:
        messages.missing_text(context, element, value_type.expected)
    elif row.type != "pose":
        # libsdformat reads no empty text into a value that its description requires (Param.cc, ValueFromStringImpl)
        messages.blank_value(context, element, value_type.expected, refused=context.format == "sdf" and row.required)
    return False


def _blank_check(row: Fact, value_type: ValueType, others: Check | None) -> Check | None:
    """Return the check that reports blank text where a value is needed, before all other checks."""
    if not row.needs_text and not row.default:
        return others

    def check(element: XmlElement, value: str, context: Context) -> None:
        # an empty parameter of URDF is a value like others
        if not value and context.format == "sdf":
            messages.blank_value(context, element, value_type.expected, refused=False)
        if others is not None:
            others(element, value, context)

    return check


def stripped(text: str) -> str:
    """The text without the white space around it."""
    return text.strip(BLANKS)


def value_check(row: Fact) -> Check | None:
    """Return the checks of a value beyond its type."""
    if row.enum:
        return _words_check(row) if row.type == "words" else _word_check(row)
    if row.bounds is None:
        return None
    low, high = row.bounds

    def check_number(element: XmlElement, value: float, context: Context) -> None:
        if value < low or value > high:
            messages.out_of_range(context, element, row, value)

    def check_vector(element: XmlElement, value: tuple[float, ...], context: Context) -> None:
        if min(value) < low:
            messages.out_of_range(context, element, row, min(value))
        elif max(value) > high:
            messages.out_of_range(context, element, row, max(value))

    return check_number if row.type in SCALARS else check_vector


def _word_check(row: Fact) -> Check:
    allowed, dialects = frozenset(row.enum), dict(row.also)

    def check(element: XmlElement, value: str, context: Context) -> None:
        if value in allowed:
            return
        if value in dialects:
            messages.dialect_value(context, element, row.name, value, dialects[value])
        elif value in row.elsewhere:
            messages.value_outside_version(context, element, row, value)
        else:
            step = row.name if row.is_attribute else ""
            messages.unlisted_value(context, element, step, value, row.enum)

    return check


def _words_check(row: Fact) -> Check:
    """Return the check of a list of words, which asks for each of them."""
    check_word = _word_check(row)

    def check(element: XmlElement, value: tuple[str, ...], context: Context) -> None:
        for word in value:
            check_word(element, word, context)

    return check


def check_pose(element: XmlElement, count: int, context: Context) -> None:
    """Report a pose whose numbers do not fit the notation that its attributes name."""
    quaternion, degrees = element.get("rotation_format") == "quat_xyzw", element.get("degrees")
    if count != (7 if quaternion else 6) or (quaternion and (degrees or "").strip().lower() in {"true", "1"}):
        messages.mixed_rotation(context, element, count)


def own_field(row: Fact) -> str | None:
    """Return the field of the node itself that takes the one value of a row, if there is one."""
    place = row.place
    return None if not place or place[0] == "/" or "." in place or row.fills_tuple else place


def value_store(row: Fact, place: str) -> Store:  # noqa: C901 - five small functions, one of which is chosen
    """Return the function that stores a value in its place in the IR."""
    outer, _, field = place.rpartition(".")

    def store_repeated(element: XmlElement, node: Data, value: object, text: str, context: Context) -> None:
        node.setdefault(field, []).append(value)

    def store_inside(element: XmlElement, node: Data, value: object, text: str, context: Context) -> None:
        holder: Data | None = node.get(outer)
        if holder is None:
            where = (context.file, element.sourceline or 0, node["source"], str(element.tag), None)
            holder = node[outer] = {"source": locate(Source, where)}
        holder[field] = value

    def store_header(element: XmlElement, node: Data, value: object, text: str, context: Context) -> None:
        context.header[place[1:]] = value

    def store_bool(element: XmlElement, node: Data, value: object, text: str, context: Context) -> None:
        node[field] = value
        if text not in ("true", "false"):
            node.setdefault("spelling", {})[field] = text.strip()

    def store(element: XmlElement, node: Data, value: object, text: str, context: Context) -> None:
        node[field] = value

    if place.startswith("/"):
        return store_header
    if outer:
        return store_inside
    if row.fills_tuple:
        return store_repeated
    return store_bool if row.type == "bool" else store
