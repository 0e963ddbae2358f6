"""The links of URDF that Gazebo puts into others, because fixed joints hold them together."""

from collections.abc import Iterable

from twinform.ir import Element, Joint, Model
from twinform.ir.frames import WORLD
from twinform.ir.groups import tops
from twinform.passes.transforms.gazebo_tags import TRUE, value_text

LUMPS_WITHOUT = "disableFixedJointLumping"
PRESERVES = "preserveFixedJoint"


def lumped_joints(model: Model) -> dict[str, Joint]:
    """The joints that go, by the names of the links that they hold (`parser_urdf.cc`, FixedJointShouldBeReduced).

    They are in the order of urdfdom, which keeps joints by their names.
    """
    kept = {block.reference for block in model.extensions if is_preserved(block.content)}
    links = {link.name for link in model.links}
    return {
        joint.child: joint
        for joint in sorted(model.joints, key=lambda joint: joint.name)
        if joint.type == "fixed" and joint.child in links and joint.parent in links
        if joint.parent != WORLD and joint.name not in kept
    }


def lumped_links(model: Model) -> dict[str, str]:
    """The link that each link goes into, itself where it stays."""
    above = {name: joint.parent or "" for name, joint in lumped_joints(model).items()}
    return tops((link.name for link in model.links), above)


def is_preserved(elements: Iterable[Element]) -> bool:
    """Whether the author asks for the fixed joint to stay, by a tag that libsdformat knows."""
    names = {LUMPS_WITHOUT, PRESERVES}
    return any(element.name in names and value_text(element).lower() in TRUE for element in elements)
