"""Elements of `<ros2_control>`: a system with its hardware, its joints, and their interfaces."""

from abc import abstractmethod
from collections.abc import Iterable

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Element, Format, Model, rewrite
from twinform.passes.carriers.carriers import declare_carriers
from twinform.passes.framework.pass_base import Pass
from twinform.passes.joints.transmission import STATES, urdf_elements
from twinform.passes.shared.nodes import unique_name

GAZEBO = "gz_ros2_control/GazeboSimSystem"
"""The plugin of gz_ros2_control."""
_SYSTEM = "ros2_control"


class ConvertDrives(Pass):
    """The base of passes that say in other elements of URDF what drives the joints of a model."""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other elements in each model that has something to make them of."""
        changed = rewrite(document, Model, lambda model: self.convert(model, document.format, sink))
        return document if changed is document else declare_carriers(changed)

    @abstractmethod
    def convert(self, model: Model, format_: Format, sink: DiagnosticSink) -> Model:
        """One model with other elements."""


class MakeRos2Control(ConvertDrives):
    """The base of passes that make one `<ros2_control>` system of what drives the joints of a model."""

    hardware: str = Field(
        default=GAZEBO,
        min_length=1,
        description="The plugin behind the joints: `mock_components/GenericSystem`, "
        "`mujoco_ros2_control/MujocoSystemInterface` or a driver.",
    )
    system: str | None = Field(
        default=None, min_length=1, description="The name of the system; else that of the model with `_system` behind."
    )


def controlled_joints(model: Model, format_: Format) -> dict[str, str]:
    """Return the joints that are in a system already, each with the name of the system."""
    return {
        child.get("name") or "": system.get("name") or ""
        for _, system in urdf_elements(model, format_, _SYSTEM)
        for child in system.children
        if child.name == "joint"
    }


def system_element(model: Model, format_: Format, name: str | None, plugin: str, parts: Iterable[Element]) -> Element:
    """Return a system with a plugin as its hardware; without a name it has that of the model with `_system` behind."""
    taken = {element.get("name") or "" for _, element in urdf_elements(model, format_, _SYSTEM)}
    made = unique_name(name or f"{model.name}_system", taken)
    hardware = Element(name="hardware", children=(Element(name="plugin", text=plugin),))
    return Element(name=_SYSTEM, attributes=(("name", made), ("type", "system")), children=(hardware, *parts))


def joint_element(name: str, commands: Iterable[Element]) -> Element:
    """Return a joint of a system with its commands and all states."""
    # JointStateHandle of ros_control tells all three for every joint, so controllers that were
    # written for it expect all three.
    states = (Element(name="state_interface", attributes=(("name", each),)) for each in STATES)
    return Element(name="joint", attributes=(("name", name),), children=(*commands, *states))


def command_element(name: str, ends: Iterable[tuple[str, str]] = ()) -> Element:
    """Return a command interface; `ends` are its parameters `min` and `max`, where it has any."""
    parameters = (Element(name="param", attributes=(("name", key),), text=text) for key, text in ends)
    return Element(name="command_interface", attributes=(("name", name),), children=tuple(parameters))
