"""Where two documents begin to differ."""

from typing import cast

from twinform.ir import Element, Node, Opaque
from twinform.ir.record import field_values

_MOST = 60


def first_difference(one: object, other: object, path: str = "") -> str | None:
    """The path of the first difference and what stands there; None where there is none."""
    unlike = f"{path}: {_short(one)} | {_short(other)}"
    if type(one) is not type(other):
        return unlike
    if isinstance(one, Node | Opaque | Element) and isinstance(other, Node | Opaque | Element):
        return _in_fields(one, other, path)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return _in_order(cast("tuple[object, ...]", one), cast("tuple[object, ...]", other), path)
    same = one == other or (one != one and other != other)
    return None if same else unlike


def _in_fields(one: Node | Opaque | Element, other: Node | Opaque | Element, path: str) -> str | None:
    for name, value in field_values(one).items():
        if name != "namespaces" and (found := first_difference(value, getattr(other, name), f"{path}/{name}")):
            return found
    return None


def _in_order(one: tuple[object, ...], other: tuple[object, ...], path: str) -> str | None:
    for index, (mine, theirs) in enumerate(zip(one, other, strict=False)):
        step = getattr(mine, "name", None) or index
        if found := first_difference(mine, theirs, f"{path}[{step}]"):
            return found
    if len(one) == len(other):
        return None
    odd = (one if len(one) > len(other) else other)[min(len(one), len(other))]
    where = "only in the first" if len(one) > len(other) else "only in the second"
    return f"{path}: {len(one)} | {len(other)}, {where}: {_short(getattr(odd, 'name', None) or odd)}"


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= _MOST else f"{text[: _MOST - 1]}~"
