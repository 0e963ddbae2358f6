"""Base classes of passes, and name patterns in options."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from fnmatch import fnmatchcase
from typing import ClassVar, ParamSpec, Protocol, Self, TypeVar, cast

from pydantic import BaseModel, ConfigDict, PrivateAttr

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import UNREAD_DOCUMENT
from twinform.ir import Document, Model, replace_fields
from twinform.passes.framework.assets import NO_ASSETS, Assets

Options = ParamSpec("Options")
AnyPass = TypeVar("AnyPass", bound="Pass")


class Pass(BaseModel, ABC):
    """A step from IR to IR: a frozen object whose fields are its options.

    It takes and returns valid IR, keeps no state between runs, prints nothing, and opens no file unless that is its
    purpose. It reports what it finds, and what becomes of parts that it cannot keep, as diagnostics.

    Its docstring is an imperative sentence on what it does, then what it `Changes`, in numbered cases where there are
    several, what it `Never touches:`, and its `Diagnostics:`.
    """

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        alias_generator=lambda name: name.replace("_", "-"),
        populate_by_name=True,
        defer_build=True,
    )

    name: ClassVar[str]
    """The name in a pipeline; class and file are named alike."""

    example: ClassVar[str] = ""
    """A pipeline that uses the pass, for the reference page."""

    @classmethod  # pyright: ignore[reportArgumentType] - a class is a callable that makes its objects
    def unchecked(cls: Callable[Options, AnyPass], *_: Options.args, **options: Options.kwargs) -> AnyPass:
        """A pass whose options come from our own code and need no validation: a type checker has seen them.

        Building the validator of a class takes Pydantic longer than most passes take to run.
        """
        # Before its first validator, Pydantic also looks for plugins in the metadata of every
        # installed package: together a tenth of a short conversion. A test validates the passes
        # that were made this way.
        return cast("type[AnyPass]", cls).model_construct(None, **options)

    @abstractmethod
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document after the pass; the same object where nothing changes."""


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

    _assets: Assets = PrivateAttr(default_factory=lambda: NO_ASSETS)  # one object, so that equal passes are equal

    def with_assets(self, assets: Assets) -> Self:
        """Return a copy of the pass that finds its files through these assets."""
        bound = self.model_copy()
        bound._assets = assets  # noqa: SLF001 - its own
        return bound


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

    _reader: DocumentReader | None = PrivateAttr(default=None)
    _refusal: Refusal | None = PrivateAttr(default=None)

    def with_reader(self, reader: DocumentReader) -> Self:
        """Return a copy of the pass that reads other documents through this reader."""
        bound = self.model_copy()
        bound._reader = reader  # noqa: SLF001 - its own
        return bound

    def with_refusal(self, refusal: Refusal) -> Self:
        """Return a copy of the pass that reads no document for which `refusal` gives a reason."""
        bound = self.model_copy()
        bound._refusal = refusal  # noqa: SLF001 - its own
        return bound

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


EVERY = ("*",)
"""The default of an option that selects everything."""


def with_such_a_name(what: str) -> str:
    """The description of an option that selects by name patterns."""
    return f"{what} with such a name; `*`, `?` and `[...]` are wildcards."


def matches(name: str | None, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns matches a name, case-sensitively; None counts as an empty name."""
    return any(fnmatchcase(name or "", pattern) for pattern in patterns)
