"""What the `<ros2_control>` elements of a model say: hardware, joints and sensors with their interfaces."""

from collections.abc import Iterator
from dataclasses import dataclass

from twinform.diagnostics import Location
from twinform.ir import Element, Format, Model
from twinform.passes.control.carried_elements import location_of, urdf_elements


@dataclass(frozen=True, slots=True)
class Component:
    """A joint, sensor or GPIO with the names of its interfaces; `parameters` are its own.

    `alone`: it moves by its own commands, whatever its joint mimics.
    """

    name: str
    commands: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()
    alone: bool = False

    def parameter(self, name: str) -> str | None:
        """The value of a parameter."""
        return dict(self.parameters).get(name)


@dataclass(frozen=True, slots=True)
class System:
    """One `<ros2_control>`: `kind` is its type, `hardware` the class of the plugin that drives it."""

    name: str
    kind: str
    hardware: str
    location: Location
    joints: tuple[Component, ...] = ()
    sensors: tuple[Component, ...] = ()
    gpios: tuple[Component, ...] = ()

    def parts(self) -> frozenset[str]:
        """The names of its joints and sensors."""
        return frozenset(each.name for each in (*self.joints, *self.sensors))


def systems_of(model: Model, format_: Format) -> tuple[System, ...]:
    """The systems of a model, in their order."""
    return tuple(
        _system(element, location_of(part, model)) for part, element in urdf_elements(model, format_, "ros2_control")
    )


def _system(element: Element, location: Location) -> System:
    hardware = element.find("hardware")
    plugin = hardware.find("plugin") if hardware else None
    return System(
        name=element.get("name") or "",
        kind=element.get("type") or "",
        hardware=((plugin.text if plugin else None) or "").strip(),
        location=location,
        joints=tuple(_components(element, "joint")),
        sensors=tuple(_components(element, "sensor")),
        gpios=tuple(_components(element, "gpio")),
    )


def _components(system: Element, kind: str) -> Iterator[Component]:
    for each in system.children:
        if each.name == kind:
            yield Component(
                name=each.get("name") or "",
                commands=_names(each, "command_interface"),
                states=_names(each, "state_interface"),
                parameters=tuple((child.get("name") or "", child.text or "") for child in _all(each, "param")),
                alone=(each.get("mimic") or "").strip().lower() == "false",
            )


def _names(element: Element, kind: str) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for each in _all(element, kind) if (name := each.get("name"))))


def _all(element: Element, name: str) -> Iterator[Element]:
    return (child for child in element.children if child.name == name)
