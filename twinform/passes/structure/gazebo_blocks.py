"""`<gazebo>` elements of URDF by reference, and which of their elements are about shapes, bodies or joints."""

from collections.abc import Iterable, Mapping

from twinform.ir import Element, GazeboExtension
from twinform.ir.defaults import BODY
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import to_element
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, LUMPS_WITHOUT, PRESERVES, TRUE, value_text
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.poses import link_elements, read_pose

Blocks = Mapping[str, list[GazeboExtension]]

_COLLISION_ELEMENTS = frozenset(
    {"collision", *(name for name, tag in LINK_TAGS.items() if tag.target in {"surface", "collision"})}
)
_VISUAL_ELEMENTS = frozenset({"visual", "material"})
SHAPE_ELEMENTS: Mapping[str, frozenset[str]] = {"visuals": _VISUAL_ELEMENTS, "collisions": _COLLISION_ELEMENTS}
"""Elements that apply to all shapes of a link, by the field of these shapes."""
_BODY_ELEMENTS = {
    "turnGravityOff": "gravity", "gravity": "gravity", "selfCollide": "self_collide", "self_collide": "self_collide",
    "dampingFactor": "velocity_decay", "velocity_decay": "velocity_decay", "kinematic": "kinematic",
    "enable_wind": "enable_wind", "inertial": "inertial", "pose": "pose",
}  # fmt: skip
"""Elements that apply to the body of a link, and the fields that they set."""
BODY_FLAGS: Mapping[str, str] = {
    name: field for name, field in _BODY_ELEMENTS.items() if field not in {"inertial", "pose"}
}
"""Elements that set a flag of the whole link, and the field of this flag."""
_TYPED = frozenset({"sensor", "light"})
"""Elements of links with a pose and a name for which the IR has types."""


def blocks_by_reference(extensions: Iterable[GazeboExtension]) -> Blocks:
    """The extensions by their references."""
    found: dict[str, list[GazeboExtension]] = {}
    for extension in extensions:
        found.setdefault(extension.reference or "", []).append(extension)
    return found


def block_content(there: Blocks, name: str) -> tuple[Element, ...]:
    """All elements of the extensions of a link or joint."""
    return tuple(element for extension in there.get(name, ()) for element in extension.content)


def shape_elements(elements: Iterable[Element], field: str) -> tuple[Element, ...]:
    """The elements that apply to all visuals or all collisions of a link."""
    return tuple(element for element in elements if element.name in SHAPE_ELEMENTS[field])


def body_settings(elements: Iterable[Element]) -> dict[str, object]:
    """The settings for the body of a link among the elements, except defaults."""
    settings: dict[str, object] = {}
    for element in elements:
        about = _BODY_ELEMENTS.get(element.name)
        if about is None:
            continue
        truth = value_text(element).lower() in TRUE
        if about in BODY:
            settings[about] = not truth if element.name == "turnGravityOff" else truth
        else:
            settings[about] = value_text(element).lower() if not element.children else element
    return {about: value for about, value in settings.items() if BODY.get(about) != value}


def becomes_locked_joint(elements: Iterable[Element]) -> bool:
    """Whether libsdformat turns a fixed joint with these elements into a revolute one without any range."""
    settings = {element.name for element in elements if value_text(element).lower() in TRUE}
    return LUMPS_WITHOUT in settings and PRESERVES not in settings


def has_sensor(elements: Iterable[Element]) -> bool:
    """Whether something measures at a joint: a sensor, or Gazebo Classic for `provideFeedback`."""
    return any(
        element.name == "sensor" or (element.name == "provideFeedback" and value_text(element).lower() in TRUE)
        for element in elements
    )


def is_effective(element: Element) -> bool:
    """Whether an element of a joint does anything in Gazebo."""
    tag = JOINT_TAGS.get(element.name)
    return tag is None or tag.target != "ignored"


def posed_names(elements: Iterable[Element]) -> set[tuple[str, str]]:
    """The kind and name of sensors, lights and other named elements of a link."""
    return {(element.name, element.get("name") or "") for element in elements if _may_have(element, "@name")}


def _may_have(element: Element, part: str) -> bool:
    """Whether an element of a link may have this part, a pose or a name."""
    return element.name in _TYPED or element.name in link_elements(part)


def rename_taken_names(elements: Iterable[Element], taken: set[tuple[str, str]], link: str) -> tuple[Element, ...]:
    """The elements, with the name of the link before names of sensors and lights that are taken; takes all names."""
    return tuple(_rename_if_taken(element, taken, link) for element in elements)


def _rename_if_taken(element: Element, taken: set[tuple[str, str]], link: str) -> Element:
    key = (element.name, element.get("name") or "")
    if not key[1] or not _may_have(element, "@name"):
        return element
    if key in taken:
        name = unique_name(f"{link}_{key[1]}", {name for kind, name in taken if kind == element.name})
        pairs = tuple((field, name if field == "name" else value) for field, value in element.attributes)
        element, key = element.copy(attributes=pairs), (element.name, name)
    taken.add(key)
    return element


def move_element(element: Element, at: Transform) -> Element:
    """An element of a link for another link, in whose frame the old link is at a pose."""
    if not _may_have(element, "pose"):
        return element
    pose = element.find("pose")
    if pose is not None and (pose.get("relative_to") or pose.get("frame")):
        return element
    written = Transform.from_pose(read_pose(pose)) if pose is not None else Transform()
    made = to_element(at.compose(written).to_pose(), "pose", "sdf")
    if pose is None:
        return element.copy(children=(made, *element.children))
    return element.exchange(pose, made)
