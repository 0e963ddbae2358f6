"""Facts about `<gazebo>`, the extensions of URDF, as the converter of libsdformat reads them."""

import re
from collections.abc import Callable, Iterator, Mapping

from twinform.profiles.reading.nodes import RawNode

Fact = Iterator[tuple[RawNode, str]]
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
_NUMBER = re.compile(r"\s*[-+]?(?:0[xX](?:[0-9a-fA-F]|\.[0-9a-fA-F])|\d|\.\d|inf|nan)", re.ASCII | re.IGNORECASE)
"""How a number begins."""
_INTEGER = re.compile(r"\s*[-+]?\d{1,9}", re.ASCII)
_LARGE = re.compile(r"\s*[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?", re.ASCII)


def fixed_joints(root: RawNode) -> frozenset[str]:
    """The fixed joints that stay, because an extension says so."""
    return frozenset(
        reference
        for gazebo, setting in _settings(root, _LUMPING)
        if (reference := gazebo.attributes.get("reference")) is not None and _text(setting).lower() in _TRUE
    )


def is_static(root: RawNode) -> bool:
    """Whether the model does not move: the last extension without a reference decides, also by its silence."""
    found = [gazebo for gazebo in root.all("gazebo") if "reference" not in gazebo.attributes]
    statics = list(found[-1].all("static")) if found else []
    return bool(statics) and _text(statics[-1]).lower() in _TRUE


def foreign_ends(root: RawNode, links: frozenset[str]) -> Fact:
    """Joints in extensions that end at a link which is not among these."""
    for gazebo in root.all("gazebo"):
        if "reference" in gazebo.attributes:
            continue
        known = links | {"world"} | {each.attributes.get("name", "") for each in gazebo.children}
        for end in (end for joint in gazebo.all("joint") for tag in ("parent", "child") for end in joint.all(tag)):
            if (name := end.text.strip()) and "::" not in name and name not in known:
                yield end, f"the <{end.tag}> of a joint in an extension is {name!r}, but no link of that name is left"


def _settings(root: RawNode, tags: frozenset[str]) -> Iterator[tuple[RawNode, RawNode]]:
    return ((gazebo, each) for gazebo in root.all("gazebo") for each in gazebo.children if each.tag in tags)


def _text(node: RawNode) -> str:
    return node.attributes.get("value", "" if _is_unset(node) else node.text).strip()


def _is_unset(node: RawNode) -> bool:
    """Whether something else stands where it looks for the text."""
    is_first = node.begins_with_comment or (bool(node.children) and not node.text.strip())
    return is_first and "value" not in node.attributes


def _unread_numbers(root: RawNode) -> Fact:
    for _, node in _settings(root, _NUMBERS):
        if not _is_number(_text(node)):
            yield node, f"<{node.tag}> is {_text(node)!r}"
    for _, node in _settings(root, _WHOLE):
        if not _INTEGER.match(_text(node)):
            yield node, f"<{node.tag}> is {_text(node)!r}"


def _is_number(text: str) -> bool:
    """Whether it begins with a number that is neither too large nor too small."""
    if not _NUMBER.match(text):
        return False
    plain = _LARGE.match(text)
    if plain is None or "x" in text[:3].lower():
        return True
    number = float(plain[0])
    return abs(number) != float("inf") and (number != 0 or not re.search(r"[1-9]", plain[0].lower().split("e")[0]))


def _unset(root: RawNode) -> Fact:
    for _, node in _settings(root, _READ):
        if _is_unset(node):
            yield node, f"<{node.tag}> does not begin with its text"


FACTS: Mapping[str, Callable[[RawNode], Fact]] = {
    "unread-extension": _unread_numbers,
    "unset-extension": _unset,
}
"""Facts by their names in tables."""
