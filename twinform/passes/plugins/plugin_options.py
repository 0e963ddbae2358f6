"""Plugin parameters as pass options, and pass options as plugin parameters.

An option is called as its parameter in kebab-case, with the names of what is around it before: `left_joint` is
`left-joint`, `<left_track><link>` is `left-track-link`, `linkName` is `link-name`.
"""

import re
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import product
from typing import Annotated, Any, Literal, cast

from lxml import etree
from pydantic import AfterValidator, BeforeValidator, Field
from pydantic.fields import FieldInfo

from twinform.ir import Element
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.plugins.catalog_types import ParameterType, PluginKind, PluginParameter
from twinform.passes.plugins.parameter_types import problem_of
from twinform.schemas import format_value

_HUMP = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")
_CHOICE = re.compile(r"\[([^\[\]]++)\]")

_TYPES: dict[ParameterType, Any] = {
    "number": float,
    "integer": int,
    "bool": bool,
    "vector": tuple[float, float, float],
    "numbers": tuple[float, ...],
    "pose": tuple[float, ...],
    "color": tuple[float, ...],
}
"""How options of a type are given; all others are text."""
_LISTS = frozenset({"vector", "numbers", "pose", "color"})
"""Types of several numbers; a list of such values is a list of texts."""

Path = tuple[str, ...]


@cache
def options_of(kind: PluginKind) -> dict[str, tuple[Path, PluginParameter]]:
    """The options of a system, each with the path of its parameter.

    What may be written as an attribute or as an element has one option, which writes what the table has first.
    """
    found: dict[str, tuple[Path, PluginParameter]] = {}
    for path, row in _leaves((), kind.parameters):
        found.setdefault(_option(path), (path, row))
    return found


def _leaves(above: Path, rows: tuple[PluginParameter, ...]) -> Iterator[tuple[Path, PluginParameter]]:
    """The parameters that have a value of their own; families of names are spelt out."""
    for row in rows:
        for name in _names(row.name):
            if row.type != "element" or row.free:
                yield (*above, name), row
            yield from _leaves((*above, name), row.children)


def _names(name: str) -> Iterator[str]:
    """The names that a pattern such as `x[UV]` stands for."""
    parts = _CHOICE.split(name)
    choices = [part if index % 2 else (part,) for index, part in enumerate(parts)]
    return map("".join, product(*choices))


def _option(path: Path) -> str:
    return "-".join(_word(name) for name in path)


def _word(name: str) -> str:
    plain = name.lstrip("@").replace("_", "-")
    # The derivatives of hydrodynamics (`xUabsU`) and of airfoils (`CLa`) are names without capitals between words.
    return plain.lower() if plain[:1].isupper() or plain[1:2].isupper() else _HUMP.sub("-", plain).lower()


def field_of(path: Path, row: PluginParameter, kind: PluginKind) -> tuple[Any, FieldInfo]:
    """The type and field of an option, for a model of Pydantic."""
    many = _may_repeat(path, kind)
    one = str if many and row.type in _LISTS else _type(row)
    checked: Any = Annotated[one, AfterValidator(_checker(row))]
    kind_of: Any = Annotated[tuple[checked, ...], BeforeValidator(_listed)] if many else checked
    unit = f", in {' or '.join(row.unit.split('|'))}" if row.unit else ""
    text = f"<{'><'.join(path)}>{unit}" + (f"; by default {row.default}" if row.default is not None else "")
    if row.is_required and len(path) == 1:
        return kind_of, Field(description=text)
    optional: Any = Field(default=None, description=text)  # typed as its default
    return _optional(kind_of), optional


def _optional(kind_of: Any) -> Any:
    return kind_of | None


def _may_repeat(path: Path, kind: PluginKind) -> bool:
    """Whether a parameter, or what is around it, may stand several times."""
    rows = [kind.parameter(*path[: end + 1]) for end in range(len(path))]
    return any(row is not None and row.is_many for row in rows)


def _type(row: PluginParameter) -> Any:
    if row.choices and row.type == "text":
        return Literal[row.choices]
    return _TYPES.get(row.type, str)


def _listed(value: object) -> object:
    return [value] if isinstance(value, str | int | float) else value


def _checker(row: PluginParameter) -> Any:
    def check(value: object) -> object:
        problem = _xml_problem(str(value)) if row.type == "element" else problem_of(row, format_value(value))
        if problem:
            raise ValueError(f"has to be {problem}")
        return value

    return check


def _xml_problem(text: str) -> str | None:
    try:
        _content(text)
    except (etree.XMLSyntaxError, ValueError):
        return "the XML that goes inside"
    return None


def _content(text: str) -> tuple[Element, ...]:
    """The elements that an XML text holds; nothing outside of the text is read."""
    if "<!" in text:
        raise ValueError(text)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    return from_xml(etree.fromstring(f"<content>{text}</content>", parser)).children


class MissingError(Exception):
    """A parameter is needed because of another one; the message names it."""


def content_of(kind: PluginKind, values: Mapping[str, object]) -> tuple[Element, ...]:
    """The content of a plugin with these values, by option.

    A thing that may stand several times stands as often as the longest list of its options has values; an option with
    one value means the same in all of them.

    Raises:
        MissingError: an element that is there lacks one that it needs.
    """
    options = options_of(kind)
    chosen = {options[name][0]: value for name, value in values.items() if value is not None}
    return tuple(_elements((), kind.parameters, chosen, None))


def _elements(
    above: Path, rows: tuple[PluginParameter, ...], chosen: Mapping[Path, object], turn: int | None
) -> Iterator[Element]:
    for row in rows:
        if row.is_attribute:
            continue
        for name in _names(row.name):
            path = (*above, name)
            inside = {each: value for each, value in chosen.items() if each[: len(path)] == path}
            turns = _turns(inside, turn) if inside and row.is_many else [turn]
            for each in turns if inside else ():
                yield _element(path, row, inside, each)


def _turns(inside: Mapping[Path, object], turn: int | None) -> list[int | None]:
    """The places in the lists of values, one for each time that the thing stands."""
    if turn is not None:
        return [turn]
    return list(range(max(map(_length, inside.values()))))


def _length(value: object) -> int:
    return len(cast("tuple[object, ...]", value)) if isinstance(value, tuple) else 1


def _element(path: Path, row: PluginParameter, chosen: Mapping[Path, object], turn: int | None) -> Element:
    attributes: list[tuple[str, str]] = []
    for each in row.children:
        value = _text(chosen.get((*path, each.name)), turn)
        if each.is_attribute and value is not None:
            attributes.append((each.name[1:], value))
        elif each.is_required and not any(key[: len(path) + 1] == (*path, each.name) for key in chosen):
            raise MissingError(_option((*path, each.name)))
    own = _text(chosen.get(path), turn)
    if row.type == "element" and row.free:
        return Element(name=path[-1], attributes=tuple(attributes), children=_content(own or ""))
    children = tuple(_elements(path, row.children, chosen, turn))
    return Element(name=path[-1], attributes=tuple(attributes), text=own, children=children)


def _text(value: object, turn: int | None) -> str | None:
    """The text of a value; that of the turn, where it is a list of one for each time that a thing stands."""
    if turn is not None and isinstance(value, tuple):
        values = cast("tuple[object, ...]", value)
        value = values[turn if turn < len(values) else -1]
    return None if value is None else format_value(value)
