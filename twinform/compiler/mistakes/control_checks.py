"""Checks of `<ros2_control>` and `<transmission>`: repeated and misspelled names, values, and mimic joints."""

from collections import Counter
from collections.abc import Iterator

from twinform.compiler.mistakes.value_checks import number_of, place_of, tag_of, text_of
from twinform.diagnostics import DiagnosticSink, nearest_name, rules
from twinform.ir import Document, Joint
from twinform.schemas import XmlElement

INTERFACES = ("position", "velocity", "effort", "acceleration")
"""The interfaces that ros2_control has words for; a driver may have others of its own."""
SENSOR_INTERFACES = tuple(
    f"{what}.{axis}"
    for what, axes in (
        ("orientation", "xyzw"), ("angular_velocity", "xyz"), ("linear_acceleration", "xyz"), ("force", "xyz"),
        ("torque", "xyz"),
    )
    for axis in axes
)  # fmt: skip
"""What the broadcasters of an IMU and of a force-torque sensor ask for (`semantic_components`)."""
_COMMANDS = ("command_interface", "state_interface")
HARDWARE = (
    "gz_ros2_control/GazeboSimSystem", "ign_ros2_control/IgnitionSystem", "gazebo_ros2_control/GazeboSystem",
    "mock_components/GenericSystem", "fake_components/GenericSystem", "topic_based_ros2_control/TopicBasedSystem",
)  # fmt: skip
TRANSMISSIONS = (
    "transmission_interface/SimpleTransmission", "transmission_interface/DifferentialTransmission",
    "transmission_interface/FourBarLinkageTransmission",
    "transmission_interface/HalfDifferentialTransmission",
)  # fmt: skip
HARDWARE_INTERFACES = (
    "hardware_interface/PositionJointInterface",
    "hardware_interface/VelocityJointInterface", "hardware_interface/EffortJointInterface",
    "hardware_interface/JointStateInterface", "hardware_interface/PosVelJointInterface",
    "hardware_interface/PosVelAccJointInterface",
)  # fmt: skip
_CLASSES = (*HARDWARE, *TRANSMISSIONS, *HARDWARE_INTERFACES)
"""Classes and interfaces of ROS packages; robots have others of their own."""
# A driver's own interface is less alike: torque, gain, current.
_TYPO = 0.8
_CLASS_TYPO = 0.9
_TWICE = 2
_SEVERAL = 3
_SLACK = 1e-3
"""How far limits may differ by rounding, relative to their size."""


def report_control(document: Document, tree: XmlElement, sink: DiagnosticSink) -> None:
    """Report mistakes in the `<ros2_control>` and `<transmission>` elements of a robot."""
    blocks = list(tree.iterchildren("ros2_control"))
    # Those with the attribute `type` are for the PR2's reader, and may stand beside others of the same joints.
    transmissions = [each for each in tree.iterchildren("transmission") if not each.get("type")]
    if not blocks and not transmissions:
        return
    joints = {joint.name: joint for model in document.models for joint in model.joints}
    _report_repeated("<ros2_control>", blocks, sink)
    commanded: dict[str, XmlElement] = {}
    for block in blocks:
        _report_block(block, joints, commanded, sink)
    _report_repeated("<transmission>", transmissions, sink)
    _report_repeated("actuator", [each for one in transmissions for each in one.iterchildren("actuator")], sink)
    # Each kind has a loader of its own: one that reads the ends of an arm may name joints that others drive.
    for kind in {text_of(each.find("type")): None for each in transmissions}:
        own = [each for each in transmissions if text_of(each.find("type")) == kind]
        _report_repeated("joint of a transmission", [each for one in own for each in one.iterchildren("joint")], sink)
    for one in transmissions:
        for each in one.iter("type", "hardwareInterface"):
            _report_class(each, sink)


def _report_repeated(what: str, elements: list[XmlElement], sink: DiagnosticSink) -> None:
    """Report names that stand twice; as one finding where there are several, since all were copied together."""
    first: dict[str, XmlElement] = {}
    counts = Counter(element.get("name") for element in elements)
    found: list[tuple[str, XmlElement]] = []
    for element in elements:
        name = element.get("name")
        if what == "actuator" and counts[name] > _TWICE:  # one motor that pulls the tendons of many joints
            continue
        if name and first.setdefault(name, element) is not element:
            found.append((name, element))
    others = ", ".join(repr(name) for name, _ in found[1:])
    for name, element in found if len(found) < _SEVERAL else found[:1]:
        message = f"{what} {name!r} stands here twice; was it copied?"
        if len(found) >= _SEVERAL:
            message = f"{what} {name!r} stands here twice, and so do {others}; were they copied?"
        sink.report(rules.REPEATED_CONTROL, message, place_of(element), found=name, related=(place_of(first[name]),))


def _report_block(
    block: XmlElement, joints: dict[str, Joint], commanded: dict[str, XmlElement], sink: DiagnosticSink
) -> None:
    for plugin in block.iterfind("hardware/plugin"):
        _report_class(plugin, sink)
    components = [each for each in block if tag_of(each) in {"joint", "sensor", "gpio"}]
    _report_repeated(f"in <ros2_control> {block.get('name')!r}, the component", components, sink)
    for component in components:
        for kind in _COMMANDS:
            _report_repeated(f"{kind} of {component.get('name')!r},", list(component.iterchildren(kind)), sink)
        for interface in component.iterchildren(*_COMMANDS):
            if tag_of(component) == "joint":
                _report_interface(interface, sink)
        if tag_of(component) == "joint":
            _report_joint(component, joints.get(component.get("name") or ""), sink)
            _report_taken(component, block, commanded, sink)


