"""What only MJCF has, kept in a node as `<tf:mjcf>`, merged into the element that is written for that node.

A joint that was read with an armature holds `<tf:mjcf><joint armature="0.1"/></tf:mjcf>`. Attributes that the written
element lacks are added, and children go behind its own; what the node says itself wins.

In SDF a joint is drawn at zero. Where it keeps a `ref`, its range and the rest position of its spring are counted from
there, and get it added again. A limit of force that was none of the joint, but of its actuators, is written once it
has been edited.
"""

from collections.abc import Sequence
from pathlib import PurePosixPath

from twinform.ir import Collision, Element, Joint, Node, Visual
from twinform.ir.transform import rounded_number
from twinform.passes.carriers.carriers import KEPT, ROOT
from twinform.schemas import format_value

FORCE = ("actuatorfrclimited", "actuatorfrcrange")
"""The attributes of a joint that limit the forces of all its actuators together."""
_POLYNOMIALS = ("damping", "stiffness")
"""Coefficients of which SDF says the first."""
# MuJoCo takes them in any order; this is the one of its documentation, with our texts behind what people read.
SECTIONS = (
    "option", "size", "visual", "statistic", "default", "extension", "asset", "worldbody", "contact", "deformable",
    "equality", "tendon", "actuator", "sensor", "keyframe", "custom",
)  # fmt: skip
NO_SECTION = ""
"""The key of elements that stand beside the sections, where MuJoCo knows none: of a file to include, or a mistake."""
LIMITED = {
    "range": "limited",
    "ctrlrange": "ctrllimited",
    "forcerange": "forcelimited",
    "actrange": "actlimited",
    "actuatorfrcrange": "actuatorfrclimited",
}
"""The attributes that say whether a range limits, by those of the ranges."""
WITHOUT_CONTROL_LIMIT = frozenset({"damper", "adhesion", "orientation"})
"""Actuators without `ctrllimited`."""
TARGETS = ("joint", "jointinparent", "tendon", "site", "body", "slidersite")
"""The attributes of actuators that say what they drive."""
_SHAPES = ("size", "mesh", "hfield")
"""The attributes of geoms of which one says a shape, together with the type."""
SINGLE = frozenset({"compiler", "option", "size", "visual", "statistic"})
"""Sections that are one element with attributes: what is added to them is merged."""
KNOWN = SINGLE.union(SECTIONS, (ROOT,))
"""The root and all of its sections; MuJoCo refuses others."""


def kept_elements(node: Node) -> Sequence[Element]:
    """The elements of MJCF that a node keeps."""
    if not node.opaque:
        return ()
    kept = [each.element for each in node.opaque if each.element is not None and each.element.name == KEPT]
    return [child for each in kept for child in each.children] if kept else ()


def is_shape(kept: Element) -> bool:
    """Whether what is kept is a geom of its own, such as one of a mesh without a file, and not the rest of another."""
    return kept.name == "geom" and (bool(kept.children) or any(kept.get(name) for name in _SHAPES))


def kept_of_geom(part: Visual | Collision, name: str) -> str:
    """The value of an attribute of the geom that a visual or collision was read from; empty where it keeps none."""
    for each in kept_elements(part):
        if each.name == "geom" and (value := each.get(name)):
            return value
    return ""


def asset_name(asset: Element) -> str:
    """The name of an asset: one without a name is called after its file."""
    file = (asset.get("file") or "").replace("\\", "/")
    return asset.get("name") or PurePosixPath(file).stem


def with_kept(element: Element, node: Node) -> Element:
    """Return the element with what the node keeps of an element of this name."""
    for kept in kept_elements(node):
        if kept.name == element.name:
            element = merged(element, kept)
    return element


def merged(element: Element, kept: Element) -> Element:
    """Return an element with the attributes that it lacks and the children of one that was kept."""
    known = {key for key, _ in element.attributes}
    more = tuple(each for each in kept.attributes if each[0] not in known)
    return element.copy(attributes=(*element.attributes, *more), children=(*element.children, *kept.children))


def kept_joints(joint: Joint, count: int = 1) -> list[Element | None]:
    """What a joint of SDF keeps of each of the joints of MJCF that stand for it, the nearest to the parent first.

    Each of several keeps its name; what has none is of the last.
    """
    kept = [each for each in kept_elements(joint) if each.name == "joint"]
    if len(kept) >= count:
        return [*kept[:count]]
    return [*[None] * (count - 1), kept[-1] if kept else None]


def with_kept_joint(element: Element, kept: Element | None) -> Element:
    """Return a joint of MJCF with what the joint of SDF keeps of it."""
    if kept is None:
        return element
    is_of_actuators = kept.get(FORCE[0]) == "false"
    said = kept.get(FORCE[1]) or element.get(FORCE[1])
    if is_of_actuators and said and _is_greatest(said, element.get(FORCE[1])):  # else it was edited
        element = _without_force(element)
    written = tuple((name, _with_rest(name, value, kept)) for name, value in element.attributes)
    if (force := kept.get(FORCE[1])) and _is_greatest(force, element.get(FORCE[1])):
        written = tuple((name, force if name == FORCE[1] else value) for name, value in written)
    made = merged(element.copy(attributes=written), kept)
    if made.get(FORCE[1]) is None or (is_of_actuators and element.get(FORCE[1]) is None):
        made = _without_force(made)  # where nothing is limited, it need not be said
    return _counted_from(made)


def _without_force(element: Element) -> Element:
    return element.copy(attributes=tuple(pair for pair in element.attributes if pair[0] not in FORCE))


def with_kept_equality(element: Element, joint: Joint) -> Element:
    """Return an equality of MJCF with what the joint of SDF keeps of the one that it was read from."""
    for section in kept_elements(joint):
        for kept in section.children:
            if section.name == "equality" and kept.name == element.name:
                element = merged(element, kept.copy(children=()))
    return element


def _is_greatest(force: str, effort: str | None) -> bool:
    """Whether the effort, written as a range, is the greater end of the range of forces that was read."""
    return effort is not None and max(abs(float(each)) for each in force.split()) == float(effort.split()[-1])


def _with_rest(name: str, value: str, kept: Element) -> str:
    """Return a first coefficient with those that stood behind it."""
    others = (kept.get(name) or "").split()[1:] if name in _POLYNOMIALS else []
    return " ".join([value, *others])


def _counted_from(element: Element) -> Element:
    """Return the joint with positions counted from its `ref`."""
    ref = float(element.get("ref") or 0.0)
    if not ref:
        return element
    attributes = dict(element.attributes)
    if "range" in attributes:
        attributes["range"] = _moved(attributes["range"], ref)
    if "stiffness" in attributes:
        attributes["springref"] = _moved(attributes.get("springref", "0"), ref)
    return element.copy(attributes=tuple(attributes.items()))


def _moved(text: str, by: float) -> str:
    numbers = [rounded_number(float(each) + by) for each in text.split()]
    return " ".join(map(format_value, numbers))
