"""Naming unnamed visuals and collisions."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from itertools import count
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Collision, Link, Model, Visual, replace_fields
from twinform.passes.carriers.annotations import with_annotation
from twinform.passes.carriers.carriers import Keeper
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import NAME

Shape = TypeVar("Shape", Visual, Collision)

UNNAMED = "unnamed"
"""The annotation on a model of SDF that lists, line by line, the names of shapes that have none in URDF."""


class NameShapes(ModelPass):
    """Name what has no name, or the name of another one of its kind in the link.

    Changes: 1. those without a name, or with one made of blanks, become `LINK_visual` or `LINK_collision`, with `_1`,
    `_2`, ... from the second on; 2. a repeated name gets a number.
    Never touches: names that are there and differ.
    Diagnostics: none; a ledger entry under `shape-name` for each name that was changed.
    """

    name: ClassVar[str] = "name-shapes"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with named shapes."""
        links = tuple(_name_link(link, sink, carriers=self.carriers) for link in model.links)
        made = [new for old, link in zip(model.links, links, strict=True) for new in _made_names(old, link)]
        model = model.copy(links=links)
        return with_annotation(model, UNNAMED, "\n".join(made)) if made and self.carriers else model


def _name_link(link: Link, sink: DiagnosticSink, *, carriers: bool) -> Link:
    visuals = name_all(link.visuals, f"{link.name}_visual", sink, carriers=carriers)
    collisions = name_all(link.collisions, f"{link.name}_collision", sink, carriers=carriers)
    return replace_fields(link, visuals=visuals, collisions=collisions)


def _made_names(old: Link, new: Link) -> Iterator[str]:
    """The names of shapes that had none."""
    if new is not old:
        pairs = zip((*old.visuals, *old.collisions), (*new.visuals, *new.collisions), strict=True)
        yield from (str(after.name) for before, after in pairs if before.name is None)


def name_all(shapes: tuple[Shape, ...], base: str, sink: DiagnosticSink, *, carriers: bool) -> tuple[Shape, ...]:
    """The shapes with one name each; `base` names those that have none."""
    taken = {name for name in map(_own_name, shapes) if name}
    if len(taken) == len(shapes):
        return shapes
    seen: set[str] = set()
    numbers: defaultdict[str, count[int]] = defaultdict(lambda: count(1))
    named: list[Shape] = []
    for shape in shapes:
        name = _own_name(shape)
        if not name or name in seen:
            name = _free_name(name or base, taken, seen, numbers)
            if shape.name:
                message = f"{shape.name!r} {_fault_of(shape)} is called {name!r} in SDF"
                Keeper(sink, carriers).account(rules.SHAPE_NAME, message, shape.location)
                if carriers:
                    shape = with_annotation(shape, NAME, shape.name, {"instead_of": name})  # noqa: PLW2901 - the same shape
        seen.add(name)
        named.append(shape if shape.name == name else shape.copy(name=name))
    return tuple(named)


def _own_name(shape: Visual | Collision) -> str:
    """The name of a shape; empty where it has none, or one made of blanks."""
    return shape.name if shape.name and shape.name.strip() else ""


def _fault_of(shape: Visual | Collision) -> str:
    return "is used twice; the second one" if _own_name(shape) else "is not a valid name; it"


def _free_name(base: str, taken: set[str], seen: set[str], numbers: Mapping[str, "count[int]"]) -> str:
    """The base, or the base with the next number that makes it unique; `numbers` remembers the last number tried."""
    name = base
    while name in taken or name in seen:
        # A counter for each base: starting at 1 every time takes quadratic time with thousands of
        # unnamed shapes in a link.
        name = f"{base}_{next(numbers[base])}"
    return name
