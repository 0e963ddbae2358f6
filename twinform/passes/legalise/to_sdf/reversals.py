"""Joints whose parent and child were exchanged for the tree of URDF, as SDF has them."""

from twinform.ir import Model
from twinform.passes.carriers.annotations import REVERSED, find_annotation, without_annotation
from twinform.passes.structure.reversal import REVERSIBLE, reroot_sdf


def without_reversals(model: Model) -> Model:
    """The model with the joints that an annotation calls reversed the right way round."""
    turned = [joint for joint in model.joints if find_annotation(joint, REVERSED) and joint.type in REVERSIBLE]
    if not turned:
        return model
    names = {joint.name for joint in turned}
    made = reroot_sdf(model, turned).joints  # a frame stays on its joint, whatever that moves
    joints = (without_annotation(joint, REVERSED) if joint.name in names else joint for joint in made)
    return model.copy(joints=tuple(joints))
