"""Settings of nested models: those that their links can have, and those that only a model has."""

from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Link, Model
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation

_OF_LINKS = ("self_collide", "enable_wind")
_OWN = "own-settings"
"""The annotation on a link that has a setting itself which its model has too."""


def settle_links(model: Model, *, annotated: bool = False) -> Model:
    """The model, in the models of which links have the settings that their model has for them."""
    models = (settle_links(_settled(inner, annotated=annotated), annotated=annotated) for inner in model.models)
    return model.copy(models=tuple(models))


def _settled(model: Model, *, annotated: bool) -> Model:
    settings = {field: value for field in _OF_LINKS if (value := getattr(model, field)) is not None}
    return model.copy(links=tuple(_with_settings(link, settings, annotated=annotated) for link in model.links))


def _with_settings(link: Link, settings: dict[str, bool], *, annotated: bool) -> Link:
    update = {field: value for field, value in settings.items() if getattr(link, field) is None}
    own = " ".join(field for field, value in settings.items() if getattr(link, field) == value)
    link = link.copy(**update) if update else link
    return with_annotation(link, _OWN, own) if annotated and own else link


def unsettle_links(model: Model, sink: DiagnosticSink) -> Model:
    """A nested model, whose links have no more the settings that they have of their model.

    A setting that one of them lacks has been deleted, and the model loses it too.
    """
    for field in _OF_LINKS:
        value = getattr(model, field)
        if value is None:
            continue
        if any(getattr(link, field) is None for link in model.links):
            message = f"model {model.name!r} had {field}, and one of its links has none now"
            sink.report(STALE_CARRIER, message, model.location, found=field)
            model = model.copy(**{field: None})
        else:
            model = model.copy(links=tuple(_without(link, field, value) for link in model.links))
    return model.copy(links=tuple(without_annotation(link, _OWN) for link in model.links))


def _without(link: Link, field: str, value: bool) -> Link:
    own = find_annotation(link, _OWN)
    keeps = getattr(link, field) != value or (own is not None and field in (own.text or "").split())
    return link if keeps else link.copy(**{field: None})


def differing_rests(model: Model) -> Iterator[tuple[Model, str]]:
    """The nested models that may rest where the outermost one may not, or the other way round; with what to say."""
    rests = model.allow_auto_disable is not False
    for nested in model.models:
        value = nested.allow_auto_disable
        if value is not None and value != rests:
            said = f"nested model {nested.name!r} sets allow_auto_disable to {str(value).lower()}"
            yield nested, f"{said}, and {model.name!r} does not"
        yield from differing_rests(nested.copy(allow_auto_disable=model.allow_auto_disable))
