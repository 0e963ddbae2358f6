"""`<gazebo>` elements of URDF by reference, and the links and joints that their content is about."""

from collections.abc import Iterable, Mapping

from twinform.ir import Element, GazeboExtension
from twinform.ir.defaults import BODY
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import to_element
from twinform.passes.transforms.element_poses import link_elements, read_pose
from twinform.passes.transforms.gazebo_tags import JOINT_TAGS, LINK_TAGS, TRUE, value_text
from twinform.passes.transforms.lumped_links import LUMPS_WITHOUT, PRESERVES
from twinform.passes.transforms.nodes import unique_name

Blocks = Mapping[str, list[GazeboExtension]]

_OF_COLLISIONS = frozenset(
    {"collision", *(name for name, tag in LINK_TAGS.items() if tag.target in {"surface", "collision"})}
)
_OF_VISUALS = frozenset({"visual", "material"})
OF_SHAPES: Mapping[str, frozenset[str]] = {"visuals": _OF_VISUALS, "collisions": _OF_COLLISIONS}
"""Elements that are about all shapes of a link, by the field that has these shapes."""
_OF_BODY = {
    "turnGravityOff": "gravity", "gravity": "gravity", "selfCollide": "self_collide", "self_collide": "self_collide",
    "dampingFactor": "velocity_decay", "velocity_decay": "velocity_decay", "kinematic": "kinematic",
    "enable_wind": "enable_wind", "inertial": "inertial", "pose": "pose",
}  # fmt: skip
"""Elements that are about the body of a link, and their values something of."""
FLAGS: Mapping[str, str] = {name: field for name, field in _OF_BODY.items() if field not in {"inertial", "pose"}}
"""The fields of a body that these elements set, each for the whole link."""
_TYPED = frozenset({"sensor", "light"})
"""Elements with a pose and a name that links of SDF have beside those without a typed form."""


def blocks(extensions: Iterable[GazeboExtension]) -> Blocks:
    """The extensions by their references."""
    found: dict[str, list[GazeboExtension]] = {}
    for extension in extensions:
        found.setdefault(extension.reference or "", []).append(extension)
    return found


def content(there: Blocks, name: str) -> tuple[Element, ...]:
    """All that extensions say of a link or joint."""
    return tuple(element for extension in there.get(name, ()) for element in extension.content)


def of_shapes(elements: Iterable[Element], field: str) -> tuple[Element, ...]:
    """What is about all shapes of a kind."""
    return tuple(element for element in elements if element.name in OF_SHAPES[field])


def of_body(elements: Iterable[Element]) -> dict[str, object]:
    """The settings of the body of a link; what is usual is left out."""
    settings: dict[str, object] = {}
    for element in elements:
        about = _OF_BODY.get(element.name)
        if about is None:
            continue
        truth = value_text(element).lower() in TRUE
        if about in BODY:
            settings[about] = not truth if element.name == "turnGravityOff" else truth
        else:
            settings[about] = value_text(element).lower() if not element.children else element
    return {about: value for about, value in settings.items() if BODY.get(about) != value}


def turns_by_nothing(elements: Iterable[Element]) -> bool:
    """Whether libsdformat makes a joint that turns by nothing of a fixed one that is to stay."""
    settings = {element.name for element in elements if value_text(element).lower() in TRUE}
    return LUMPS_WITHOUT in settings and PRESERVES not in settings


def measures(elements: Iterable[Element]) -> bool:
    """Whether something measures at a joint: a sensor, or Gazebo Classic asked for the forces in it."""
    return any(
        element.name == "sensor" or (element.name == "provideFeedback" and value_text(element).lower() in TRUE)
        for element in elements
    )


def is_set(element: Element) -> bool:
    """Whether a joint's element would do anything in Gazebo."""
    tag = JOINT_TAGS.get(element.name)
    return tag is None or tag.target != "ignored"


def posed_names(elements: Iterable[Element]) -> set[tuple[str, str]]:
    """Sensors, lights and the like among elements, by kind and name."""
    return {(element.name, element.get("name") or "") for element in elements if _has(element, "@name")}


def _has(element: Element, part: str) -> bool:
    """Whether an element of a link, beside its shapes, may have a pose or a name."""
    return element.name in _TYPED or element.name in link_elements(part)


def named_apart(elements: Iterable[Element], taken: set[tuple[str, str]], link: str) -> tuple[Element, ...]:
    """The elements, with the name of their link before the name of a sensor or light that is taken; takes them all."""
    return tuple(_with_unique_name(element, taken, link) for element in elements)


def _with_unique_name(element: Element, taken: set[tuple[str, str]], link: str) -> Element:
    key = (element.name, element.get("name") or "")
    if not key[1] or not _has(element, "@name"):
        return element
    if key in taken:
        name = unique_name(f"{link}_{key[1]}", {name for kind, name in taken if kind == element.name})
        pairs = tuple((field, name if field == "name" else value) for field, value in element.attributes)
        element, key = element.copy(attributes=pairs), (element.name, name)
    taken.add(key)
    return element


def in_host(element: Element, at: Transform) -> Element:
    """An element of a link in the frame of another, in which the link's frame is `at`."""
    if not _has(element, "pose"):
        return element
    pose = element.find("pose")
    if pose is not None and (pose.get("relative_to") or pose.get("frame")):
        return element
    written = Transform.from_pose(read_pose(pose)) if pose is not None else Transform()
    made = to_element(at.compose(written).to_pose(), "pose", "sdf")
    if pose is None:
        return element.copy(children=(made, *element.children))
    children = tuple(made if child is pose else child for child in element.children)
    return element.copy(children=children)
