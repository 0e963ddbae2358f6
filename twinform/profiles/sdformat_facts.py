"""Facts about names and `<gazebo>` extensions that libsdformat changes, refuses or drops when it reads URDF."""

import re
from collections.abc import Iterator

from twinform.lazy import lazy_pattern
from twinform.profiles.forms import number_in
from twinform.profiles.nodes import Fact, FactTable, RawNode

_TRUE = frozenset({"true", "yes", "1"})
_LUMPING = frozenset({"disableFixedJointLumping", "preserveFixedJoint"})
_NUMBERS = frozenset(
    {"dampingFactor", "fudgeFactor", "kd", "kp", "laserRetro", "maxVel", "minDepth", "mu1", "mu2"}
    | {"springReference", "springStiffness", "stopCfm", "stopErp"}
)
_WHOLE = frozenset({"maxContacts"})
_WORDS = frozenset(
    {"cfmDamping", "fdir1", "implicitSpringDamper", "material", "provideFeedback", "selfCollide", "static"}
)
_READ = _NUMBERS | _WHOLE | _WORDS | _LUMPING | {"turnGravityOff"}
_NUMBER = lazy_pattern(r"\s*[-+]?(?:0[xX](?:[0-9a-fA-F]|\.[0-9a-fA-F])|\d|\.\d|inf|nan)", re.ASCII | re.IGNORECASE)
"""The beginning of a number."""
# std::stod throws below the smallest normal double, and of that Values2str writes too few digits for Param.cc.
_LEAST = 2.3e-308
_INTEGER = lazy_pattern(r"\s*[-+]?\d{1,9}", re.ASCII)
_DECIMAL = lazy_pattern(r"\s*[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?", re.ASCII)


def preserved_joints(root: RawNode) -> frozenset[str]:
    """The names of fixed joints that extensions protect from lumping."""
    return frozenset(
        reference
        for gazebo, setting in _find_settings(root, _LUMPING)
        if (reference := gazebo.attributes.get("reference")) is not None and _setting_text(setting).lower() in _TRUE
    )


def is_static(root: RawNode) -> bool:
    """Whether the model is static: only the last extension without a reference decides."""
    found = [gazebo for gazebo in root.all("gazebo") if not gazebo.attributes.get("reference")]
    statics = list(found[-1].all("static")) if found else []
    return bool(statics) and _setting_text(statics[-1]).lower() in _TRUE


def foreign_ends(root: RawNode, links: frozenset[str]) -> Fact:
    """Joints in extensions with an end that is not one of these links."""
    for gazebo in root.all("gazebo"):
        if "reference" in gazebo.attributes:
            continue
        known = links | {"world"} | {each.name for each in gazebo.children}
        for end in (end for joint in gazebo.all("joint") for tag in ("parent", "child") for end in joint.all(tag)):
            if (name := end.text.strip()) and "::" not in name and name not in known:
                yield end, f"the <{end.tag}> of a joint in an extension is {name!r}, but no link of that name is left"


def _unread_extensions(root: RawNode) -> Fact:
    for _, node in _find_settings(root, _NUMBERS):
        if not _begins_with_number(_setting_text(node)):
            yield node, f"<{node.tag}> is {_setting_text(node)!r}"
    for _, node in _find_settings(root, _WHOLE):
        if not _INTEGER.match(_setting_text(node)):
            yield node, f"<{node.tag}> is {_setting_text(node)!r}"


def _unset_extensions(root: RawNode) -> Fact:
    for _, node in _find_settings(root, _READ):
        if _is_unset(node):
            yield node, f"<{node.tag}> does not begin with its text"


def _find_settings(root: RawNode, tags: frozenset[str]) -> Iterator[tuple[RawNode, RawNode]]:
    """The extensions and their elements with one of these tags."""
    return ((gazebo, each) for gazebo in root.all("gazebo") for each in gazebo.children if each.tag in tags)


def _setting_text(node: RawNode) -> str:
    return node.attributes.get("value", "" if _is_unset(node) else node.text).strip()


