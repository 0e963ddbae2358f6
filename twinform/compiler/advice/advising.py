"""`advise`: reads a file once, converts it into the other format, and asks the profiles of all consumers about both."""

from collections.abc import Iterable
from dataclasses import dataclass

from twinform.compiler.advice.choosing import Choice, Facts, choose
from twinform.compiler.advice.consumer_readings import ConsumerReading, readings
from twinform.compiler.advice.forms import Form, converted_form, own_form
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.load_options import Input, LoadOptions
from twinform.compiler.input.loading import XACRO, read
from twinform.ir import Format
from twinform.profiles import Profile


@dataclass(frozen=True, slots=True)
class Advice:
    """The format that a robot is best kept in and why, what the other does not say, and what each consumer does."""

    path: str
    format: Format
    version: str | None
    name: str
    choice: Choice
    other: Form
    consumers: tuple[ConsumerReading, ...]


def advise(
    source: Input,
    profiles: Iterable[Profile],
    load_options: LoadOptions,
    *,
    name: str = "",
    model: str | None = None,
) -> Advice:
    """Say which format a robot is best kept in, and what each consumer would lose. `model` is the one of several.

    Raises:
        CompileError: the file has errors that leave no model.
    """
    loaded = read(source, load_options, name=name)
    document = loaded.document
    if document is None or not loaded.accepted:
        raise CompileError(loaded.diagnostics, unreadable=loaded.unreadable)
    macros = loaded.path.lower().endswith(XACRO) or bool(loaded.origins)
    other = Format.SDF if document.format is Format.URDF else Format.URDF
    forms = {
        document.format: own_form(loaded, document),
        other: converted_form(source, loaded.path, other, load_options, model),
    }
    return Advice(
        loaded.path,
        document.format,
        document.version,
        next((each.name for each in (*document.models, *document.worlds)), ""),
        choose(Facts(document, forms, macros)),
        forms[other],
        tuple(readings(forms, tuple(profiles), load_options, loaded.path)),
    )
