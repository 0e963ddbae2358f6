"""Names of visuals and collisions: one for each in SDF, by which Gazebo tags them in URDF, and both ways back."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from itertools import count
from typing import ClassVar, NamedTuple, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.diagnostics.rules import GAZEBO_SHAPE_NAME, LUMPED_NAME
from twinform.ir import Collision, Format, Link, Model, Visual, replace_fields
from twinform.passes.carriers.annotations import came_from, find_annotation, with_annotation, without_annotation
from twinform.passes.carriers.carriers import Keeper
from twinform.passes.carriers.lumped_names import Followed, followed, mentions_collisions
from twinform.passes.carriers.old_names import NAME
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.replaced_shapes import CAPSULE_END
from twinform.passes.structure.tag_shapes import AnyShape, describe_renaming, name_shapes_for_gazebo, seen_shapes

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


class NameShapesForGazebo(ToUrdfPass):
    """Name shapes as `tag-shapes` does, so that Gazebo applies the `<gazebo>` tags of their link to them.

    Changes: 1. a shape that would miss tags of its link, or get those of another, has another name, and the old one is
    an annotation; 2. contact sensors name collisions as libsdformat calls them.
    Never touches: shapes that are tagged as they should be; a model that came from URDF, whose names are its author's.
    Diagnostics: in the ledger `gazebo-shape-name`, also for each name in a sensor.
    """

    name: ClassVar[str] = "name-shapes-for-gazebo"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model by names that Gazebo keeps."""

        def rename(shape: AnyShape, name: str, kind: str) -> AnyShape:
            if find_annotation(shape, CAPSULE_END) is not None:  # which SDF does not have
                return with_annotation(without_annotation(shape, CAPSULE_END), CAPSULE_END, name).copy(name=name)
            keeper.account(GAZEBO_SHAPE_NAME, describe_renaming(shape, name, kind), shape.location.at("@name"), 1)
            kept: AnyShape = keeper.annotate(shape, NAME, text=shape.name, attributes={"instead_of": name})
            return kept.copy(name=name)

        if keeper.back:
            return model
        # parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision: libsdformat calls a shape
        # whose name does not begin with that of its link `LINK_fixed_joint_lump__NAME_collision`,
        # and takes that for a shape of another link, which gets no tag of this one. Leaving out the
        # names of all shapes would work too, but would cost every other reader names that nobody
        # had a problem with.
        named = name_shapes_for_gazebo(model, rename)
        for old, new in zip(_sensed_collisions(model), _sensed_collisions(named), strict=True):
            if old != new:
                message = f"libsdformat calls collision {old.collision!r} {new.collision!r}, and so does the sensor"
                keeper.account(GAZEBO_SHAPE_NAME, message, old.location, 0)
        return named


class _Sensed(NamedTuple):
    """The name of a collision in a contact sensor, and where that stands."""

    collision: str
    location: Location


def _sensed_collisions(model: Model) -> Iterator[_Sensed]:
    for extension in model.extensions:
        for sensor in (each for each in extension.content if each.name == "sensor"):
            where = extension.location.at(f"sensor[@name='{sensor.get('name')}']/contact/collision")
            for contact in sensor.find_all("contact"):
                yield from (_Sensed(each.text or "", where) for each in contact.find_all("collision"))
