"""A name for every visual and collision."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Collision, Link, Model, Visual
from twinform.passes.legalise.model_pass import ModelPass

Shape = TypeVar("Shape", Visual, Collision)


class NameShapes(ModelPass):
    """Name what has no name, or the name of another one of its kind in the link.

    Changes: 1. those without a name, or with one made of blanks, become `LINK_visual` or `LINK_collision`, with `_1`,
    `_2`, ... from the second on; 2. a repeated name gets a number.
    Never touches: names that are there and differ.
    Diagnostics: none; a ledger entry under `shape-name` for each name that was changed.
    """

    name: ClassVar[str] = "name-shapes"

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model with named shapes."""
        links = tuple(_name_link(link, notes) for link in model.links)
        return model.model_copy(update={"links": links})


def _name_link(link: Link, notes: Notes) -> Link:
    visuals = name_all(link.visuals, f"{link.name}_visual", notes)
    collisions = name_all(link.collisions, f"{link.name}_collision", notes)
    if visuals is link.visuals and collisions is link.collisions:
        return link
    return link.model_copy(update={"visuals": visuals, "collisions": collisions})


def name_all(shapes: tuple[Shape, ...], base: str, notes: Notes) -> tuple[Shape, ...]:
    """The shapes with one name each; `base` names those that have none."""
    taken = {name for name in map(_own_name, shapes) if name}
    if len(taken) == len(shapes):
        return shapes
    seen: set[str] = set()
    named: list[Shape] = []
    for shape in shapes:
        name = _own_name(shape)
        if not name or name in seen:
            name = _free(name or base, taken | seen)
            if shape.name:
                message = f"{shape.name!r} {_why(shape)} is called {name!r} in SDF"
                notes.account(Fate.APPROXIMATED, to_sdf.SHAPE_NAME, message, shape.location)
        seen.add(name)
        named.append(shape if shape.name == name else shape.model_copy(update={"name": name}))
    return tuple(named)


def _own_name(shape: Visual | Collision) -> str:
    """The name that it has; empty where it has none, or one made of blanks."""
    return shape.name if shape.name and shape.name.strip() else ""


def _why(shape: Visual | Collision) -> str:
    return "is there twice; the second one" if _own_name(shape) else "is no name; it"


def _free(base: str, taken: set[str]) -> str:
    name, number = base, 1
    while name in taken:
        name, number = f"{base}_{number}", number + 1
    return name
