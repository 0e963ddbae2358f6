"""Base classes of passes: over a document, and over its models one by one."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar, ParamSpec, TypeVar, cast

from pydantic import BaseModel, ConfigDict

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Model, replace_fields

Options = ParamSpec("Options")
AnyPass = TypeVar("AnyPass", bound="Pass")


class Pass(BaseModel, ABC):
    """A step from IR to IR: a frozen object whose fields are its options.

    Valid IR goes in and valid IR comes out; a pass keeps no state between runs, prints nothing, and opens no file
    unless that is its purpose. What it finds, and what becomes of parts that it cannot keep, goes into the diagnostics.

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
    """Its name in a pipeline; the class and the file have the same name."""

    example: ClassVar[str] = ""
    """A pipeline that uses it, for its page."""

    @classmethod  # pyright: ignore[reportArgumentType] - a class is a callable that makes its objects
    def unchecked(cls: Callable[Options, AnyPass], *_: Options.args, **options: Options.kwargs) -> AnyPass:
        """A pass with options that come from our own code, where a type checker has seen them.

        The first object of a class that is validated makes Pydantic build its validator, which takes longer than to run
        most passes.
        """
        # Before its first validator, Pydantic also looks for plugins in the metadata of every
        # installed package: together a tenth of a short conversion. A test validates the passes
        # that were made this way.
        return cast("type[AnyPass]", cls).model_construct(None, **options)

    @abstractmethod
    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document after the pass; the one that came in where nothing changes."""


class ModelPass(Pass):
    """A pass that looks at the root-level models one by one."""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with every model passed through."""
        return replace_fields(document, models=tuple(self.run_model(model, sink) for model in document.models))

    @abstractmethod
    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model after the pass."""
