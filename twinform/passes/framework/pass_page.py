"""The page of a pass: its docstring and its options, as `passes` and the reference show them."""

from collections.abc import Iterator
from enum import Enum
from inspect import cleandoc
from types import NoneType, UnionType
from typing import Annotated, Literal, NamedTuple, Union, cast, get_args, get_origin

from twinform.passes.framework.pass_base import Pass, option_name
from twinform.passes.framework.pass_options import option_value
from twinform.passes.framework.syntax import Value, print_value

_WORDS: dict[object, str] = {str: "text", float: "number", int: "whole number", bool: "true or false"}


class OptionPage(NamedTuple):
    """An option on the page of a pass.

    `default` is for people and `value` for programs; an option that is not `given` by default is required.
    """

    name: str
    type: str
    default: str
    text: str
    given: bool
    value: Value


def description(kind: type[Pass]) -> str:
    """The docstring of a pass, without indentation."""
    return cleandoc(kind.__doc__ or "")


def summary(kind: type[Pass]) -> str:
    """The first line of the docstring of a pass."""
    return description(kind).partition("\n")[0]


def options(kind: type[Pass]) -> Iterator[OptionPage]:
    """The options of a pass in the order of the class."""
    for name, field in kind.model_fields.items():
        given = not field.is_required()
        default: object = field.get_default(call_default_factory=True, validated_data={}) if given else None
        value = option_value(default)
        words = _default(value) if given else "has to be given"
        written, kind_of_value = option_name(name, field), _words(field.annotation)
        yield OptionPage(written, kind_of_value, words, field.description or "", given, value)


def _default(value: Value) -> str:
    return "not set" if value is None else print_value(value)


def _words(annotation: object) -> str:
    """A type in words that fit the grammar of pipelines."""
    inner = cast("tuple[object, ...]", get_args(annotation))
    origin = get_origin(annotation)
    if origin is Annotated:
        return _words(inner[0])
    if origin in {UnionType, Union}:
        return " or ".join(_words(each) for each in inner if each is not NoneType)
    if origin in {tuple, list, frozenset}:
        return f"list of {_words(inner[0])}"
    if origin is Literal:
        return " or ".join(map(str, inner))
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        return " or ".join(str(each.value) for each in annotation)
    return _WORDS.get(cast("object", annotation), "text")
