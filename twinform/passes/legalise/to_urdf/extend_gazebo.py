"""Writing `<gazebo>` elements for what URDF lacks and Gazebo reads."""

from collections.abc import Iterable, Iterator
from functools import cache
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Dynamics, Element, GazeboExtension, Joint, Link, Model, Opaque, replace_fields
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import is_synthesized
from twinform.passes.carriers.carriers import SECOND, to_element
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.gazebo_tags import FLAGS, JOINT_TAGS, LINK_TAGS, MODEL_TAGS, flag_tags
from twinform.schemas import format_value, table

_LINK_FIELDS = ("enable_wind", "kinematic", "sensors", "lights")
_MODEL_FIELDS = ("static", "self_collide", "allow_auto_disable", "enable_wind", "pose")
_SPRING_TAGS = {"spring_reference": "springReference", "spring_stiffness": "springStiffness"}
_PHYSICS_TAGS = {
    "ode/limit/cfm": "stopCfm",
    "ode/limit/erp": "stopErp",
    "ode/fudge_factor": "fudgeFactor",
    "ode/implicit_spring_damper": "implicitSpringDamper",
    "provide_feedback": "provideFeedback",
}
_NOT_VERBATIM = frozenset({"physics", "frame", *LINK_TAGS, *JOINT_TAGS, *MODEL_TAGS})
"""Elements that must not be copied into `<gazebo>`: a second `<physics>` would count twice, `<frame>` went with 1.7,
and an element named like a tag would be read as the tag."""


