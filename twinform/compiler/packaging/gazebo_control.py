"""The `<ros2_control>` systems of a model, and Gazebo's plugin for them, which reads the controllers of the package."""

from collections.abc import Iterable, Iterator
from typing import ClassVar

from pydantic import Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Element, Format, GazeboExtension, Model, Plugin, rewrite
from twinform.passes.framework.pass_base import Pass
from twinform.passes.joints.transmission import location_of, urdf_elements
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import PluginSite, map_plugins, plugins_of


@dataclass(frozen=True, slots=True)
class Component:
    """A joint, sensor or GPIO with the names of its interfaces and its own parameters.

    A joint that is `alone` moves by its own commands, even if it has a mimic.
    """

    name: str
    commands: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    parameters: tuple[tuple[str, str], ...] = ()
    alone: bool = False

    def parameter(self, name: str) -> str | None:
        """Return the value of a parameter."""
        return dict(self.parameters).get(name)


@dataclass(frozen=True, slots=True)
class System:
    """A `<ros2_control>` element: `kind` is its type, and `hardware` the class of the plugin that drives it."""

    name: str
    kind: str
    hardware: str
    location: Location
    joints: tuple[Component, ...] = ()
    sensors: tuple[Component, ...] = ()
    gpios: tuple[Component, ...] = ()

    def parts(self) -> frozenset[str]:
        """Return the names of its joints and sensors."""
        return frozenset(each.name for each in (*self.joints, *self.sensors))


def systems_of(model: Model, format_: Format) -> tuple[System, ...]:
    """Return the `<ros2_control>` systems of a model."""
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
                parameters=tuple((child.get("name") or "", child.text or "") for child in each.find_all("param")),
                alone=(each.get("mimic") or "").strip().lower() == "false",
            )


def _names(element: Element, kind: str) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for each in element.find_all(kind) if (name := each.get("name"))))


CONTROLLERS = "config/controllers.yaml"
"""The file of the package that the plugin reads."""
_FORTRESS = "fortress"
_PARAMETERS = "parameters"
_CLASSES = ("::GazeboSimROS2ControlPlugin", "::IgnitionROS2ControlPlugin")
_HARDWARE = ("gz_ros2_control/GazeboSimSystem", "ign_ros2_control/IgnitionSystem")
_OLD, _NEW = "ign_ros2_control", "gz_ros2_control"


def control_package(release: str) -> str:
    """Return the ROS package with Gazebo's plugin for ros2_control."""
    return _OLD if release == _FORTRESS else _NEW


def runs_in_gazebo(system: System, release: str) -> bool:
    """Whether a release of Gazebo loads the hardware of a system; later releases know the old name too."""
    package = system.hardware.partition("/")[0]
    return package == _OLD or (package == _NEW and release != _FORTRESS)


def controllers_uri(package: str) -> str:
    """Return the URI that stands for the path of the controllers' file until the launch file replaces it."""
    # gz_ros2_control wants the file's path, which is known only after the installation. Other
    # packages write a xacro with $(find ...) for that; then a name with ${...} in it would run, and
    # what reads no xacro cannot read the robot. So the URDF stays a URDF, and two lines of the
    # launch file put the path here.
    return f"package://{package}/{CONTROLLERS}"


class ConnectControllers(Pass):
    """Have Gazebo run the controllers of the package, where the model has a `<ros2_control>` for Gazebo.

    Changes: the plugin of gz_ros2_control, which is added where there is none, and the file that it names.
    Never touches: `<ros2_control>` itself.
    Diagnostics: `foreign-hardware`, `replaced-controllers-file`.
    """

    name: ClassVar[str] = "connect-controllers"

    package: str = Field(description="The name of the package.")
    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that runs the model.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """Return the document with the plugin."""
        if not has_gazebo_control(document, self.release, sink):
            return document
        if any(_is_control(plugin) for plugin, _ in plugins_of(document)):
            return map_plugins(document, lambda plugin, site: self._with_file(plugin, site, sink))
        return rewrite(document, Model, lambda model: self._with_plugin(model, document.format))

    def _with_file(self, plugin: Plugin, site: PluginSite, sink: DiagnosticSink) -> Iterable[Plugin]:
        if not _is_control(plugin):
            return (plugin,)
        wanted = controllers_uri(self.package)
        for each in plugin.content:
            if each.name == _PARAMETERS and each.text != wanted:
                message = f"the controllers' file {each.text!r} gives way to config/controllers.yaml of the package"
                sink.report(rules.REPLACED_CONTROLLERS_FILE, message, plugin.location, found=each.text)
        rest = tuple(each for each in plugin.content if each.name != _PARAMETERS)
        return (plugin.copy(content=(self._parameters(), *rest)),)

    def _with_plugin(self, model: Model, format_: Format) -> Model:
        if not any(runs_in_gazebo(system, self.release) for system in systems_of(model, format_)):
            return model
        package = control_package(self.release)
        class_ = f"{package}{_CLASSES[self.release == _FORTRESS]}"
        plugin = Plugin(name=class_, filename=f"{package}-system", content=(self._parameters(),))
        if format_ is Format.SDF:
            return model.copy(plugins=(*model.plugins, plugin))
        attributes = (("filename", plugin.filename or ""), ("name", class_))
        element = Element(name="plugin", attributes=attributes, children=plugin.content)
        return model.copy(extensions=(*model.extensions, GazeboExtension(content=(element,))))

    def _parameters(self) -> Element:
        return Element(name=_PARAMETERS, text=controllers_uri(self.package))


def has_gazebo_control(document: Document, release: str, sink: DiagnosticSink) -> bool:
    """Whether a document has a `<ros2_control>` for Gazebo; systems with other hardware are reported."""
    systems = [system for model in document.models for system in systems_of(model, document.format)]
    for system in systems:
        if not runs_in_gazebo(system, release):
            message = f"ros2_control {system.name!r} has {system.hardware!r}, which Gazebo {release} does not load"
            advice = f"for Gazebo, write {_HARDWARE[release == _FORTRESS]}"
            sink.report(rules.FOREIGN_HARDWARE, message, system.location, found=system.hardware, help=advice)
    return any(runs_in_gazebo(system, release) for system in systems)


def _is_control(plugin: Plugin) -> bool:
    return (plugin.name or "").endswith(_CLASSES)
