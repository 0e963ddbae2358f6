"""Pipelines as text: parsing one, and the named pipelines that `@NAME` refers to. The grammar is in `syntax.py`."""

from collections.abc import Callable, Iterator, Mapping

from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_options import OptionError, build
from twinform.passes.framework.pipeline import Pipeline
from twinform.passes.framework.syntax import Call, PipelineError, PipelineReference, parse_calls


class UnknownPipelineError(LookupError):
    """No pipeline has this name; the message is for users."""


Names = Callable[[str], Pipeline]
"""The pipeline of a name. Raises `UnknownPipelineError` where there is none."""


def no_names(name: str) -> Pipeline:
    """Knows no names."""
    raise UnknownPipelineError(f"no pipeline is called {name}: no configuration names any")


def parse_pipeline(text: str, *, names: Names = no_names, kinds: Mapping[str, type[Pass]] | None = None) -> Pipeline:
    """The pipeline that a text stands for.

    `names` knows the pipelines that `@NAME` stands for; `kinds` are passes to know besides those that are installed.

    Raises:
        PipelineError: the text is wrong; the error points at the character.
    """
    return Pipeline(tuple(_passes(text, names, kinds)))


def _passes(text: str, names: Names, kinds: Mapping[str, type[Pass]] | None) -> Iterator[Pass]:
    for part in parse_calls(text):
        if isinstance(part, PipelineReference):
            yield from _named(part, text, names)
        else:
            yield _build(part, text, kinds)


def _named(reference: PipelineReference, text: str, names: Names) -> Pipeline:
    try:
        return names(reference.name)
    except UnknownPipelineError as error:
        raise PipelineError(str(error), text, reference.position) from error


def _build(call: Call, text: str, kinds: Mapping[str, type[Pass]] | None) -> Pass:
    try:
        return build(call.name, {option.name: option.value for option in call.options}, kinds)
    except OptionError as error:
        raise PipelineError(error.problem, text, _position(error, call)) from error


def _position(error: OptionError, call: Call) -> int:
    """Where the text is wrong: at the name of an option, at its value or at the pass."""
    for option in call.options:
        if option.name == error.option:
            return option.position if error.wrong_name else option.value_position
    return call.position
