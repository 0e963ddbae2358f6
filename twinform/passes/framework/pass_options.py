"""Options of passes: building a pass from options, and reading the options of a pass back."""

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from pathlib import PurePath
from typing import cast, get_origin

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from twinform.passes.framework.pass_base import Pass, option_name
from twinform.passes.framework.pass_registry import UnknownPassError, find_pass, registered_passes
from twinform.passes.framework.syntax import Scalar, Value

_HINTS = {"string_type": "; quote it to make it text"}
"""Advice by the type of an error of Pydantic."""


class OptionError(ValueError):
    """A pass does not exist, or refuses its options. `option` is the wrong one, if it can be named."""

    def __init__(self, problem: str, option: str | None = None, *, wrong_name: bool = False) -> None:
        super().__init__(problem)
        self.problem, self.option, self.wrong_name = problem, option, wrong_name


def build(name: str, options: Mapping[str, Value], kinds: Mapping[str, type[Pass]] | None = None) -> Pass:
    """Build the pass of a name with options; `kinds` are passes besides the installed ones.

    Raises:
        OptionError: there is no such pass, or it refuses the options.
    """
    kind = (kinds or {}).get(name) or _installed(name)
    fields = {option_name(key, field): field for key, field in kind.model_fields.items()}
    try:
        return kind.model_validate({key: _fit(value, fields.get(key)) for key, value in options.items()})
    except ValidationError as error:
        raise _readable(error, name, options, fields) from error


def _installed(name: str) -> type[Pass]:
    try:
        return find_pass(name)
    except UnknownPassError as error:
        raise OptionError(f"no pass is called {name}{nearest(name, list(registered_passes()))}") from error


def nearest(name: str, known: Sequence[str], there: str = "there are") -> str:
    """The end of an error message: the known name closest to a wrong one, or else all known names."""
    from difflib import get_close_matches  # noqa: PLC0415 - most names are right

    near = get_close_matches(name, known, n=1)
    return f"; did you mean {near[0]}?" if near else f"; {there} {', '.join(known) or 'none'}"


def _fit(value: Value, field: FieldInfo | None) -> object:
    """The value of an option; a single value of a list option becomes a list of one."""
    return [value] if field and takes_list(field) and not isinstance(value, list) and value is not None else value


def takes_list(field: FieldInfo) -> bool:
    """Whether an option is a list."""
    return get_origin(field.annotation) in {tuple, list, frozenset}


def _readable(
    error: ValidationError, name: str, written: Mapping[str, Value], fields: Mapping[str, FieldInfo]
) -> OptionError:
    """The first error of Pydantic in the syntax of a pipeline."""
    problem = error.errors(include_url=False)[0]
    option = str(problem["loc"][0]) if problem["loc"] else ""
    if problem["type"] == "extra_forbidden":
        return OptionError(
            f"{name} has no option {option}{nearest(option, sorted(fields), 'it has')}", option, wrong_name=True
        )
    if problem["type"] == "missing":
        return OptionError(f"{name} needs the option {option}")
    complaint = problem["msg"].removeprefix("Value error, ").removeprefix("Input ")
    if option not in written:
        return OptionError(f"{name}: {complaint}")
    return OptionError(f"option {option} of {name}: {complaint}{_HINTS.get(problem['type'], '')}", option)


def chosen(step: Pass) -> Iterator[tuple[str, Value]]:
    """The options that differ from their defaults, in the order of the class; a list of one is a single value.

    Raises:
        TypeError: an option has a value that has no form in a pipeline.
    """
    for name, field in type(step).model_fields.items():
        value: object = getattr(step, name)
        if value == field.get_default(call_default_factory=True, validated_data={}):
            continue
        words = option_value(value)
        alone = isinstance(words, list) and len(words) == 1 and takes_list(field) and words[0] is not None
        yield option_name(name, field), words[0] if isinstance(words, list) and alone else words


def option_value(value: object) -> Value:
    """The value of an option as the text of a pipeline has it.

    Raises:
        TypeError: it has no form in a pipeline.
    """
    if isinstance(value, tuple | list):
        return [_scalar(item) for item in cast("Sequence[object]", value)]
    if isinstance(value, frozenset):
        items = cast("frozenset[object]", value)
        return sorted((_scalar(item) for item in items), key=repr)  # a set has no order of its own
    return _scalar(value)


def _scalar(value: object) -> Scalar:
    if isinstance(value, Enum):
        return _scalar(value.value)
    if isinstance(value, PurePath):
        return str(value)
    if value is None or isinstance(value, str | int | float):
        return value
    raise TypeError(f"a pipeline cannot express {value!r}")