def _report_taken(
    component: XmlElement, block: XmlElement, commanded: dict[str, XmlElement], sink: DiagnosticSink
) -> None:
    """Report a joint that two systems command by one interface."""
    for each in component.iterchildren("command_interface"):
        key = f"{component.get('name')}/{each.get('name')}"
        other = commanded.setdefault(key, block)
        if other is not block:
            message = (
                f"the command interface {key!r} stands here twice: <ros2_control> {other.get('name')!r} has it already"
            )
            sink.report(rules.REPEATED_CONTROL, message, place_of(each), found=key, related=(place_of(other),))


def _report_interface(interface: XmlElement, sink: DiagnosticSink) -> None:
    name = interface.get("name") or ""
    near = nearest_name(name, INTERFACES, _TYPO) if name not in INTERFACES else None
    if near:
        message = (
            f"<{tag_of(interface)}> has the name {name!r}, which no controller asks for; ros2_control has {near!r}"
        )
        where = place_of(interface).at("@name")
        sink.report(rules.MISSPELLED_INTERFACE, message, where, found=name, help=f"did you mean {near!r}?")


def _report_class(element: XmlElement, sink: DiagnosticSink) -> None:
    name = text_of(element)
    near = nearest_name(name, _CLASSES, _CLASS_TYPO) if name not in _CLASSES and "/" in name else None
    if near:
        message = f"<{tag_of(element)}> is {name!r}, which ROS does not have; it has {near!r}"
        sink.report(rules.MISSPELLED_INTERFACE, message, place_of(element), found=name, help=f"did you mean {near!r}?")


def _report_joint(component: XmlElement, joint: Joint | None, sink: DiagnosticSink) -> None:
    if joint is not None:
        follows = joint.axis is not None and joint.axis.mimic is not None
        _report_mimic_parameter(component, joint, sink, follows=follows)
        _report_command(component, joint, sink, follows=follows)
    for interface in component.iterchildren(*_COMMANDS):
        _report_values(interface, joint, sink)


def _report_mimic_parameter(component: XmlElement, joint: Joint, sink: DiagnosticSink, *, follows: bool) -> None:
    mimic = next((each for each in component.iterchildren("param") if each.get("name") == "mimic"), None)
    if mimic is not None:
        leader = text_of(mimic)
        message = f"joint {joint.name!r} follows {leader!r} by <param name='mimic'>, which ros2_control reads no longer"
        instead = f"write <mimic joint={leader!r}/> into the <joint> of the robot"
        hint = "delete the parameter" if follows else instead
        sink.report(rules.MIMIC_PARAMETER, message, place_of(mimic), found="mimic", help=hint)


def _report_command(component: XmlElement, joint: Joint, sink: DiagnosticSink, *, follows: bool) -> None:
    """Report a command for a joint that cannot take it."""
    command = component.find("command_interface")
    if command is None:
        return
    if follows and component.get("mimic") != "false":
        message = (
            f"joint {joint.name!r} has a command interface and follows another by <mimic>: ros2_control refuses both"
        )
        hint = "delete the <command_interface>, or write mimic='false' on this <joint>"
        sink.report(rules.UNCOMMANDABLE_JOINT, message, place_of(command), found=joint.name, help=hint)
    elif joint.type == "fixed":
        message = f"joint {joint.name!r} is fixed and never moves, and has a command interface"
        sink.report(rules.UNCOMMANDABLE_JOINT, message, place_of(component), found=joint.name)


def _report_values(interface: XmlElement, joint: Joint | None, sink: DiagnosticSink) -> None:
    """Report parameters of an interface that are no numbers, or positions that the joint cannot reach."""
    numbers: dict[str, tuple[float, XmlElement]] = {}
    for name, param in _parameters(interface):
        value = number_of(param)
        if value is None:
            message = f"<param name={name!r}> is {text_of(param)!r}, and has to be a number"
            sink.report(
                rules.CONTROL_VALUE, message, place_of(param), found=text_of(param), expected="a number, such as 0.5"
            )
            return
        numbers[name] = (value, param)
    if "min" in numbers and "max" in numbers and numbers["min"][0] > numbers["max"][0]:
        least, most = numbers["min"][0], numbers["max"][0]
        message = f"the minimum of the {interface.get('name')} command, {least:g}, is above its maximum, {most:g}"
        sink.report(
            rules.CONTROL_VALUE, message, place_of(numbers["min"][1]), found=f"{least:g}", expected=f"at most {most:g}"
        )
    elif interface.get("name") == "position" and joint is not None and joint.type in {"revolute", "prismatic"}:
        for name, (value, param) in numbers.items():
            _report_reach(name, value, param, joint, sink)


def _report_reach(name: str, value: float, param: XmlElement, joint: Joint, sink: DiagnosticSink) -> None:
    limit = joint.axis.limit if joint.axis else None
    if limit is None or limit.lower is None or limit.upper is None or limit.lower >= limit.upper:
        return
    slack = _SLACK * max(abs(limit.lower), abs(limit.upper), 1.0)
    if not limit.lower - slack <= value <= limit.upper + slack:
        message = (
            f"<param name={name!r}> is {value:g}, and joint {joint.name!r} reaches {limit.lower:g} to {limit.upper:g}"
        )
        sink.report(
            rules.CONTROL_VALUE,
            message,
            place_of(param),
            found=f"{value:g}",
            expected=f"{limit.lower:g} to {limit.upper:g}",
        )


def _parameters(interface: XmlElement) -> Iterator[tuple[str, XmlElement]]:
    for param in interface.iterchildren("param"):
        name = param.get("name") or ""
        if name in {"min", "max", "initial_value"} and text_of(param) and "$" not in text_of(param):
            yield name, param
