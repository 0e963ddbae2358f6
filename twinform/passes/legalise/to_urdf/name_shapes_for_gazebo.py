"""Names of shapes with which Gazebo applies the `<gazebo>` tags of their links, and contact sensors by these names."""

from collections.abc import Iterator
from typing import ClassVar, NamedTuple

from twinform.diagnostics import Location
from twinform.diagnostics.rules import GAZEBO_SHAPE_NAME
from twinform.ir import Model
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.passes.legalise.changed_names import NAME
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.replaced_shapes import CAPSULE_END
from twinform.passes.structure.tag_shapes import AnyShape, describe_renaming, name_shapes_for_gazebo


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
