"""What holds a model to the world."""

from twinform.ir import Model
from twinform.ir.frames import WORLD


def without_world(model: Model) -> Model:
    """The model without what fixes it to the world: in URDF a root link `world` that is nothing else, and the joint."""
    held = [joint for joint in model.joints if joint.parent == WORLD]
    if not held or any(joint.type != "fixed" for joint in held) or len(held) > 1:
        return model
    joints = tuple(joint for joint in model.joints if joint is not held[0])
    links = tuple(link for link in model.links if link.name != WORLD)
    return model.model_copy(update={"joints": joints, "links": links})
