"""Base classes of passes, and name patterns in options."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from dataclasses import FrozenInstanceError
from fnmatch import fnmatchcase
from functools import cache
from inspect import get_annotations
from typing import TYPE_CHECKING, Any, ClassVar, ParamSpec, Protocol, Self, TypeVar, cast, dataclass_transform

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import UNREAD_DOCUMENT
from twinform.ir import Document, Model, replace_fields
from twinform.passes.framework.assets import NO_ASSETS, Assets

if TYPE_CHECKING:
    from pydantic import Field, PrivateAttr
    from pydantic.fields import FieldInfo

    @dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(Field, PrivateAttr))
    class _WithFields(ABC):  # noqa: B024 - as in `Pass`
        """Tells type checkers that annotated attributes are parameters."""

else:
    _WithFields = ABC

Options = ParamSpec("Options")
AnyPass = TypeVar("AnyPass", bound="Pass")


class _Fields:
    """The options of a class of passes by their names, as Pydantic sees them."""

    def __get__(self, instance: object, kind: "type[Pass]") -> "Mapping[str, FieldInfo]":
        from twinform.passes.framework.options_model import options_model  # noqa: PLC0415 - see `Pass`

        return options_model(kind, Pass).model_fields


def option_name(field_name: str, field: "FieldInfo") -> str:
    """Return the name of an option as people write it."""
    # Pydantic before 2.11 makes the aliases of a model when it is built, which is when options are validated
    return field.alias or field_name.replace("_", "-")


class Pass(_WithFields):
    """A step from IR to IR: a frozen object whose fields are its options.

    It takes and returns valid IR, keeps no state between runs, prints nothing, and opens no file unless that is its
    purpose. It reports what it finds, and what becomes of parts that it cannot keep, as diagnostics.

    Its docstring is an imperative sentence on what it does, then what it `Changes`, in numbered cases where there are
    several, what it `Never touches:`, and its `Diagnostics:`.
    """

    # Fields and validators are those of Pydantic, which is not imported before options of people
    # have to be validated: a conversion makes the fifty passes of legalisation from our own code,
    # and Pydantic would take longer than reading, converting and writing a robot.

    name: ClassVar[str]
    """The name in a pipeline; class and file are named alike."""

    example: ClassVar[str] = ""
    """A pipeline that uses the pass, for the reference page."""

    model_fields: ClassVar[_Fields] = _Fields()

    def __init__(self, /, **options: Any) -> None:
        from twinform.passes.framework.options_model import validated  # noqa: PLC0415 - see above

        kind = type(self)
        vars(self).update(_defaults(kind) | validated(kind, Pass, options))

    @classmethod  # pyright: ignore[reportArgumentType] - a class is a callable that makes its objects
    def unchecked(cls: Callable[Options, AnyPass], *_: Options.args, **options: Options.kwargs) -> AnyPass:
        """A pass whose options come from our own code and need no validation: a type checker has seen them."""
        # A test validates the passes that were made this way.
        kind = cast("type[AnyPass]", cls)
        made = object.__new__(kind)
        vars(made).update(_defaults(kind) | options)
        return made

    @classmethod
    def model_validate(cls, obj: Any) -> Self:
        """The pass with options by their names in Python or in a pipeline; a pass of this class stays as it is.

        Raises:
            ValidationError: an option is unknown, missing or wrong.
        """
        return obj if isinstance(obj, cls) else cls(**obj)

    def model_dump(self, **how: Any) -> dict[str, Any]:
        """The options as data; `how` is what Pydantic's method of this name takes."""
        from twinform.passes.framework.options_model import options_model  # noqa: PLC0415 - see above

        return options_model(type(self), Pass).model_construct(None, **_options(self)).model_dump(**how)

    def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self:
        """A copy with other options, which are not validated."""
        made = object.__new__(type(self))
        vars(made).update({name: getattr(self, name) for name in _attributes(type(self))} | dict(update or {}))
        return made

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in _attributes(type(self)))

    def __hash__(self) -> int:
        return hash((type(self), *_options(self).values()))

    def __setattr__(self, name: str, value: object) -> None:
        raise FrozenInstanceError(f"cannot assign to option {name!r} of a pass; use model_copy")

    def __delattr__(self, name: str) -> None:
        raise FrozenInstanceError(f"cannot delete option {name!r} of a pass")

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in _options(self).items())})"

    @abstractmethod
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document after the pass; the same object where nothing changes."""


@cache
def _attributes(kind: type[Pass]) -> tuple[str, ...]:
    """The options of a class and the attributes that are its own, in their order, those of base classes first."""
    annotated = {
        name: annotation for each in reversed(kind.__mro__) for name, annotation in get_annotations(each).items()
    }
    return tuple(name for name, each in annotated.items() if "ClassVar[" not in str(each))


def _options(step: Pass) -> dict[str, Any]:
    return {name: getattr(step, name) for name in _attributes(type(step)) if not name.startswith("_")}


@cache
def _defaults(kind: type[Pass]) -> dict[str, Any]:
    """The values of attributes that have a default."""
    found = {name: getattr(kind, name) for name in _attributes(kind) if hasattr(kind, name)}
    declared = [name for name, value in found.items() if type(value).__module__ == "pydantic.fields"]
    if not declared:
        return found
    from twinform.passes.framework.options_model import defaults  # noqa: PLC0415 - see `Pass`

    known = defaults(kind, Pass)
    # an option that has to be given has a field and no default
    return {name: known.get(name) if name in declared else value for name, value in found.items()}


class ModelPass(Pass):
    """A pass that runs on each model at the root of the document."""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with each root-level model after the pass."""
        return replace_fields(document, models=tuple(self.run_model(model, sink) for model in document.models))

    @abstractmethod
    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model after the pass."""


class AssetPass(Pass):
    """A pass that opens files which the document names, through assets given by `with_assets`; else it finds none."""

    _assets: Assets = NO_ASSETS

    def with_assets(self, assets: Assets) -> Self:
        """Return a copy of the pass that finds its files through these assets."""
        return self.model_copy(update={"_assets": assets})


class DocumentReader(Protocol):
    """Reads another model file for a pass."""

    def __call__(self, path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        """Read a document, verified and in the format and version of `around`; None after an error.

        `path` is a path or a `package://` or `model://` URI. Relative paths in the file are rewritten to be relative
        to the file of `around`.
        """
        ...


Refusal = Callable[[str], str | None]
"""Why a pass must not read the file at a path; None where it may."""


# Were the files read beforehand, the options of one pass would concern every caller; a registry of
# services would hide what a pass needs.
class DocumentPass(Pass):
    """A pass that needs other documents, which it reads through a reader given by `with_reader`."""

    _reader: DocumentReader | None = None
    _refusal: Refusal | None = None

    def with_reader(self, reader: DocumentReader) -> Self:
        """Return a copy of the pass that reads other documents through this reader."""
        return self.model_copy(update={"_reader": reader})

    def with_refusal(self, refusal: Refusal) -> Self:
        """Return a copy of the pass that reads no document for which `refusal` gives a reason."""
        return self.model_copy(update={"_refusal": refusal})

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document after `run_with`; unchanged, with an error, where there is no reader."""
        if self._reader is not None:
            return self.run_with(document, sink, self._read)
        sink.report(UNREAD_DOCUMENT, f"{self.name} needs other files, and this run cannot read any", document.location)
        return document

    def _read(self, path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        problem = self._refusal(path) if self._refusal else None
        if problem is None:
            return self._reader(path, around, sink) if self._reader else None
        sink.report(UNREAD_DOCUMENT, problem, around.location, found=path)
        return None

    @abstractmethod
    def run_with(self, document: Document, sink: DiagnosticSink, read: DocumentReader) -> Document:
        """The document after the pass; the one that came in where nothing changes."""


class FilesPass(Pass):
    """A pass that makes files beside the result, which therefore needs a folder, and a pipeline that is trusted."""

    @property
    def place(self) -> str:
        """The path of the file, or of the folder of files, below the folder of the result."""
        raise NotImplementedError

    @property
    def only_file(self) -> str | None:
        """The path of the file where the pass makes one; None where it makes a folder of files."""
        return None

    def below(self, folder: str) -> Self:
        """Return the pass with its files in a subfolder; a pass with a fixed place returns itself."""
        del folder
        return self


EVERY = ("*",)
"""The default of an option that selects everything."""


def with_such_a_name(what: str) -> str:
    """The description of an option that selects by name patterns."""
    return f"{what} with such a name; `*`, `?` and `[...]` are wildcards."


def matches(name: str | None, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns matches a name, case-sensitively; None counts as an empty name."""
    return any(fnmatchcase(name or "", pattern) for pattern in patterns)
