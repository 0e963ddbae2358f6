"""Declarations of options: each is written once for Python's keywords, the command line and the configuration.

`FileOptions`, `ConversionOptions` and others are typed dictionaries: a function takes them as keywords
(`**options: Unpack[FileOptions]`), the command line makes its flags of them, and a configuration sets their defaults.
The default of an option is that of the field which it fills.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, TypeVar, get_args, get_origin

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
    """Refuse keywords that are not options of a typed dictionary.

    Raises:
        TypeError: as Python does where a function does not take a keyword.
    """
    names = known.__annotations__
    for name in given:
        if name not in names:
            from twinform.diagnostics.did_you_mean import did_you_mean  # noqa: PLC0415 - few keywords are misspelt

            hint = did_you_mean(name, names)
            raise TypeError(f"there is no option {name!r}{f'; {hint}' if hint else ''}")


def given(value: Value | None, usual: Value) -> Value:
    """Return the value of an option, or the usual one where it is None."""
    return usual if value is None else value
