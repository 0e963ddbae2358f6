"""Reverse conversion of shapes and masses: removing names and values that the conversion to SDF added."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Collision, Format, Inertial, Link, Model, Visual, replace_fields
from twinform.passes.carriers.annotations import came_from, find_annotation, without_annotation
from twinform.passes.carriers.old_names import NAME
from twinform.passes.carriers.token_mass import moments, restore_inertial, says_zero
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.shape_names import UNNAMED

Shape = TypeVar("Shape", Visual, Collision)


class RestoreShapes(ModelPass):
    """Leave out the names and the inertias that a conversion to SDF synthesized, in a model that came from URDF.

    Changes: 1. a visual or collision whose name an annotation lists has none, and one whose name was taken has it
    again; 2. an inertial of no mass goes, as URDF means that by saying nothing; 3. a token of mass and inertia goes
    too; 4. in any model, a mass that MJCF says is zero is zero.
    Never touches: names that were edited since; else, models that did not come from URDF.
    Diagnostics: none.
    """

    name: ClassVar[str] = "restore-shapes"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without what was synthesized."""
        if not came_from(model, Format.URDF):
            return replace_fields(model, links=tuple(map(_with_zeros, model.links)))
        found = find_annotation(model, UNNAMED)
        made = frozenset(line.strip() for line in (found.text or "").splitlines()) if found else frozenset[str]()
        links = tuple(_restore_link(link, made) for link in model.links)
        return without_annotation(model.copy(links=links), UNNAMED)


def _with_zeros(link: Link) -> Link:
    is_told = link.inertial is not None and says_zero(link.inertial)
    return link.copy(inertial=restore_inertial(link.inertial)) if is_told and link.inertial else link


def _restore_link(link: Link, made: frozenset[str]) -> Link:
    update: dict[str, object] = {}
    for field in ("visuals", "collisions"):
        shapes = getattr(link, field)
        usual = f"{link.name}_{field[:-1]}"
        update[field] = tuple(_restore_name(shape, made, usual) for shape in shapes)
    if link.inertial is not None:
        inertial = restore_inertial(link.inertial)
        update["inertial"] = None if _is_nothing(inertial) and not says_zero(link.inertial) else inertial
    return replace_fields(link, **update)


def _restore_name(shape: Shape, made: frozenset[str], usual: str) -> Shape:
    if shape.name in made and shape.name.startswith(usual):  # it is not in another link by now
        return shape.copy(name=None)
    found = find_annotation(shape, NAME)
    if found is None:
        return shape
    shape = without_annotation(shape, NAME)
    return shape.copy(name=found.text or "") if found.get("instead_of") == shape.name else shape


def _is_nothing(inertial: Inertial) -> bool:
    """Whether an inertial has zero mass, zero inertia and nothing else."""
    return not inertial.mass and not any(moments(inertial)) and inertial.pose is None and not inertial.opaque
