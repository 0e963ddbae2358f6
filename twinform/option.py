"""Declarations of options: each is written once for Python's keywords, the command line and the configuration.

`FileOptions`, `ConversionOptions` and others are typed dictionaries: a function takes them as keywords
(`**options: Unpack[FileOptions]`), the command line makes its flags of them, and a configuration sets their defaults.
The default of an option is that of the field which it fills.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin

from twinform.dataclass import dataclass

Value = TypeVar("Value")


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """How an option is written on the command line and in a configuration.

    `flag` is its name on the command line where that is another one than in Python. `parse` makes a value of a text
    that was typed, and raises `ValueError`. `known` lists the values that a shell completes. A `setting` may stand in
    a configuration, where only a trusted one may have a value above `most`. A `switch` has no `--no-` beside it.
    """

    help: str
    flag: str = ""
    metavar: str | None = None
    parse: Callable[[str], object] | None = None
    known: Callable[[], Sequence[str]] | None = None
    most: int | None = None
    setting: bool = False
    switch: bool = False


def declared_options(options: type) -> Mapping[str, tuple[Any, Option]]:
    """Return the type and declaration of each option of a typed dictionary, except those that only Python has."""
    annotated = [(name, each) for name, each in options.__annotations__.items() if get_origin(each) is Annotated]
    return {name: (kind, option) for name, each in annotated for kind, option in [get_args(each)]}


def require_options(given: Mapping[str, object], known: type) -> None:
    """Refuse keywords that are not options of a typed dictionary, and values that an option does not have.

    Raises:
        TypeError: as Python does where a function does not take a keyword.
        ValueError: there is no such value.
    """
    names = known.__annotations__
    for name, value in given.items():
        if name not in names:
            from twinform.diagnostics.did_you_mean import did_you_mean  # noqa: PLC0415 - few keywords are misspelt

            hint = did_you_mean(name, names)
            raise TypeError(f"there is no option {name!r}{f'; {hint}' if hint else ''}")
        values = values_of(names[name])
        if values:
            require_value(name, value, values)


def values_of(kind: Any) -> tuple[object, ...]:
    """Return the values that an option of a type has, if they can be listed."""
    if get_origin(kind) is Annotated:
        kind = get_args(kind)[0]
    literals = [each for each in (kind, *get_args(kind)) if get_origin(each) is Literal]
    return get_args(literals[0]) if literals else ()


def require_value(name: str, value: object, values: Sequence[object]) -> None:
    """Refuse a value that an option does not have; None stands for one that is not given.

    Raises:
        ValueError: there is no such value.
    """
    if value is not None and value not in values:
        *others, last = map(repr, values)
        raise ValueError(f"{name} is {value!r}; expected {', '.join(others)} or {last}")


def given(value: Value | None, usual: Value) -> Value:
    """Return the value of an option, or the usual one where it is None."""
    return usual if value is None else value
