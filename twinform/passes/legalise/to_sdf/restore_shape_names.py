"""Reverse conversion of the names that shapes of SDF had to take in URDF, and of those in contact sensors."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import LUMPED_NAME
from twinform.ir import Collision, Format, Link, Model, Visual, replace_fields
from twinform.passes.carriers.annotations import came_from, find_annotation, without_annotation
from twinform.passes.carriers.lumped_names import Followed, followed, mentions_collisions
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import NAME
from twinform.passes.structure.tag_shapes import seen_shapes

Shape = TypeVar("Shape", Visual, Collision)


class RestoreShapeNames(ModelPass):
    """Give visuals and collisions the names that they had in the SDF that the URDF was made of.

    Changes: 1. a name behind which an annotation stands becomes the one that the annotation gives; 2. contact sensors,
    which have the names of libsdformat, name the collisions by these.
    Never touches: names that were edited since; a model that did not come from SDF.
    Diagnostics: none; the ledger has `lumped-name` for each name in a sensor.
    """

    name: ClassVar[str] = "restore-shape-names"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model by the names of its source."""
        if not came_from(model, Format.SDF):
            return model
        restored = replace_fields(model, links=tuple(map(_restore_names, model.links)))
        return _rename_sensed(model, restored, sink) if mentions_collisions(model) else restored


def _restore_names(link: Link) -> Link:
    visuals, collisions = tuple(map(_restore_name, link.visuals)), tuple(map(_restore_name, link.collisions))
    return replace_fields(link, visuals=visuals, collisions=collisions)


def _restore_name(shape: Shape) -> Shape:
    found = find_annotation(shape, NAME)
    if found is None:
        return shape
    # The annotation counts while the synthesized name still stands; a name that was edited since is
    # the author's.
    name = found.text if found.get("instead_of") == shape.name else shape.name
    return without_annotation(shape, NAME).copy(name=name)


def _rename_sensed(before: Model, after: Model, sink: DiagnosticSink) -> Model:
    """The model with the own names of collisions in place of those that libsdformat gives them."""
    own = {
        id(old): Followed(new.name or "", one.name)
        for one, other in zip(before.links, after.links, strict=True)
        for old, new in zip(one.collisions, other.collisions, strict=True)
        if new.name
    }
    names = {seen.name: own[id(seen.shape)] for seen in seen_shapes(before, "collisions") if id(seen.shape) in own}
    for element in (one for each in before.extensions for part in each.content for one in part.walk()):
        text = (element.text or "").strip()
        if text in names:
            message = f"{text!r} is called {names[text].name!r} in SDF"
            sink.account(Fate.CARRIED, LUMPED_NAME, message, element.location.at("text()"), weight=0)
    extensions = tuple(
        extension.copy(content=tuple(followed(part, names, carriers=False) for part in extension.content))
        for extension in after.extensions
    )
    return after.copy(extensions=extensions)
