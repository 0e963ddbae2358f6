"""Names of shapes with which Gazebo applies the `<gazebo>` tags of their links, and contact sensors by these names."""

from collections.abc import Mapping
from typing import ClassVar

from twinform.diagnostics.rules.to_urdf import GAZEBO_SHAPE_NAME
from twinform.ir import Collision, Element, Link, Model, Visual
from twinform.passes.carriers.lumped_names import LUMP, mentions_collisions
from twinform.passes.legalise.names import NAME
from twinform.passes.legalise.to_urdf.base import Keeper, ToUrdfPass
from twinform.passes.structure.tagged_shapes import (
    KINDS,
    SeenShape,
    hosts_of,
    seen_shapes,
    shape_name,
    tagged_links,
    tagging,
)
from twinform.passes.transforms.nodes import unique_name

AnyShape = Visual | Collision


class NameShapesForGazebo(ToUrdfPass):
    """Name shapes so that Gazebo applies the `<gazebo>` tags of their link to them, and of no other one.

    libsdformat tells by the name of a shape, once it has lumped fixed joints, which links' tags it gets; one whose name
    does not begin with that of its link gets none.

    Changes: 1. a shape that would miss tags of its link, or get those of another, becomes `LINK_NAME`, and in a link
    that is lumped `LINK_collision_NAME`; its old name is an annotation; 2. contact sensors name collisions as
    libsdformat calls them.
    Never touches: shapes that are tagged as they should be; a model that came from URDF, whose names are its author's.
    Diagnostics: in the ledger `gazebo-shape-name`.
    """

    name: ClassVar[str] = "name-shapes-for-gazebo"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model by names that Gazebo keeps."""
        if keeper.back:
            return model
        before = model
        for field in KINDS:
            model = _named(model, field, keeper)
        return _sensing(before, model) if mentions_collisions(model) else model


def _named(model: Model, field: str, keeper: Keeper) -> Model:
    tagged = tagged_links(model, field)
    if not tagged:
        return model
    hosts = hosts_of(model)
    names = {
        id(seen.shape): name
        for seen in seen_shapes(model, field)
        if (name := _new_name(seen, KINDS[field], hosts, tagged)) is not None
    }
    return model.model_copy(update={"links": tuple(_renamed(link, field, names, keeper) for link in model.links)})


def _new_name(seen: SeenShape, kind: str, hosts: Mapping[str, str], tagged: set[str]) -> str | None:
    """The first name with which a shape gets the tags of its link alone; None where its own does, or no name would."""
    if _is_tagged_well(seen, kind, hosts, tagged):
        return None
    link, bare = seen.link, (seen.shape.name or kind).replace(LUMP, "_")
    candidates = (f"{link}_{bare}", f"{link}_{kind}_{bare}", f"{seen.host}{LUMP}{link}_{kind}_{bare}")
    for name in candidates:
        again = seen._replace(name=shape_name(seen.host, name, kind, 0))
        if _is_tagged_well(again, kind, hosts, tagged):
            return name
    return None


def _is_tagged_well(seen: SeenShape, kind: str, hosts: Mapping[str, str], tagged: set[str]) -> bool:
    return tagging(seen, kind, hosts) & tagged == {seen.link} & tagged


def _renamed(link: Link, field: str, names: Mapping[int, str], keeper: Keeper) -> Link:
    shapes: tuple[AnyShape, ...] = getattr(link, field)
    if not any(id(shape) in names for shape in shapes):
        return link
    taken = {shape.name for shape in shapes if id(shape) not in names}
    made: list[AnyShape] = []
    for shape in shapes:
        name = names.get(id(shape))
        made.append(shape if name is None else _with_name(shape, unique_name(name, taken), KINDS[field], keeper))
        taken.add(made[-1].name)
    return link.model_copy(update={field: tuple(made)})


def _with_name(shape: AnyShape, name: str, kind: str, keeper: Keeper) -> AnyShape:
    message = f"{kind} {shape.name!r} is called {name!r}, as Gazebo applies no tags of its link to it otherwise"
    keeper.account(GAZEBO_SHAPE_NAME, message, shape.location.at("@name"), 1)
    kept: AnyShape = keeper.annotate(shape, NAME, text=shape.name, attributes={"instead_of": name})
    return kept.model_copy(update={"name": name})


def _sensing(before: Model, after: Model) -> Model:
    """The model with the names of libsdformat in contact sensors, which had those of the collisions before."""
    own = {
        id(new): old.name
        for one, other in zip(before.links, after.links, strict=True)
        for old, new in zip(one.collisions, other.collisions, strict=True)
    }
    names: dict[str, dict[str, str]] = {}
    for seen in seen_shapes(after, "collisions"):
        names.setdefault(seen.link, {})[own[id(seen.shape)] or ""] = seen.name
    extensions = tuple(
        extension.model_copy(
            update={
                "content": tuple(
                    _in_contact(each, names.get(extension.reference or "", {})) for each in extension.content
                )
            }
        )
        for extension in after.extensions
    )
    return after.model_copy(update={"extensions": extensions})


def _in_contact(sensor: Element, names: Mapping[str, str]) -> Element:
    if sensor.name != "sensor":
        return sensor
    children = tuple(
        child.model_copy(update={"children": tuple(_collision(one, names) for one in child.children)})
        if child.name == "contact"
        else child
        for child in sensor.children
    )
    return sensor.model_copy(update={"children": children})


def _collision(element: Element, names: Mapping[str, str]) -> Element:
    name = names.get((element.text or "").strip()) if element.name == "collision" else None
    return element if name is None else element.model_copy(update={"text": name})
