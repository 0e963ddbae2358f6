"""Stores parsed values: checked against their bounds and put into the field of the IR."""

from collections.abc import Callable
from typing import Any

from twinform.diagnostics import Source
from twinform.schemas import messages
from twinform.schemas.facts import Fact
from twinform.schemas.messages import Context
from twinform.schemas.xml import XmlElement

Data = dict[str, Any]
Store = Callable[[XmlElement, Data, Any, Context], None]
"""Puts a value, which comes with its text, into a node: (element, node, (value, text), context)"""

_SCALARS = frozenset({"double", "int", "uint"})


def value_check(row: Fact) -> Callable[[XmlElement, Any, Context], None] | None:
    """What is asked of a value beyond its type."""
    if row.enum:
        return _word_check(row)
    if row.type == "pose":
        return _check_pose
    if row.min is None and row.max is None:
        return None
    low = row.min if row.min is not None else float("-inf")
    high = row.max if row.max is not None else float("inf")

    def check_number(element: XmlElement, value: float, context: Context) -> None:
        if value < low or value > high:
            messages.out_of_range(context, element, row, value)

    def check_vector(element: XmlElement, value: tuple[float, ...], context: Context) -> None:
        if min(value) < low:
            messages.out_of_range(context, element, row, min(value))
        elif max(value) > high:
            messages.out_of_range(context, element, row, max(value))

    return check_number if row.type in _SCALARS else check_vector


def _word_check(row: Fact) -> Callable[[XmlElement, Any, Context], None]:
    allowed, dialects = frozenset(row.enum), dict(row.also)

    def check(element: XmlElement, value: str, context: Context) -> None:
        if value in dialects:
            messages.dialect_value(context, element, row.name, value, dialects[value])
        elif value in row.elsewhere:
            messages.value_outside_version(context, element, row, value)
        elif value not in allowed:
            step = row.name if row.is_attribute else ""
            messages.unlisted_value(context, element, step, value, row.enum)

    return check


def _check_pose(element: XmlElement, value: tuple[float, ...], context: Context) -> None:
    quaternion, degrees = element.get("rotation_format") == "quat_xyzw", element.get("degrees")
    if len(value) != (7 if quaternion else 6) or (quaternion and (degrees or "").strip().lower() in {"true", "1"}):
        messages.mixed_rotation(context, element, len(value))


def value_store(row: Fact, place: str) -> Store:  # noqa: C901 - six small closures, one of which is chosen
    """Puts a value, which comes with its text, where the IR has it."""
    outer, _, field = place.rpartition(".")

    def store_pose(element: XmlElement, node: Data, read: tuple[tuple[float, ...], str], context: Context) -> None:
        values = read[0]
        node["xyz"] = values[:3]
        node["rpy" if len(values) == 6 else "quat_xyzw"] = values[3:]

    def store_repeated(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:
        node.setdefault(field, []).append(read[0])

    def store_inside(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:
        holder = node.get(outer)
        if holder is None:
            step = str(element.tag)
            source = Source(context.file, element.sourceline or 0, node["source"], step)
            holder = node[outer] = Data(source=source)
        holder[field] = read[0]

    def store_header(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:
        context.header[place[1:]] = read[0]

    def store_bool(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:
        node[field], text = read
        if text not in ("true", "false"):
            node.setdefault("spelling", {})[field] = text.strip()

    def store(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:
        node[field] = read[0]

    if place.startswith("/"):
        return store_header
    if row.type == "pose":
        return store_pose
    if outer:
        return store_inside
    if row.fills_tuple:
        return store_repeated
    return store_bool if row.type == "bool" else store
