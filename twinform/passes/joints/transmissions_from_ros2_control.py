"""Convert `<ros2_control>` to transmissions of ROS 1."""

from collections.abc import Iterable, Iterator
from dataclasses import replace as changed
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Element, Format, Model, Opaque
from twinform.passes.joints.ros2_control import ConvertDrives
from twinform.passes.joints.transmission import (
    CLASSES,
    PLUGINS,
    SIMPLE,
    STATE_CLASS,
    End,
    Transmission,
    as_parts,
    location_of,
    read_transmission,
    replace_parts,
    urdf_elements,
    write_ros1_transmission,
)
from twinform.passes.shared.nodes import unique_name

_EXPRESSED = frozenset({"hardware", "joint", "transmission"})


class TransmissionsFromRos2Control(ConvertDrives):
    """Turn the joints of `<ros2_control>` into transmissions of ROS 1.

    Changes models with `<ros2_control>` elements, nested models and those of worlds too; a model of SDF has them in
    carriers, and so stands what is made of them:

    1. every transmission in a system becomes one of ROS 1, with the `hardwareInterface` of each joint that its command
       interfaces stand for; the reduction of a simple one moves from the joint to the actuator;
    2. a joint that is in no transmission gets a simple one, with an actuator of its own;
    3. a joint without command interfaces has `JointStateInterface`;
    4. a joint that has a transmission of ROS 1 beside its system keeps that one.

    Never touches: sensors and inputs and outputs (`gpio`): a system that has some stays, without its joints. What ROS
    1 has no syntax for (the hardware plugin and its parameters, limits and parameters of joints, other interfaces) is
    reported and, where the element goes, dropped.
    Diagnostics: `converted-ros2-control`, `unsayable-in-transmissions` and `foreign-transmission`; each system has an
    entry of the ledger, *approximated*, and each part that ROS 1 lacks one, *dropped*.
    """

    name = "transmissions-from-ros2-control"
    example: ClassVar[str] = "transmissions-from-ros2-control{keep=true}"

    keep: bool = Field(default=False, description="Whether `<ros2_control>` stays as well, for programs of ROS 2.")

    def convert(self, model: Model, format_: Format, sink: DiagnosticSink) -> Model:
        """One model with transmissions in place of its systems."""
        there = [element for _, element in urdf_elements(model, format_, "transmission")]
        names = {element.get("name") or "" for element in there}
        driven = {end.name for element in there for end in read_transmission(element).joints}
        result = model
        for part, system in list(urdf_elements(model, format_, "ros2_control")):
            if not any(child.name == "joint" for child in system.children):
                _report_inexpressible(model, part, system, sink, stays=True)
                continue
            missing = [each for each in _read_system(system) if not driven.issuperset(end.name for end in each.joints)]
            made = list(_name_uniquely(missing, names))
            _report_converted(model, part, system, made, sink, stays=self.keep)
            rest = () if self.keep else _rest_of_system(system)
            new = as_parts([*map(write_ros1_transmission, made), *rest], format_)
            result = replace_parts(result, () if self.keep else (part,), new, after=part)
        return result


def _read_system(system: Element) -> Iterator[Transmission]:
    interfaces = {joint.get("name") or "": _interface_classes(joint) for joint in system.find_all("joint")}
    done: set[str] = set()
    for element in system.children:
        if element.name == "transmission":
            read = read_transmission(element)
            done |= {end.name for end in read.joints}
            joints = tuple(changed(end, interfaces=interfaces.get(end.name, ())) for end in read.joints)
            yield changed(read, joints=joints)
    for name, classes in interfaces.items():
        if name not in done:
            actuators = (End(f"{name}_motor", reduction="1"),)
            yield Transmission(f"{name}_transmission", SIMPLE, (End(name, interfaces=classes),), actuators)


def _name_uniquely(transmissions: Iterable[Transmission], taken: set[str]) -> Iterator[Transmission]:
    for each in transmissions:
        name = unique_name(each.name, taken)
        taken.add(name)
        yield changed(each, name=name)


def _interface_classes(joint: Element) -> tuple[str, ...]:
    """The classes of ros_control for the commands of a joint; a joint without commands has the class for states."""
    commands = [each.get("name") or "" for each in joint.find_all("command_interface")]
    return tuple(CLASSES[name] for name in commands if name in CLASSES) or (STATE_CLASS,)


def _rest_of_system(system: Element) -> tuple[Element, ...]:
    """The parts of a system that did not become transmissions; nothing if only its hardware is left."""
    left = tuple(child for child in system.children if child.name not in {"joint", "transmission"})
    return (system.copy(children=left),) if any(child.name != "hardware" for child in left) else ()


def _report_converted(
    model: Model, part: Opaque, system: Element, made: list[Transmission], sink: DiagnosticSink, *, stays: bool
) -> None:
    where, name = location_of(part, model), system.get("name")
    message = f"the joints of ros2_control {name!r} are in {len(made)} transmissions"
    sink.report(rules.CONVERTED_ROS2_CONTROL, message, where, found=name)
    for each in made:
        if each.type not in PLUGINS:
            message = f"transmission {each.name!r} has the type {each.type!r}, which only another package can provide"
            sink.report(rules.FOREIGN_TRANSMISSION, message, where, found=each.type)
    if not stays:
        sink.account(Fate.APPROXIMATED, rules.CONVERTED_ROS2_CONTROL, message, where, system.weight)
    _report_inexpressible(model, part, system, sink, stays=stays)


def _report_inexpressible(model: Model, part: Opaque, system: Element, sink: DiagnosticSink, *, stays: bool) -> None:
    where = location_of(part, model)
    for what, lost in _inexpressible_parts(system):
        end = " and is left out" if lost and not stays else ", so it is left unchanged" if not lost else ""
        message = f"{what} of ros2_control {system.get('name')!r} has no equivalent in ROS 1{end}"
        sink.report(rules.UNSAYABLE_IN_TRANSMISSIONS, message, where, found=what)
        if lost and not stays:
            sink.account(Fate.DROPPED, rules.UNSAYABLE_IN_TRANSMISSIONS, message, where, 0)


def _inexpressible_parts(system: Element) -> Iterator[tuple[str, bool]]:
    """What ROS 1 cannot express, and whether it is lost with the element."""
    goes = not _rest_of_system(system)
    for child in system.children:
        if child.name == "hardware":
            yield f"the hardware {_plugin_name(child)!r}", goes
        elif child.name not in _EXPRESSED:
            yield f"<{child.name}> {child.get('name')!r}", False
        elif child.name == "joint":
            yield from ((each, True) for each in _inexpressible_in_joint(child))


def _inexpressible_in_joint(joint: Element) -> Iterator[str]:
    for child in joint.children:
        of = f"of joint {joint.get('name')!r}"
        if child.name in {"param", "limits"}:
            yield f"<{child.name}> {child.get('name') or ''} {of}".replace("  ", " ")
        elif child.name == "command_interface" and child.get("name") not in CLASSES:
            yield f"the interface {child.get('name')!r} {of}"
        elif child.children:
            yield f"<{child.children[0].name}> in the interface {child.get('name')!r} {of}"


def _plugin_name(hardware: Element) -> str:
    plugin = hardware.find("plugin")
    return (plugin.text if plugin is not None else None) or ""
