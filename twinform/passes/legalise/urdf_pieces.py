"""Carried URDF elements: what they refer to, and whether this still exists."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cached_property

from twinform.ir import Element, Joint, Link, Mimic, Model, Node, Opaque
from twinform.ir.foreign_joints import LOOP_FORMS, ends_of, usual_word
from twinform.ir.verify.verify_joints import useless_leader
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_FIELDS, LINK_TAGS, MODEL_TAGS
from twinform.request_options import UrdfVersion

_ABOUT_JOINTS = frozenset({"transmission", "ros2_control"})
OF_AN_AXIS = frozenset({"axis", "limit", "dynamics", "mimic"})
"""What a joint of URDF has once, and has about its axis."""
WITHOUT_AXIS = frozenset({"fixed", "floating", "planar"})
_ENDS = frozenset({"lower", "upper"})
_ENDLESS = frozenset({"continuous"})
BALLS = frozenset({"ball", "spherical"})
"""What dialects of URDF call the ball joint of SDF."""


def joints_of(element: Element) -> Iterator[str]:
    """The joints that an element at the level of the robot is about."""
    if element.name in _ABOUT_JOINTS:
        yield from (child.get("name") or "" for child in element.find_all("joint"))


class Standing:
    """What stands in a model by now, in the notation of a version of URDF, where what traveled is to come back."""

    def __init__(self, model: Model, urdf_version: UrdfVersion) -> None:
        self.model = model
        self.takes_any_limit = urdf_version == "1.2"

    @cached_property
    def links(self) -> Mapping[str, Link]:
        """The links by name."""
        return {link.name: link for link in self.model.links}

    @cached_property
    def joints(self) -> Mapping[str, Joint]:
        """The joints by name."""
        return {joint.name: joint for joint in self.model.joints}

    @cached_property
    def extensions(self) -> Mapping[str, frozenset[str]]:
        """The names of the elements in `<gazebo>`, by the reference of that."""
        found = defaultdict[str, set[str]](set)
        for extension in self.model.extensions:
            found[extension.reference or ""] |= {each.name for each in extension.content}
        return {reference: frozenset(names) for reference, names in found.items()}

    @cached_property
    def named_joints(self) -> frozenset[str]:
        """The names of the joints, of those in `<gazebo>` too."""
        inside = (each for one in self.model.extensions for each in one.content if each.name == "joint")
        return frozenset({*self.joints, *(each.get("name") or "" for each in inside)})


def misfit(piece: Opaque, node: Node, standing: Standing) -> str:
    """Why a piece cannot stand in a node of a model, or in the model, as that is by now; empty where it can."""
    if isinstance(node, Model):
        return _misfit_of_model(piece, standing)
    if isinstance(node, Link):
        return _misfit_of_link(piece)
    return _misfit_of_joint(piece, node, standing) if isinstance(node, Joint) else ""


def _misfit_of_link(piece: Opaque) -> str:
    """An inertial travels if it weighs nothing, where the link is a frame in SDF."""
    mass = piece.element.find("mass") if piece.element and piece.element.name == "inertial" else None
    written = (mass.get("value") if mass else None) or "0"
    return "" if is_zero(written) else f"a frame of SDF has no mass, and this one has {written}"


def is_zero(text: str) -> bool:
    """Whether a text is a number that is zero."""
    try:
        return float(text) == 0
    except ValueError:
        return False


def _misfit_of_joint(piece: Opaque, joint: Joint, standing: Standing) -> str:
    attribute = piece.attribute[0] if piece.attribute else ""
    if attribute == "type" and not piece.at and joint.type not in BALLS:
        return f"the joint is {joint.type} by now"
    has_limit = joint.axis is not None and joint.axis.limit is not None
    if piece.at == "limit" and not has_limit and not (standing.takes_any_limit and joint.type in _ENDLESS):
        return "the joint has no limits any more"
    if piece.at == "limit" and attribute in _ENDS and joint.type not in _ENDLESS:
        return f"the joint is {joint.type} and has limits of its own"
    if piece.element and not piece.at and piece.element.name == "mimic" and joint.type not in WITHOUT_AXIS:
        return _misfit_of_mimic(piece.element, joint, standing)
    if piece.element and not piece.at and piece.element.name in OF_AN_AXIS and joint.type not in WITHOUT_AXIS:
        return f"the joint is {joint.type} and has that type itself"
    return ""


def _misfit_of_mimic(element: Element, joint: Joint, standing: Standing) -> str:
    """A mimic travels where nothing moves by it."""
    if joint.axis is not None and joint.axis.mimic is not None:
        return "the joint mimics another one"
    leader = element.get("joint")
    if useless_leader(joint, Mimic.unchecked(joint=leader), standing.joints):
        return ""
    return f"joint {leader!r} has an axis by now, and this joint has moved without it"


def _would_act(element: Element, reference: str, standing: Standing) -> bool:
    """Whether an element of `<gazebo>`, which traveled because it set nothing, would set something by now."""
    link, joint = standing.links.get(reference), standing.joints.get(reference)
    # what comes back stands behind what is there, and of several such tags the last one counts
    if link is not None and _would_act_on_shapes(element, link):
        return True
    if reference and link is None:
        moves = joint is not None and joint.type not in {"fixed", "floating"}  # in SDF, others may be no joints at all
        tag = JOINT_TAGS.get(element.name)
        return moves and element.name not in LINK_TAGS | MODEL_TAGS and not (tag and tag.target == "ignored")
    if not standing.extensions.get(reference, frozenset()).isdisjoint({element.name, LINK_FIELDS.get(element.name)}):
        return False
    if link is not None:
        return _would_act_on_flags(element, link)
    return element.name not in LINK_TAGS | JOINT_TAGS


def _would_act_on_flags(element: Element, link: Link) -> bool:
    """Whether a flag, which traveled as a second one or as that of a frame, would set one of a body."""
    is_flag = element.name in {*LINK_FIELDS, *LINK_FIELDS.values()}
    return is_flag and link.inertial is not None and bool(link.inertial.mass)


def _would_act_on_shapes(element: Element, link: Link) -> bool:
    """Whether a tag about shapes, which traveled because there were none, would change those of a link."""
    tag = LINK_TAGS.get(element.name)
    about_collisions = element.name == "collision" or (tag is not None and tag.target in {"surface", "collision"})
    about_visuals = element.name == "visual" or (tag is not None and tag.target == "visual")
    return (about_collisions and bool(link.collisions)) or (about_visuals and bool(link.visuals))


def _misfit_of_model(piece: Opaque, standing: Standing) -> str:
    """What an element at the level of the robot names and what is gone."""
    element = piece.element
    if element is None:
        return ""
    if element.name == "link":
        return "the robot has no such link any more"
    if element.name == "material":
        return "it has nothing that URDF understands"
    if element.name == "gazebo":
        return _misfit_of_gazebo(element, standing)
    if element.name == "joint" or usual_word(element) in LOOP_FORMS:
        lost = next((name for name in ends_of(element) if name and name not in standing.links), None)
        return f"there is no link {lost!r}" if lost else ""
    gone = next((name for name in joints_of(element) if name not in standing.named_joints), None)
    return "" if gone is None else f"there is no joint {gone!r}"


def _misfit_of_gazebo(element: Element, standing: Standing) -> str:
    reference = element.get("reference") or ""
    if reference and reference not in standing.named_joints and reference not in standing.links:
        return f"there is no link or joint {reference!r}"
    acting = next((each.name for each in element.children if _would_act(each, reference, standing)), None)
    return (
        f"<{acting}> set nothing in {repr(reference) if reference else 'the model'}, and would by now" if acting else ""
    )
