"""The half spheres of capsules, which URDF 1.0 lacks."""

from collections.abc import Mapping
from typing import ClassVar

from twinform.ir import Link, Model, census_of, replace_fields
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.replaced_shapes import REPLACED, map_touched, with_ends


class AddCapsuleEnds(ToUrdfPass):
    """Put a sphere at each end of a cylinder that a capsule became.

    Changes: 1. visuals and collisions with such a cylinder; the spheres come behind it, with its material; 2. a contact
    sensor that names such a collision names the spheres too.
    Never touches: other cylinders.
    Diagnostics: none; `map-geometry` has accounted for the capsule.
    """

    name: ClassVar[str] = "add-capsule-ends"

    # Near the end: what all collisions of a link share is in <gazebo> by now, and what only some
    # have is carried once. Before `name-shapes-for-gazebo`, which counts all shapes.
    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with whole capsules."""
        if not census_of(model) & REPLACED:
            return model
        links: list[Link] = []
        ends: dict[str | None, Mapping[str, tuple[str, ...]]] = {}
        for link in model.links:
            visuals, _ = with_ends(link.visuals, annotated=keeper.carriers)
            collisions, ends[link.name] = with_ends(link.collisions, annotated=keeper.carriers)
            links.append(replace_fields(link, visuals=visuals, collisions=collisions))
        extensions = tuple(map_touched(each, ends.get(each.reference, {})) for each in model.extensions)
        return replace_fields(model, links=tuple(links), extensions=extensions)
