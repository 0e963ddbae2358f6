"""Names of shapes with which Gazebo applies the `<gazebo>` tags of their links, and contact sensors by these names."""

from typing import ClassVar

from twinform.diagnostics.rules import GAZEBO_SHAPE_NAME
from twinform.ir import Model
from twinform.passes.legalise.names import NAME
from twinform.passes.legalise.to_urdf.base import Keeper, ToUrdfPass
from twinform.passes.structure.tag_shapes import AnyShape, named_for_gazebo, renaming


class NameShapesForGazebo(ToUrdfPass):
    """Name shapes as `tag-shapes` does, so that Gazebo applies the `<gazebo>` tags of their link to them.

    Changes: 1. a shape that would miss tags of its link, or get those of another, has another name, and the old one is
    an annotation; 2. contact sensors name collisions as libsdformat calls them.
    Never touches: shapes that are tagged as they should be; a model that came from URDF, whose names are its author's.
    Diagnostics: in the ledger `gazebo-shape-name`.
    """

    name: ClassVar[str] = "name-shapes-for-gazebo"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model by names that Gazebo keeps."""

        def rename(shape: AnyShape, name: str, kind: str) -> AnyShape:
            keeper.account(GAZEBO_SHAPE_NAME, renaming(shape, name, kind), shape.location.at("@name"), 1)
            kept: AnyShape = keeper.annotate(shape, NAME, text=shape.name, attributes={"instead_of": name})
            return kept.copy(name=name)

        return model if keeper.back else named_for_gazebo(model, rename)
