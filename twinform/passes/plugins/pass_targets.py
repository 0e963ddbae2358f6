"""Targets of a pass: the model, world, link or sensor of a document that it adds to."""

from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Model, World
from twinform.ir.scopes import SCOPE, nested_models, outer_models, scoped_models
from twinform.passes.plugins.catalog import nearest


def models_of(document: Document) -> Iterator[tuple[str, Model]]:
    """Every model with its name, that of nested ones in full."""
    for model in outer_models(document):
        for scope, each in scoped_models(model, model.name + SCOPE):
            yield scope.removesuffix(SCOPE), each


def find_model(document: Document, name: str | None, sink: DiagnosticSink) -> Model | None:
    """The model of this name, or the only one; None, with a finding, where there is none or the name is needed."""
    models = list(models_of(document))
    # A nested model is never "the only one": it has to be named, since the model around it is meant
    # otherwise.
    outer = [model for called, model in models if SCOPE not in called]
    if name is None and len(outer) == 1:
        return outer[0]
    found = next((model for called, model in models if called == name), None)
    if found is None:
        missing(document, "model", name, [called for called, _ in models], sink)
    return found


def find_world(document: Document, name: str | None, sink: DiagnosticSink) -> World | None:
    """The world of this name, or the only one; None, with a finding, where there is none or the name is needed."""
    if name is None and len(document.worlds) == 1:
        return document.worlds[0]
    found = next((world for world in document.worlds if world.name == name), None)
    if found is None:
        missing(document, "world", name, [world.name for world in document.worlds], sink)
    return found


def world_of(document: Document, model: Model) -> World | None:
    """The world that a model is in."""
    for world in document.worlds:
        if any(each is model for outer in world.models for each in nested_models(outer)):
            return world
    return None


def missing(document: Document | Model, what: str, name: str | None, known: list[str], sink: DiagnosticSink) -> None:
    """Report that there is nothing to add to."""
    if name is None:
        message = f"there are several: {', '.join(known)}" if known else "there is none"
        sink.report(rules.NOTHING_TO_ADD_TO, f"it is not clear which {what} to add to: {message}", document.location)
        return
    near = nearest(name, known)
    help_ = f"did you mean {near}?" if near else f"there are {', '.join(known)}" if known else None
    message = f"there is no {what} {name!r} to add to"
    sink.report(rules.NOTHING_TO_ADD_TO, message, document.location, found=name, help=help_)
