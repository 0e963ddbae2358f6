"""What a joint with two axes carries, shared out between the two joints that have one axis each, and back."""

from collections.abc import Iterable

from twinform.ir import Element, Opaque
from twinform.passes.legalise.carrier import is_ours
from twinform.passes.legalise.marks import MADE

Parts = tuple[Opaque, ...]


def split_axes(parts: Iterable[Opaque]) -> tuple[Parts, Parts]:
    """The parts about the first axis, and all others, in which the second axis is the only one."""
    first: list[Opaque] = []
    rest: list[Opaque] = []
    for part in parts:
        if part.attribute and part.attribute[0] == MADE:
            first += _marks(field for field in part.attribute[1].split() if _is_of(field, ".", "axis"))
            rest += _marks(_moved(f, ".", "axis2") for f in part.attribute[1].split() if not _is_of(f, ".", "axis"))
        elif _is_of(_path(part), "/", "axis"):
            first.append(part)
        else:
            rest.append(_with_path(part, _moved(_path(part), "/", "axis2")))
    return tuple(first), tuple(rest)


def join_axes(first: Iterable[Opaque], rest: Iterable[Opaque]) -> Parts:
    """The parts of a joint with two axes: the inverse of `split_axes`."""
    fields: list[str] = []
    joined: list[Opaque] = []
    for part in first:
        if part.attribute and part.attribute[0] == MADE:
            fields += (field for field in part.attribute[1].split() if _is_of(field, ".", "axis"))
        elif _is_of(_path(part), "/", "axis"):
            joined.append(part)
    for part in rest:
        if part.attribute and part.attribute[0] == MADE:
            fields += (_moved(field, ".", "axis", "axis2") for field in part.attribute[1].split())
        else:
            joined.append(_with_path(part, _moved(_path(part), "/", "axis", "axis2")))
    return (*_marks(fields), *joined)


def is_of_axis(path: str) -> bool:
    """Whether a part at this path is one of the axis."""
    return _is_of(path, "/", "axis")


def _marks(fields: Iterable[str]) -> Parts:
    words = " ".join(fields)
    return (Opaque(attribute=(MADE, words)),) if words else ()


def _is_of(path: str, between: str, step: str) -> bool:
    return path == step or path.startswith(step + between)


def _moved(path: str, between: str, step: str, to: str = "axis") -> str:
    """The path with another first step, if that is its first step."""
    return to + path.removeprefix(step) if _is_of(path, between, step) else path


def _path(part: Opaque) -> str:
    """Where a part belongs, or where the piece in a carrier does."""
    if is_ours(part) and part.element:
        return part.element.get("at") or ""
    return part.at


def _with_path(part: Opaque, path: str) -> Opaque:
    if path == _path(part):
        return part
    if not (is_ours(part) and part.element):
        return part.model_copy(update={"at": path})
    attributes = tuple((name, path if name == "at" else value) for name, value in part.element.attributes)
    element: Element = part.element.model_copy(update={"attributes": attributes})
    return part.model_copy(update={"element": element})
