"""The half spheres of capsules, which URDF 1.0 lacks."""

from typing import ClassVar

from twinform.ir import Model, replace_fields
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.replaced_shapes import AnyPart, with_ends


class AddCapsuleEnds(ToUrdfPass):
    """Put a sphere at each end of a cylinder that a capsule became.

    Changes: visuals and collisions with such a cylinder; the spheres come behind it, with its material.
    Never touches: other cylinders.
    Diagnostics: none; `map-geometry` has accounted for the capsule.
    """

    name: ClassVar[str] = "add-capsule-ends"

    # Near the end: what all collisions of a link share is in <gazebo> by now, what only some have
    # is carried once, and the spheres are named after a name that Gazebo keeps.
    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with whole capsules."""

        def complete(parts: tuple[AnyPart, ...]) -> tuple[AnyPart, ...]:
            taken = {part.name for part in parts if part.name}
            return tuple(made for part in parts for made in with_ends(part, taken, annotated=keeper.carriers))

        links = (
            replace_fields(link, visuals=complete(link.visuals), collisions=complete(link.collisions))
            for link in model.links
        )
        return replace_fields(model, links=tuple(links))
