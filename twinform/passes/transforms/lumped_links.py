"""The links of URDF that Gazebo puts into others, because fixed joints hold them together."""

from twinform.ir import Element, Joint, Model
from twinform.ir.frames import WORLD
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
    above = lumped_joints(model)
    hosts: dict[str, str] = {}
    for link in model.links:
        way = {link.name: None}
        last = link.name
        # Hosts that are known are not walked again, so a chain of fixed links takes linear time.
        while last in above and last not in hosts:
            last = above[last].parent or ""
            if last in way:  # a circle, which Gazebo refuses
                break
            way[last] = None
        hosts |= dict.fromkeys(way, hosts.get(last, last))
    return hosts


def _keeps(element: Element) -> bool:
    return element.name in _KEEPS and value_text(element).lower() in TRUE
