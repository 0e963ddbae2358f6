"""Special `<gazebo>` tags: their fields in SDF, and how libsdformat reads their values.

Everything else in such an element is SDF as it stands. The meanings are those of libsdformat's URDF reader.
"""

from collections.abc import Callable, Iterator
from typing import Literal, NamedTuple

from twinform.ir import Element, Link
from twinform.schemas import parse_value


class Tag(NamedTuple):
    """Where a tag's value goes: into a field of what `target` names, after `read`."""

    target: Literal["surface", "collision", "visual", "link", "model", "dynamics", "physics", "ignored"]
    field: str
    read: Callable[[str], object]


def value_text(element: Element) -> str:
    """The value of a tag, which may be written as an attribute or as text."""
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
    """turnGravityOff: only these values leave gravity on."""
    # The tag is the opposite of the element: `turnGravityOff` true is <gravity> false. libsdformat
    # compares with the words for false here, so any other text turns gravity off.
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
"""The fields of a link that a tag sets, with the tag: URDF has no other place for them."""

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
"""Fixed joints are never lumped here, so the two tags that prevent it have nothing to do."""

MODEL_TAGS = {"static": Tag("model", "static", _truth)}

TRUTHS = frozenset({_truth, _gravity})
"""The readers of values that mean true or false."""

FLAGS = {"gravity": ("turnGravityOff", False), "self_collide": ("selfCollide", True)}
"""Fields of a link with a tag of their own, and the value that the tag calls true."""


def flag_tags(link: Link) -> Iterator[Element]:
    """Gravity and self-collision of a link, as tags."""
    for field, (tag, same) in FLAGS.items():
        value = getattr(link, field)
        if value is not None:
            yield Element.unchecked(name=tag, text="true" if value is same else "false")


# libsdformat writes this URI beside the name, whatever the material is called.
SCRIPT_URI = "file://media/materials/scripts/gazebo.material"
"""Where Gazebo Classic keeps the materials that `<material>` names."""