def _is_unset(node: RawNode) -> bool:
    """Whether a comment or an element stands where libsdformat looks for the text."""
    is_first = node.begins_with_comment or (bool(node.children) and not node.text.strip())
    return is_first and "value" not in node.attributes


def _begins_with_number(text: str) -> bool:
    """Whether a text begins with a number that fits into a double."""
    if not _NUMBER.match(text):
        return False
    plain = _DECIMAL.match(text)
    if plain is None or "x" in text[:3].lower():
        return True
    number = float(plain[0])
    if number == 0:
        return not re.search(r"[1-9]", plain[0].lower().split("e")[0])
    return _LEAST <= abs(number) != float("inf")


def _reserved_names(root: RawNode) -> Fact:
    """Names that SDF reserves."""
    moving = (joint for joint in root.all("joint") if joint.type != "fixed")
    for node in (root, *_kept_links(root), *moving):
        if _is_reserved(node.name):
            yield node, f"<{node.tag}> has the name {node.name!r}"


def _shared_names(root: RawNode) -> Fact:
    """Moving joints that have the name of a link."""
    links = {node.name for node in _kept_links(root)}
    for joint in root.all("joint"):
        if joint.type != "fixed" and joint.name in links:
            yield joint, f"joint {joint.name!r} has the name of a link"


def _kept_links(root: RawNode) -> Iterator[RawNode]:
    """Links that libsdformat neither lumps into others nor takes for the world."""
    joints = {joint.value("child", "link") or "": joint for joint in root.all("joint")}
    for link in root.all("link"):
        joint = joints.get(link.name)
        if joint is None:
            if link.name != "world":
                yield link
        elif joint.type != "fixed" or joint.value("parent", "link") == "world":
            yield link


def _is_reserved(name: str) -> bool:
    return name == "world" or (len(name) >= 4 and name.startswith("__") and name.endswith("__"))


def _placeless_links(root: RawNode) -> Fact:
    """Joints that libsdformat drops although links are posed relative to them; a frame may have such a name."""
    blocks = (block for block in root.all("gazebo") if not block.attributes.get("reference"))
    frames = {frame.name for block in blocks for frame in block.all("frame")}
    for joint in root.all("joint"):
        type_ = joint.type
        if type_ in {"floating", "planar"} and joint.name not in frames:
            yield joint, f"joint {joint.name!r} is {type_}, and no <frame> in <gazebo> has its name"


def _weighing_world(root: RawNode) -> Fact:
    for link in root.all("link"):
        if link.name == "world" and link.first("inertial") is not None:
            yield link, "link 'world' has an <inertial>"


def _swapped_limits(root: RawNode) -> Fact:
    """Limits whose lower end is above the upper one; an end that is not written is zero."""
    for joint in root.all("joint"):
        limit = joint.first("limit")
        if limit is not None and joint.type in {"revolute", "prismatic"}:
            lower, upper = (number_in(limit.attributes.get(end, "")) or 0.0 for end in ("lower", "upper"))
            if lower > upper:
                yield limit, f"the limits of joint {joint.name!r} are {lower:g} and {upper:g}"


def _empty_names(root: RawNode) -> Fact:
    for link in root.all("link"):
        for shape in (*link.all("visual"), *link.all("collision")):
            if shape.attributes.get("name") == "":
                yield shape, f"a <{shape.tag}> of link {link.name!r} has an empty name"


def _forked_world(root: RawNode) -> Fact:
    """A root link called world that carries several others."""
    ends = [(joint.value("parent", "link"), joint.value("child", "link")) for joint in root.all("joint")]
    carried = sum(parent == "world" for parent, _ in ends)
    link = next((link for link in root.all("link") if link.name == "world"), None)
    if link is not None and carried > 1 and "world" not in (child for _, child in ends):
        yield link, f"the link 'world' carries {carried} links"


FACTS: FactTable = {
    "unread-extension": _unread_extensions,
    "unset-extension": _unset_extensions,
    "reserved-name": _reserved_names,
    "swapped-limits": _swapped_limits,
    "empty-name": _empty_names,
    "shared-name": _shared_names,
    "weighing-world": _weighing_world,
    "forked-world": _forked_world,
    "placeless-link": _placeless_links,
}
