"""Pipelines as tables of TOML: a list with a table for each pass, whose other keys are its options.

    [[pipelines.robot]]
    pass = "fill-limits"
    effort = 100
    joints = ["arm_*", "wrist"]

    [[pipelines.robot]]
    pass = "@checks"

`pass` is the name of a pass, or `@` and that of another pipeline, which takes no options. No option can be called
`pass`: options are fields in Python, where it is a keyword. TOML has no null; an empty table, `{}`, stands
for what is `null` in the text of a pipeline.
"""

import json
from collections.abc import Iterator, Mapping
from typing import cast

from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_options import OptionError, build, chosen
from twinform.passes.framework.pipeline import Pipeline
from twinform.passes.framework.syntax import KEY, Scalar, Value
from twinform.passes.framework.text import Names, UnknownPipelineError, no_names

_NAME = "pass"
Table = dict[str, object]


class TableError(ValueError):
    """A table is no pipeline. `key` is its place, in the notation of TOML's keys with places in brackets."""

    def __init__(self, problem: str, key: str) -> None:
        super().__init__(f"{key}: {problem}")
        self.problem, self.key = problem, key


def parse_tables(rows: object, *, names: Names = no_names) -> Pipeline:
    """The pipeline that a value from a TOML file stands for.

    Raises:
        TableError: it is no pipeline.
    """
    if not isinstance(rows, list):
        raise TableError("expected text, or a list of tables with the key pass", "")
    parts = enumerate(cast("list[object]", rows))
    return Pipeline(tuple(step for at, row in parts for step in _row(row, f"[{at}]", names)))


def _row(row: object, key: str, names: Names) -> Pipeline:
    if not isinstance(row, dict):
        raise TableError(f"expected a table with the key {_NAME}", key)
    options = dict(cast("Table", row))
    name = options.pop(_NAME, None)
    if not isinstance(name, str):
        raise TableError(f"the table needs the key {_NAME}, which is text", key)
    return _named(name, options, key, names) if name.startswith("@") else Pipeline((_pass(name, options, key),))


def _named(name: str, options: Table, key: str, names: Names) -> Pipeline:
    if options:
        raise TableError(f"{name} is a pipeline and takes no options", f"{key}.{next(iter(options))}")
    try:
        return names(name[1:])
    except UnknownPipelineError as error:
        raise TableError(str(error), f"{key}.{_NAME}") from error


def _pass(name: str, options: Table, key: str) -> Pass:
    values = {option: _value(value, f"{key}.{option}") for option, value in options.items()}
    try:
        return build(name, values)
    except OptionError as error:
        raise TableError(error.problem, f"{key}.{error.option or _NAME}") from error


def _value(value: object, key: str) -> Value:
    if isinstance(value, list):
        return [_scalar(item, f"{key}[{at}]") for at, item in enumerate(cast("list[object]", value))]
    return _scalar(value, key)


def _scalar(value: object, key: str) -> Scalar:
    if value == {}:
        return None
    if isinstance(value, str | int | float):
        return value
    raise TableError("expected text, a number, true, false, a list of these, or {} for nothing", key)


def tables(pipeline: Pipeline) -> list[Table]:
    """The pipeline as TOML has it; options that have their defaults are left out.

    Raises:
        TypeError: an option has a value that has no form in a pipeline.
    """
    return [{_NAME: step.name, **dict(chosen(step))} for step in pipeline]


def print_tables(pipeline: Pipeline, name: str) -> str:
    """The text of a pipeline of this name in a TOML file.

    Raises:
        TypeError: an option has a value that has no form in a pipeline.
        ValueError: the name is no key.
    """
    if not KEY.fullmatch(name):
        raise ValueError(f"{name!r} is not a valid name of a pipeline: use letters, digits, _ and -")
    if not len(pipeline):
        return f"[pipelines]\n{name} = []\n"
    return "\n".join(f"[[pipelines.{name}]]\n{''.join(_lines(row))}" for row in tables(pipeline))


def _lines(row: Mapping[str, object]) -> Iterator[str]:
    return (f"{key} = {_print(value)}\n" for key, value in row.items())


def _print(value: object) -> str:
    """A value in TOML, whose strings are those of JSON but for the character for deletion."""
    if value is None:
        return "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(_print, cast('list[object]', value)))}]"
    if isinstance(value, float):
        return repr(value).removesuffix(".0") if value else repr(value)  # -0.0 keeps its sign only with its point
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
