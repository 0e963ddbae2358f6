"""The links of URDF that Gazebo puts into others, because fixed joints hold them together."""

from twinform.ir import Element, Joint, Model
from twinform.ir.frames import WORLD
from twinform.ir.groups import tops
from twinform.passes.transforms.gazebo_tags import TRUE, value_text

_KEEPS = frozenset({"preserveFixedJoint", "disableFixedJointLumping"})


def lumped_joints(model: Model) -> dict[str, Joint]:
    """The joints that go, by the names of the links that they hold (`parser_urdf.cc`, FixedJointShouldBeReduced)."""
    kept = {block.reference for block in model.extensions if any(map(_keeps, block.content))}
    return {
        joint.child or "": joint
        for joint in model.joints
        if joint.type == "fixed" and joint.parent != WORLD and joint.name not in kept
    }


def lumped_links(model: Model) -> dict[str, str]:
    """The link that each link goes into, itself where it stays."""
    above = {name: joint.parent or "" for name, joint in lumped_joints(model).items()}
    return tops((link.name for link in model.links), above)


def _keeps(element: Element) -> bool:
    return element.name in _KEEPS and value_text(element).lower() in TRUE
