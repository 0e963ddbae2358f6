"""Put a prefix before the names of a model."""

from typing import ClassVar

from pydantic import Field

from twinform.ir import Model, World
from twinform.passes.structure.model_edit import EditContext, ModelEdit
from twinform.passes.structure.rename_parts import Part, rename_in_world, rename_model, report_clashes, scope_of


class PrefixNames(ModelEdit):
    """Put a prefix before the name of every link, joint and frame, so that two robots fit into one scene.

    Changes: 1. the names of links, joints, frames and nested models of the model; what is in a nested model keeps its
    names, which are looked up in that model; 2. all that names them: joints, mimics, poses, frames, axes, `<gazebo>`,
    transmissions, ros2_control, parameters of plugins, other tools' elements; 3. with `again` false, names that begin
    with the prefix already stay, so that the pass may run twice.
    Never touches: the name of the model, `world`, names of sensors, shapes, materials, plugins and topics.
    Diagnostics: `name-clash`; `unfollowed-name` for a text that may or may not mean a part that was renamed.
    """

    name: ClassVar[str] = "prefix-names"
    example: ClassVar[str] = "prefix-names{prefix=left_}"

    prefix: str = Field(min_length=1, description="What to put before the names.")
    again: bool = Field(default=False, description="Also before names that begin with it already.")

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with prefixed names."""
        scope = scope_of(model, self.new_name, deep=False)
        if not scope.changes or report_clashes(model, scope, place.format, place.sink):
            return model
        return rename_model(model, scope, place.format, place.sink)

    def update_world(self, before: World, after: World) -> World:
        """The world, whose joints and frames follow the new names."""
        return rename_in_world(before, after, lambda model: scope_of(model, self.new_name, deep=False), self.model)

    def new_name(self, part: Part, name: str) -> str:
        """Return the name that a part has afterwards."""
        del part
        return name if name.startswith(self.prefix) and not self.again else self.prefix + name
