"""Passes in a row, and the text that stands for them. The grammar of the text is in `syntax.py`."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum
from pathlib import PurePath
from typing import cast, get_origin

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from twinform.diagnostics import Diagnostic, Notes
from twinform.ir import Document
from twinform.passes.base import Pass
from twinform.passes.other_documents import DocumentPass, DocumentReader
from twinform.passes.registry import UnknownPassError, find_pass, registered_passes
from twinform.passes.syntax import Call, Option, PipelineError, Scalar, Value, parse_calls, print_call

Watch = Callable[[str, Document], None]
"""Is called after each pass with its name and the document that it made."""

Verifier = Callable[[Document, Notes], None]
"""Notes what is wrong with a document; `twinform.ir.verify` has it."""


class BrokenPassError(Exception):
    """A pass made IR that is not valid: a fault of the pass, not of the model."""

    def __init__(self, name: str, problems: Sequence[Diagnostic]) -> None:
        self.name, self.problems = name, tuple(problems)
        found = "; ".join(f"{each.message} [{each.rule.name}]" for each in problems)
        super().__init__(f"the pass {name} made an invalid document: {found}")


@dataclass(frozen=True, slots=True)
class Pipeline:
    """Passes that run one after the other."""

    passes: tuple[Pass, ...] = ()

    def run(
        self,
        document: Document,
        notes: Notes,
        watch: Watch | None = None,
        verify: Verifier | None = None,
        reader: DocumentReader | None = None,
    ) -> Document:
        """The document after all passes; a document that a pass changed is verified.

        `reader` is for passes that need other documents.

        Raises:
            BrokenPassError: a pass made IR that the verifier refuses.
        """
        for each in self.passes:
            before, document = document, _run(each, document, notes, reader)
            if verify and document is not before:
                _require_valid(document, each.name, verify)
            if watch:
                watch(each.name, document)
        return document

    def __iter__(self) -> Iterator[Pass]:
        return iter(self.passes)

    def __len__(self) -> int:
        return len(self.passes)

    def __str__(self) -> str:
        return print_pipeline(self)


def _run(each: Pass, document: Document, notes: Notes, reader: DocumentReader | None) -> Document:
    try:
        if reader is not None and isinstance(each, DocumentPass):
            return each.run_with(document, notes, reader)
        return each.run(document, notes)
    except Exception as error:
        error.add_note(f"in the pass {each.name}")
        raise


def _require_valid(document: Document, name: str, verify: Verifier) -> None:
    """Warnings are left out: the document had them before, or the pass has said so itself."""
    found = Notes()
    verify(document, found)
    if found.has_errors:
        raise BrokenPassError(name, [each for each in found.diagnostics if each.is_error])


def parse_pipeline(text: str) -> Pipeline:
    """The pipeline that a text stands for.

    Raises:
        PipelineError: the text is wrong; the error points at the character.
    """
    return Pipeline(tuple(_build(call, text) for call in parse_calls(text)))


def _build(call: Call, text: str) -> Pass:
    try:
        kind = find_pass(call.name)
    except UnknownPassError as error:
        raise PipelineError(f"no pass is called {call.name}{_nearest(call.name)}", text, call.position) from error
    fields = {field.alias or name: field for name, field in kind.model_fields.items()}
    try:
        return kind.model_validate(
            {option.name: _fit(option.value, fields.get(option.name)) for option in call.options}
        )
    except ValidationError as error:
        raise _readable(error, call, text, sorted(fields)) from error


def _nearest(name: str) -> str:
    """A guess at what was meant, as the end of a sentence."""
    near = get_close_matches(name, registered_passes(), n=1)
    return f"; did you mean {near[0]}?" if near else f"; there are {', '.join(registered_passes()) or 'none'}"


def _fit(value: Value, field: FieldInfo | None) -> object:
    """One value where the option is a list stands for a list of one."""
    return [value] if field and _takes_list(field) and not isinstance(value, list) and value is not None else value


def _takes_list(field: FieldInfo) -> bool:
    return get_origin(field.annotation) in {tuple, list, frozenset}


def _readable(error: ValidationError, call: Call, text: str, known: Sequence[str]) -> PipelineError:
    """Pydantic's first complaint in the words of the pipeline."""
    problem = error.errors(include_url=False)[0]
    name = str(problem["loc"][0]) if problem["loc"] else ""
    written: dict[str, Option] = {option.name: option for option in call.options}
    if problem["type"] == "extra_forbidden":
        options = f"it has {', '.join(known)}" if known else "it has none"
        return PipelineError(f"{call.name} has no option {name}; {options}", text, written[name].position)
    if problem["type"] == "missing":
        return PipelineError(f"{call.name} needs the option {name}", text, call.position)
    complaint = problem["msg"].removeprefix("Value error, ").removeprefix("Input ")
    if name not in written:
        return PipelineError(f"{call.name}: {complaint}", text, call.position)
    hint = "; quote it to make it text" if problem["type"] == "string_type" else ""
    return PipelineError(f"option {name} of {call.name}: {complaint}{hint}", text, written[name].value_position)


def print_pipeline(passes: Iterable[Pass]) -> str:
    """The canonical text of a pipeline: defaults are left out, and parsing it gives the same pipeline back.

    Raises:
        TypeError: an option has a value that the text cannot say.
    """
    return ",".join(print_call(each.name, dict(_chosen(each))) for each in passes)


def _chosen(each: Pass) -> Iterator[tuple[str, Value]]:
    """The options that differ from their defaults, in the order of the class."""
    for name, field in type(each).model_fields.items():
        value: object = getattr(each, name)
        if value == field.get_default(call_default_factory=True, validated_data={}):
            continue
        words = option_value(value)
        alone = isinstance(words, list) and len(words) == 1 and _takes_list(field) and words[0] is not None
        yield field.alias or name, words[0] if isinstance(words, list) and alone else words


def option_value(value: object) -> Value:
    """The value of an option as the text of a pipeline has it.

    Raises:
        TypeError: the text cannot say it.
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
    raise TypeError(f"a pipeline cannot say {value!r}")