class ExtendGazebo(ToUrdfPass):
    """Put into `<gazebo>` elements what Gazebo reads there.

    Changes: 1. sensors, lights, flags and opaque parts of a link, sensors of a joint, and flags, pose, plugins and
    opaque parts of the model stand there as they are in SDF; 2. springs and physics of a joint become the tags that
    mean them; 3. `preserveFixedJoint` keeps libsdformat from merging links that are fixed to each other.
    Never touches: parts without a tag, and second copies of what may stand once; the last pass carries them.
    """

    name: ClassVar[str] = "extend-gazebo"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with its extensions."""
        extensions = list(model.extensions)
        links: list[Link] = []
        joints: list[Joint] = []
        names = {link.name for link in model.links}
        with_mass = {link.name for link in model.links if link.inertial and (link.inertial.mass or 0) > 0}
        for link in model.links:
            content, left = _link_content(link)
            links.append(left)
            extensions.extend(_extension(link, content))
        if keeper.back:  # what URDF lets libsdformat merge, it may merge again
            with_mass = set[str]()
        for joint in model.joints:
            content, left = _joint_content(joint, names, with_mass, keeper)
            joints.append(left)
            extensions.extend(_extension(joint, content))
        extensions.extend(_model_extensions(model))
        cleared = dict.fromkeys(_MODEL_FIELDS)
        update = {
            "links": tuple(links),
            "joints": tuple(joints),
            "extensions": tuple(extensions),
            "plugins": (),
            "opaque": _without_verbatim(model.opaque, "model"),
        }
        return model.copy(**{**cleared, **update})


def _extension(node: Link | Joint, content: Iterable[Element]) -> Iterator[GazeboExtension]:
    listed = tuple(content)
    if listed:
        yield GazeboExtension.unchecked(reference=node.name, content=listed, source=node.source)


@cache
def _typed_children(definition: str) -> frozenset[str]:
    """The children of a definition that have a typed form, so that an opaque one is a repetition or empty."""
    return frozenset(row.name for row in table("sdf").definitions[definition].children if row.place)


def _is_verbatim(part: Opaque, definition: str) -> bool:
    element = part.element
    if element is None or part.at or element.name[0] == "{":
        return False
    return element.name not in _typed_children(definition) and element.name not in _NOT_VERBATIM


def _verbatim_elements(parts: Iterable[Opaque], definition: str) -> list[Element]:
    return [part.element for part in parts if part.element and _is_verbatim(part, definition)]


def _without_verbatim(parts: tuple[Opaque, ...], definition: str) -> tuple[Opaque, ...]:
    return tuple(part for part in parts if not _is_verbatim(part, definition))


def _link_content(link: Link) -> tuple[list[Element], Link]:
    written = {field: getattr(link, field) for field in _LINK_FIELDS}
    content = list(flag_tags(link))
    link = link.copy(**dict.fromkeys(FLAGS)) if content else link
    if any(value not in (None, ()) for value in written.values()):
        content += to_element(Link.unchecked(name=link.name, spelling=link.spelling, **written), "link", "sdf").children
    content += _verbatim_elements(link.opaque, "link")
    if not content:
        return content, link
    empty = {field: () if isinstance(value, tuple) else None for field, value in written.items()}
    return content, link.copy(**{**empty, "opaque": _without_verbatim(link.opaque, "link")})


def _joint_content(
    joint: Joint, links: set[str], with_mass: set[str], keeper: UrdfKeeper
) -> tuple[list[Element], Joint]:
    content: list[Element] = []
    # Links of SDF are bodies. Without the tag, libsdformat would lump them into one when it reads
    # the URDF, and contact sensors and plugins would lose the names that they know.
    if joint.type == "fixed" and joint.parent != WORLD and joint.child in with_mass and not is_synthesized(joint):
        content.append(Element.unchecked(name="preserveFixedJoint", text="true"))
    springs, joint = _take_springs(joint)
    physics, joint = _take_physics(joint, keeper)
    content += [*springs, *physics]
    if joint.name in links:  # a reference would mean the link
        return content, joint
    if joint.sensors:
        content += to_element(Joint.unchecked(name="", type="fixed", sensors=joint.sensors), "joint", "sdf").children
    content += _verbatim_elements(joint.opaque, "joint")
    return content, replace_fields(joint, sensors=(), opaque=_without_verbatim(joint.opaque, "joint"))


def _take_springs(joint: Joint) -> tuple[list[Element], Joint]:
    axis = joint.axis
    if axis is None or axis.dynamics is None or joint.type == "fixed":
        return [], joint
    values = {field: getattr(axis.dynamics, field) for field in _SPRING_TAGS}
    content = [
        Element.unchecked(name=_SPRING_TAGS[field], text=format_value(value))
        for field, value in values.items()
        if value is not None
    ]
    if not content:
        return [], joint
    dynamics: Dynamics | None = axis.dynamics.copy(**dict.fromkeys(_SPRING_TAGS))
    dynamics = None if dynamics == Dynamics.unchecked() else dynamics
    return content, joint.copy(axis=axis.copy(dynamics=dynamics))


def _take_physics(joint: Joint, keeper: UrdfKeeper) -> tuple[list[Element], Joint]:
    """The tags for the first `<physics>` of a joint, and the joint with further ones in carriers."""
    content: list[Element] = []
    parts: list[Opaque] = []
    again: list[Opaque] = []
    for part in joint.opaque:
        if part.element is None or part.element.name != "physics" or part.at:
            parts.append(part)
        elif content:
            again.append(part)
        else:
            left = _take_tags(part.element, "", content)
            parts += [] if left is None else [part.copy(element=left)]
    if not content:
        return content, joint
    joint = joint.copy(opaque=tuple(parts))
    message = f"joint {joint.name!r} has a <physics> already"
    return content, keeper.keep(joint, again, rules.SDF_ONLY, message, joint.location, about=SECOND)


def _take_tags(element: Element, path: str, tags: list[Element]) -> Element | None:
    """Move the leaves that have tags from an element to `tags`; returns the rest of the element, if any."""
    children: list[Element] = []
    for child in element.children:
        inner = f"{path}/{child.name}" if path else child.name
        if inner in _PHYSICS_TAGS and not child.attributes and not child.children and child.text:
            tags.append(Element.unchecked(name=_PHYSICS_TAGS[inner], text=child.text))
            continue
        left = _take_tags(child, inner, tags)
        if left is not None:
            children.append(left)
    if not children and element.children and not element.attributes:
        return None
    return element.copy(children=tuple(children))


def _model_extensions(model: Model) -> Iterator[GazeboExtension]:
    # One <gazebo> for each plugin, as people write them by hand.
    for plugin in model.plugins:
        yield GazeboExtension.unchecked(content=(to_element(plugin, "plugin", "sdf"),), source=plugin.source)
    for element in _verbatim_elements(model.opaque, "model"):
        yield GazeboExtension.unchecked(content=(element,))
    written = {field: getattr(model, field) for field in _MODEL_FIELDS}
    flags = to_element(Model.unchecked(name=model.name, spelling=model.spelling, **written), "model", "sdf").children
    if flags:  # the last one decides about `static` in libsdformat 12, also by its silence: InsertSDFExtensionRobot
        yield GazeboExtension.unchecked(content=flags)
