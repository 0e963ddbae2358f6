"""Pipelines as text and as tables of TOML: parsing and printing. The grammar of the text is in `syntax.py`.

A table lists the passes; the keys of each row are its options:

    [[pipelines.robot]]
    pass = "fill-limits"
    effort = 100
    joints = ["arm_*", "wrist"]

    [[pipelines.robot]]
    pass = "@checks"

`pass` is the name of a pass, or `@` and the name of another pipeline, which takes no options. No option can be called
`pass`, since options are fields in Python, where it is a keyword. TOML has no null: an empty table, `{}`, stands for
what is `null` in the text of a pipeline.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from typing import cast

from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_options import OptionError, build, chosen
from twinform.passes.framework.pipeline import Pipeline
from twinform.passes.framework.syntax import (
    KEY,
    Call,
    PipelineError,
    PipelineReference,
    Scalar,
    Value,
    parse_calls,
    print_number,
)


class UnknownPipelineError(LookupError):
    """No pipeline has this name; the message is for users."""


Names = Callable[[str], Pipeline]
"""The pipeline of a name. Raises `UnknownPipelineError` where there is none."""


def no_names(name: str) -> Pipeline:
    """Look up no pipeline: every name is unknown."""
    raise UnknownPipelineError(f"no pipeline is called {name}: no configuration names any")


def parse_pipeline(text: str, *, names: Names = no_names, kinds: Mapping[str, type[Pass]] | None = None) -> Pipeline:
    """Parse the text of a pipeline.

    `names` finds the pipelines that `@NAME` refers to; `kinds` are passes besides the installed ones.

    Raises:
        PipelineError: the text is wrong; the error points at the character.
    """
    return Pipeline(tuple(_build_passes(text, names, kinds)))


def _build_passes(text: str, names: Names, kinds: Mapping[str, type[Pass]] | None) -> Iterator[Pass]:
    for part in parse_calls(text):
        if isinstance(part, PipelineReference):
            yield from _expand_reference(part, text, names)
        else:
            yield _build_call(part, text, kinds)


def _expand_reference(reference: PipelineReference, text: str, names: Names) -> Pipeline:
    try:
        return names(reference.name)
    except UnknownPipelineError as error:
        raise PipelineError(str(error), text, reference.position) from error


def _build_call(call: Call, text: str, kinds: Mapping[str, type[Pass]] | None) -> Pass:
    try:
        return build(call.name, {option.name: option.value for option in call.options}, kinds)
    except OptionError as error:
        raise PipelineError(error.problem, text, _error_position(error, call)) from error


def _error_position(error: OptionError, call: Call) -> int:
    """The position of a mistake in the text: the name of an option, its value or the pass."""
    for option in call.options:
        if option.name == error.option:
            return option.position if error.wrong_name else option.value_position
    return call.position


_KEY = "pass"
Table = dict[str, object]


class TableError(ValueError):
    """A value of a TOML file is not a pipeline. `key` is its dotted key, with list indices in brackets."""

    def __init__(self, problem: str, key: str) -> None:
        super().__init__(f"{key}: {problem}")
        self.problem, self.key = problem, key


def parse_tables(rows: object, *, names: Names = no_names) -> Pipeline:
    """Parse a value of a TOML file as a pipeline.

    Raises:
        TableError: it is no pipeline.
    """
    if not isinstance(rows, list):
        raise TableError("expected text, or a list of tables with the key pass", "")
    parts = enumerate(cast("list[object]", rows))
    return Pipeline(tuple(step for at, row in parts for step in _build_row(row, f"[{at}]", names)))


def _build_row(row: object, key: str, names: Names) -> Pipeline:
    if not isinstance(row, dict):
        raise TableError(f"expected a table with the key {_KEY}", key)
    options = dict(cast("Table", row))
    name = options.pop(_KEY, None)
    if not isinstance(name, str):
        raise TableError(f"the table needs the key {_KEY}, which is text", key)
    if name.startswith("@"):
        return _expand_name(name, options, key, names)
    return Pipeline((_build_pass(name, options, key),))


def _expand_name(name: str, options: Table, key: str, names: Names) -> Pipeline:
    if options:
        raise TableError(f"{name} is a pipeline and takes no options", f"{key}.{next(iter(options))}")
    try:
        return names(name[1:])
    except UnknownPipelineError as error:
        raise TableError(str(error), f"{key}.{_KEY}") from error


def _build_pass(name: str, options: Table, key: str) -> Pass:
    values = {option: _read_value(value, f"{key}.{option}") for option, value in options.items()}
    try:
        return build(name, values)
    except OptionError as error:
        raise TableError(error.problem, f"{key}.{error.option or _KEY}") from error


def _read_value(value: object, key: str) -> Value:
    if isinstance(value, list):
        return [_read_scalar(item, f"{key}[{at}]") for at, item in enumerate(cast("list[object]", value))]
    return _read_scalar(value, key)


def _read_scalar(value: object, key: str) -> Scalar:
    if value == {}:
        return None
    if isinstance(value, str | int | float):
        return value
    raise TableError("expected text, a number, true, false, a list of these, or {} for nothing", key)


def tables(pipeline: Pipeline) -> list[Table]:
    """The pipeline as rows of a TOML table, without options that have their defaults.

    Raises:
        TypeError: an option has a value that has no form in a pipeline.
    """
    return [{_KEY: step.name, **dict(chosen(step))} for step in pipeline]


def print_tables(pipeline: Pipeline, name: str) -> str:
    """The text that defines a pipeline of this name in a TOML file.

    Raises:
        TypeError: an option has a value that has no form in a pipeline.
        ValueError: the name is no key.
    """
    if not KEY.fullmatch(name):
        raise ValueError(f"{name!r} is not a valid name of a pipeline: use letters, digits, _ and -")
    if not len(pipeline):
        return f"[pipelines]\n{name} = []\n"
    return "\n".join(f"[[pipelines.{name}]]\n{''.join(_print_row(row))}" for row in tables(pipeline))


def _print_row(row: Mapping[str, object]) -> Iterator[str]:
    return (f"{key} = {_print_toml(value)}\n" for key, value in row.items())


def _print_toml(value: object) -> str:
    """A value in TOML, whose strings are those of JSON except for the delete character."""
    if value is None:
        return "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(_print_toml, cast('list[object]', value)))}]"
    if isinstance(value, float):
        return print_number(value)
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
