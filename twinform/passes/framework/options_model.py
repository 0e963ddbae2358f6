"""The Pydantic model of a pass's options, made of the class of the pass when options have to be validated."""

from functools import cache
from inspect import get_annotations
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict

_COPIED = ("__module__", "__qualname__", "__doc__")


class Options(BaseModel):
    """The base of all models of options."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        alias_generator=lambda name: name.replace("_", "-"),
        populate_by_name=True,
        defer_build=True,
    )
    name: ClassVar[str]
    example: ClassVar[str]


@cache
def options_model(kind: type[Any], root: type[Any]) -> type[BaseModel]:
    """The model of a class of passes, of which `root` is the first: fields, validators, and what validators call."""
    if kind is root:
        return Options
    bases: tuple[type[Any], ...] = kind.__bases__
    models = tuple(options_model(each, root) if issubclass(each, root) else each for each in bases)
    own = {name: value for name, value in vars(kind).items() if name in _COPIED or _belongs(name)}
    metaclass: Any = type(Options)
    return metaclass(kind.__name__, models, own | {"__annotations__": get_annotations(kind)})


def _belongs(name: str) -> bool:
    """Whether an attribute of a pass is one of its model; those of Python and Pydantic a model has itself."""
    return not (name.startswith(("__", "_abc_")) or hasattr(BaseModel, name))


def validated(kind: type[Any], root: type[Any], options: Any) -> dict[str, Any]:
    """The values of all options.

    Raises:
        ValidationError: an option is unknown, missing or wrong.
    """
    return vars(options_model(kind, root).model_validate(options))


def defaults(kind: type[Any], root: type[Any]) -> dict[str, Any]:
    """The defaults of options and private attributes, as Pydantic has them."""
    made = options_model(kind, root).model_construct()
    return vars(made) | (made.__pydantic_private__ or {})
