"""Carriers of two-axis joints, divided between the two single-axis joints of the chain and merged again."""

from collections.abc import Iterable

from twinform.ir import Opaque
from twinform.passes.carriers.carriers import NAMESPACE, is_ours

Parts = tuple[Opaque, ...]

_FIRST, _SECOND = (f"{{{NAMESPACE}}}{field}" for field in ("axis", "axis2"))
"""The annotations on how the two axes were written."""


def split_axes(parts: Iterable[Opaque]) -> tuple[Parts, Parts]:
    """The parts about the first axis, and all others, in which the second axis is the only one."""
    first: list[Opaque] = []
    rest: list[Opaque] = []
    for part in parts:
        if is_of_axis(_path(part)) or _is_called(part, _FIRST):
            first.append(part)
        else:
            rest.append(_with_name(_with_path(part, _moved(_path(part), "axis2", "axis")), _SECOND, _FIRST))
    return tuple(first), tuple(rest)


def join_axes(first: Iterable[Opaque], rest: Iterable[Opaque]) -> Parts:
    """The parts of a joint with two axes: the inverse of `split_axes`."""
    joined = [part for part in first if is_of_axis(_path(part)) or _is_called(part, _FIRST)]
    joined += (_with_name(_with_path(part, _moved(_path(part), "axis", "axis2")), _FIRST, _SECOND) for part in rest)
    return tuple(joined)


def is_of_axis(path: str) -> bool:
    """Whether a part at this path is one of the axis."""
    return path == "axis" or path.startswith("axis/")


def _moved(path: str, step: str, to: str) -> str:
    """The path with another first step, if that is its first step."""
    return to + path.removeprefix(step) if path == step or path.startswith(f"{step}/") else path


def _path(part: Opaque) -> str:
    """Where a part belongs, or where the piece in a carrier does."""
    if is_ours(part) and part.element:
        return part.element.get("at") or ""
    return part.at


def _with_path(part: Opaque, path: str) -> Opaque:
    if path == _path(part):
        return part
    if not (is_ours(part) and part.element):
        return part.copy(at=path)
    attributes = tuple((name, path if name == "at" else value) for name, value in part.element.attributes)
    return part.copy(element=part.element.copy(attributes=attributes))


def _is_called(part: Opaque, name: str) -> bool:
    return part.element is not None and part.element.name == name


def _with_name(part: Opaque, name: str, to: str) -> Opaque:
    """The part with another name, if it is an element of this one."""
    if part.element is None or part.element.name != name:
        return part
    return part.copy(element=part.element.copy(name=to))
