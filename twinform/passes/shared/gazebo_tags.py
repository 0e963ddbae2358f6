"""Special `<gazebo>` tags: their fields in SDF, how libsdformat reads their values, and the joints that it lumps.

All other content of `<gazebo>` is SDF as it stands. The meanings are those of `parser_urdf.cc` in libsdformat.
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Literal, NamedTuple

from twinform.ir import Element, Joint, Link, Model
from twinform.ir.frames import WORLD
from twinform.ir.groups import tops
from twinform.schemas import parse_value

LUMPS_WITHOUT = "disableFixedJointLumping"
PRESERVES = "preserveFixedJoint"


class Tag(NamedTuple):
    """The destination of a tag: the field of `target` that takes its value, as `read` parses it."""

    target: Literal["surface", "collision", "visual", "link", "model", "dynamics", "physics", "ignored"]
    field: str
    read: Callable[[str], object]


def value_text(element: Element) -> str:
    """The value of a tag, from its attribute `value` or its text."""
    # As libsdformat (GetKeyValueAsString): the attribute counts before the text.
    value = element.get("value")
    return (value if value is not None else element.text or "").strip()


def _number(text: str) -> object:
    return parse_value("double", text)


def _vector(text: str) -> object:
    return parse_value("vector3", text)


def _count(text: str) -> object:
    return parse_value("int", text)


# Of flags in <gazebo>, libsdformat takes these for true and all other texts for false. Booleans of
# SDF itself are `true` and `1`.
TRUE = frozenset({"true", "yes", "1"})
FALSE = frozenset({"false", "no", "0"})


def _truth(text: str) -> bool:
    return text.lower() in TRUE


def _gravity(text: str) -> bool:
    """The field `gravity` for a value of `turnGravityOff`."""
    # `turnGravityOff` true is <gravity> false. libsdformat compares with the words for false here,
    # so any other text turns gravity off.
    return text.lower() in FALSE


LINK_TAGS = {
    "mu1": Tag("surface", "mu", _number),
    "mu2": Tag("surface", "mu2", _number),
    "fdir1": Tag("surface", "fdir1", _vector),
    "kp": Tag("surface", "kp", _number),
    "kd": Tag("surface", "kd", _number),
    "maxVel": Tag("surface", "max_vel", _number),
    "minDepth": Tag("surface", "min_depth", _number),
    "maxContacts": Tag("collision", "max_contacts", _count),
    "laserRetro": Tag("collision", "laser_retro", _number),
    "material": Tag("visual", "script", str),
    "turnGravityOff": Tag("link", "gravity", _gravity),
    "selfCollide": Tag("link", "self_collide", _truth),
    "dampingFactor": Tag("link", "velocity_decay", _number),
    "canonicalBody": Tag("ignored", "", str),
}
LINK_FIELDS = {tag.field: name for name, tag in LINK_TAGS.items() if tag.target == "link"}
"""The tag of each link field that URDF can only express as a tag."""
JOINT_TAGS = {
    "springReference": Tag("dynamics", "spring_reference", _number),
    "springStiffness": Tag("dynamics", "spring_stiffness", _number),
    "stopCfm": Tag("physics", "ode/limit/cfm", _number),
    "stopErp": Tag("physics", "ode/limit/erp", _number),
    "fudgeFactor": Tag("physics", "ode/fudge_factor", _number),
    "provideFeedback": Tag("physics", "provide_feedback", _truth),
    "implicitSpringDamper": Tag("physics", "ode/implicit_spring_damper", _truth),
    "cfmDamping": Tag("physics", "ode/implicit_spring_damper", _truth),
    "preserveFixedJoint": Tag("ignored", "", str),
    "disableFixedJointLumping": Tag("ignored", "", str),
}
"""The tags of joints. Fixed joints are never lumped here, so the two tags that prevent it are ignored."""
NUMBER_TAGS = frozenset(name for name, tag in (LINK_TAGS | JOINT_TAGS).items() if tag.read in {_number, _vector})
"""The tags whose values are numbers or vectors."""
MODEL_TAGS = {"static": Tag("model", "static", _truth)}
TRUTHS = frozenset({_truth, _gravity})
"""The functions that read a value as true or false."""
FLAGS = {"gravity": ("turnGravityOff", False), "self_collide": ("selfCollide", True)}
"""The tag of each flag of a link, and the value of the field that the tag calls true."""


def flag_tags(link: Link) -> Iterator[Element]:
    """Gravity and self-collision of a link, as tags."""
    for field, (tag, same) in FLAGS.items():
        value = getattr(link, field)
        if value is not None:
            yield Element.unchecked(name=tag, text="true" if value is same else "false")


# libsdformat writes this URI beside the name, whatever the material is called.
SCRIPT_URI = "file://media/materials/scripts/gazebo.material"
"""The file of Gazebo Classic with the materials that `<material>` names."""


def lumped_joints(model: Model) -> dict[str, Joint]:
    """The fixed joints that libsdformat lumps, by child link (`parser_urdf.cc`, FixedJointShouldBeReduced).

    They are sorted by name, as urdfdom stores joints.
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
    """The link that each link is lumped into; a link that stays maps to itself."""
    above = {name: joint.parent or "" for name, joint in lumped_joints(model).items()}
    return tops((link.name for link in model.links), above)


def is_preserved(elements: Iterable[Element]) -> bool:
    """Whether a tag in `<gazebo>` asks libsdformat to keep the fixed joint."""
    names = {LUMPS_WITHOUT, PRESERVES}
    return any(element.name in names and value_text(element).lower() in TRUE for element in elements)
