"""A transmission, read from `<transmission>` of ROS 1 or from `<ros2_control>`, and written as either of them.

Names of interfaces and types are from ros_control's `hardware_interface` and `transmission_interface`,
`pr2_mechanism_model`, and the packages of the same names in ros2_control.

Such elements of URDF a model keeps unchanged: as opaque parts in a URDF document, as carriers in SDF.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from twinform.dataclass import dataclass
from twinform.diagnostics import Location
from twinform.ir import Element, Format, Model, Opaque
from twinform.passes.carriers.carriers import is_carrier, pack, unpack

_REDUCTION = "mechanicalReduction"
_KNOWN = frozenset({"type", "plugin", "joint", "actuator", "param", _REDUCTION})
_KNOWN_IN_END = frozenset({"hardwareInterface", "role", _REDUCTION, "mechanical_reduction", "offset", "param"})
_INTERFACE = "hardwareInterface"
STATES = ("position", "velocity", "effort")
"""The states of every joint of ros_control: `JointStateHandle` has all three."""
COMMANDS: dict[str, tuple[str, ...]] = {
    "PositionJointInterface": ("position",),
    "VelocityJointInterface": ("velocity",),
    "EffortJointInterface": ("effort",),
    "PosVelJointInterface": ("position", "velocity"),
    "PosVelAccJointInterface": ("position", "velocity", "acceleration"),
    "JointStateInterface": (),
}
"""The command interfaces that an interface of ros_control stands for."""
CLASSES: dict[str, str] = {
    "position": "hardware_interface/PositionJointInterface",
    "velocity": "hardware_interface/VelocityJointInterface",
    "effort": "hardware_interface/EffortJointInterface",
}
"""The class of ros_control for one command interface."""
STATE_CLASS = "hardware_interface/JointStateInterface"
SIMPLE = "transmission_interface/SimpleTransmission"
PLUGINS = frozenset({
    SIMPLE,
    "transmission_interface/DifferentialTransmission",
    "transmission_interface/FourBarLinkageTransmission",
})  # fmt: skip
"""The transmissions that come with ros2_control; they have the same names in ros_control."""
OLDER_TYPES: dict[str, str] = {
    "SimpleTransmission": SIMPLE,
    "pr2_mechanism_model/SimpleTransmission": SIMPLE,
}
"""Older names of transmissions."""
COMMANDED_BY_TYPE: dict[str, str] = {"pr2_mechanism_model/SimpleTransmission": "EffortJointInterface"}
"""The implied command interface of a type: the mechanism of the PR2 only commands efforts."""


def commands_of(interface: str) -> tuple[str, ...] | None:
    """The command interfaces of an interface of ros_control; None if ros_control does not have it."""
    package, _, name = interface.rpartition("/")
    return COMMANDS.get(name) if package in {"", "hardware_interface"} else None


@dataclass(frozen=True, slots=True)
class End:
    """A joint or actuator of a transmission.

    `reduction` and `offset` are as they were written; joint position = actuator position / reduction + offset.
    `parameters` is its other content, by name.
    """

    name: str
    role: str | None = None
    reduction: str | None = None
    offset: str | None = None
    interfaces: tuple[str, ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Transmission:
    """A transmission from actuators to joints; `foreign` are names of parts that only other programs know."""

    name: str
    type: str
    joints: tuple[End, ...]
    actuators: tuple[End, ...]
    parameters: tuple[tuple[str, str], ...] = ()
    foreign: tuple[str, ...] = ()


def read_transmission(element: Element) -> Transmission:
    """Read a `<transmission>` of ROS 1 or 2; unknown content becomes parameters, or is foreign."""
    type_ = _text(element, "type") or _text(element, "plugin") or element.get("type") or ""
    ends = {kind: tuple(_read_end(each) for each in element.find_all(kind)) for kind in ("joint", "actuator")}
    joints, actuators = ends["joint"], ends["actuator"]
    whole = _text(element, _REDUCTION)
    if whole and len(actuators) == 1 and actuators[0].reduction is None:
        actuators = (replace(actuators[0], reduction=whole),)
    if type_ in COMMANDED_BY_TYPE:
        joints = tuple(replace(joint, interfaces=joint.interfaces or (COMMANDED_BY_TYPE[type_],)) for joint in joints)
    return Transmission(
        name=element.get("name") or "_".join(joint.name for joint in joints),
        type=OLDER_TYPES.get(type_, type_),
        joints=joints,
        actuators=actuators,
        parameters=tuple(_read_parameters(element, _KNOWN)),
        foreign=tuple(_foreign_parts(element)),
    )


def _read_end(element: Element) -> End:
    return End(
        name=element.get("name") or "",
        role=_text(element, "role") or element.get("role"),
        reduction=_text(element, _REDUCTION) or _text(element, "mechanical_reduction"),
        offset=_text(element, "offset"),
        interfaces=tuple(each.text for each in element.find_all(_INTERFACE) if each.text),
        parameters=tuple(_read_parameters(element, _KNOWN_IN_END)),
    )


def write_ros2_transmission(transmission: Transmission) -> Element:
    """Write a transmission as an element of `<ros2_control>`.

    A simple transmission of ROS 1 has its reduction at the actuator, one of ROS 2 at the joint.
    """
    joints, actuators = transmission.joints, transmission.actuators
    if transmission.type == SIMPLE and len(joints) == len(actuators) == 1 and actuators[0].reduction:
        joints = (replace(joints[0], reduction=actuators[0].reduction),)
        actuators = (replace(actuators[0], reduction=None),)
    children = [Element(name="plugin", text=transmission.type)]
    children += [_write_ros2_end("actuator", actuator, number) for number, actuator in enumerate(actuators, 1)]
    children += [_write_ros2_end("joint", joint, number) for number, joint in enumerate(joints, 1)]
    children += [_param_element(name, value) for name, value in transmission.parameters]
    for end in (*joints, *actuators):
        children += [_param_element(f"{end.name}.{name}", value) for name, value in end.parameters]
    return Element(name="transmission", attributes=(("name", transmission.name),), children=tuple(children))


def write_ros1_transmission(transmission: Transmission) -> Element:
    """Write a transmission as a `<transmission>` of ROS 1."""
    joints, actuators = transmission.joints, transmission.actuators
    if transmission.type == SIMPLE and len(joints) == len(actuators) == 1 and joints[0].reduction:
        actuators = (replace(actuators[0], reduction=joints[0].reduction),)
        joints = (replace(joints[0], reduction=None),)
    children = [Element(name="type", text=transmission.type)]
    children += [_text_element(name, value) for name, value in _shared_parameters(transmission)]
    alone = len(joints) == len(actuators) == 1
    children += [_write_ros1_end("joint", joint, transmission, role=not alone) for joint in joints]
    children += [_write_ros1_end("actuator", actuator, transmission, role=not alone) for actuator in actuators]
    return Element(name="transmission", attributes=(("name", transmission.name),), children=tuple(children))


def _text(element: Element, name: str) -> str | None:
    child = element.find(name)
    return child.text if child is not None else None


def _is_plain(element: Element) -> bool:
    return not (element.attributes or element.children or element.name.startswith("{") or ":" in element.name)


def _read_parameters(element: Element, known: frozenset[str]) -> Iterator[tuple[str, str]]:
    for child in element.children:
        if child.name == "param":
            yield child.get("name") or "", child.text or ""
        elif child.name not in known and _is_plain(child):
            yield child.name, child.text or ""


def _foreign_parts(element: Element) -> Iterator[str]:
    for holder, known in ((element, _KNOWN), *((end, _KNOWN_IN_END) for end in element.children)):
        if holder is not element and holder.name not in {"joint", "actuator"}:
            continue
        yield from (child.name for child in holder.children if child.name not in known and not _is_plain(child))


def _write_ros2_end(kind: str, end: End, number: int) -> Element:
    """An end for `<ros2_control>`, which requires a role."""
    values = (("mechanical_reduction", end.reduction), ("offset", end.offset))
    return Element(
        name=kind,
        attributes=(("name", end.name), ("role", end.role or f"{kind}{number}")),
        children=tuple(_text_element(name, value) for name, value in values if value),
    )


def _write_ros1_end(kind: str, end: End, transmission: Transmission, *, role: bool) -> Element:
    values = [(_INTERFACE, interface) for interface in end.interfaces]
    values += [("role", end.role)] if role and end.role else []
    values += [(name, value) for name, value in (("offset", end.offset), (_REDUCTION, end.reduction)) if value]
    prefix = f"{end.name}."
    parameters = [
        (name.removeprefix(prefix), value) for name, value in transmission.parameters if name.startswith(prefix)
    ]
    children = tuple(_text_element(name, value) for name, value in (*values, *parameters))
    return Element(name=kind, attributes=(("name", end.name),), children=children)


def _shared_parameters(transmission: Transmission) -> Iterator[tuple[str, str]]:
    """The parameters that do not belong to an end."""
    prefixes = tuple(f"{end.name}." for end in (*transmission.joints, *transmission.actuators))
    return ((name, value) for name, value in transmission.parameters if not name.startswith(prefixes))


def _text_element(name: str, text: str) -> Element:
    return Element(name=name, text=text or None)


def _param_element(name: str, value: str) -> Element:
    return Element(name="param", attributes=(("name", name),), text=value or None)


def element_of(part: Opaque, format_: Format) -> Element | None:
    """The URDF element in an opaque part of a model; None if there is none."""
    if format_ is Format.URDF:
        return part.element
    if not is_carrier(part, "urdf"):
        return None
    # One carrier may hold several pieces, or one from further inside a node; neither is an element
    # of a robot as it stood in URDF.
    pieces = unpack(part)
    return pieces[0].element if len(pieces) == 1 and not pieces[0].at else None


def urdf_elements(model: Model, format_: Format, name: str) -> Iterator[tuple[Opaque, Element]]:
    """The URDF elements with this name, each with the part that holds it."""
    for part in model.opaque:
        found = element_of(part, format_)
        if found is not None and found.name == name:
            yield part, found


def as_parts(new: Iterable[Element], format_: Format) -> tuple[Opaque, ...]:
    """URDF elements as parts of a model."""
    parts = tuple(Opaque(element=each) for each in new)
    return parts if format_ is Format.URDF else pack(parts, "urdf")


def replace_parts(model: Model, gone: Iterable[Opaque], new: Iterable[Opaque], *, after: Opaque) -> Model:
    """The model without some parts, and with new ones after a part that it has or had."""
    gone_ids = {id(part) for part in gone}
    parts: list[Opaque] = []
    for part in model.opaque:
        if id(part) not in gone_ids:
            parts.append(part)
        # Also where the part itself is gone: the new ones take its place, so that files keep their
        # order.
        if part is after:
            parts.extend(new)
    return model.copy(opaque=tuple(parts))


def location_of(part: Opaque, model: Model) -> Location:
    """The location of a part; of its model if a pass has made the part."""
    return part.location if part.source else model.location
