"""Builds the ROS 2 package of one robot, and gives its sensors the frames that they lack."""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import ClassVar

from pydantic import Field

from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.gazebo_files import world_without_text
from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.controllers import controllers_in_gazebo, controllers_of
from twinform.compiler.packaging.gazebo_control import CONTROLLERS, ConnectControllers, has_gazebo_control
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Content, Package
from twinform.compiler.packaging.ros2_texts import PackageContents, generated_files
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Model, Sensor, rewrite
from twinform.lazy import lazy_pattern
from twinform.passes import Pipeline
from twinform.passes.framework.pass_base import Pass
from twinform.passes.joints.transmission import urdf_elements
from twinform.passes.plugins.add_elements import add_own_frame, frames_of, is_placed, own_frame_name, set_frame_id
from twinform.passes.plugins.bridge_config import bridges
from twinform.passes.plugins.catalog import release
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import PluginSite, map_sensors, sensors_of
from twinform.passes.plugins.world_systems import kind_of_sensor

_NAME = lazy_pattern(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
"""Names of packages (REP 144): lower case, digits, single underscores, a letter first."""
_WORLD = "default"
"""The name of the world of the package, which is a part of the names of topics."""
_PUBLISHER = "add the system that does with --passes add-plugin{system=joint-state-publisher}"
_FROM_TRANSMISSIONS = (
    "turn its transmissions of ROS 1 into what ROS 2 reads with --passes ros2-control-from-transmissions, "
    "or add a system with --passes add-plugin{system=joint-state-publisher}"
)
_JOINT_STATE = "sensor_msgs/msg/JointState"


def build(order: Order, collection: Collection) -> Built:
    """Build the package of a robot.

    Raises:
        CompileError: the model or a file of it has an error, or ROS does not take the name.
    """
    _check_name(order)
    collection.reserve(CONTROLLERS)
    sink = DiagnosticSink(order.source_name)
    conversion = _convert(order, collection)
    contents = _collect_contents(order, conversion, [*collection.files, *order.beside], sink)
    texts = generated_files(contents)
    # The robot is spawned in Gazebo from the URDF that robot_state_publisher publishes:
    # gz_ros2_control needs the description anyway, so tf and Gazebo have one source, and whoever
    # edits the URDF sees the change in both.
    texts[f"urdf/{order.name}.urdf"] = conversion.text
    texts[f"worlds/{order.name}.sdf"] = world_without_text(conversion.document, order.release, sink, _WORLD)
    files: dict[str, Content] = {path: text.encode() for path, text in texts.items()}
    ledgers = {f"urdf/{order.name}.urdf": conversion.ledger}
    found = dict.fromkeys((*conversion.diagnostics, *sink.diagnostics))
    return Built(Package(order.name, {**collection.files, **files}), tuple(found), ledgers)


def _convert(order: Order, collection: Collection) -> Conversion:
    connect = ConnectControllers.unchecked(package=order.name, release=order.release)
    frames = NameSensorFrames.unchecked(release=order.release)
    passes = Pipeline((*order.conversion.passes, connect, frames))
    ordered = replace(order, conversion=replace(order.conversion, passes=passes))
    return ordered.convert(collection, "urdf")


def _collect_contents(
    order: Order, conversion: Conversion, files: Sequence[str], sink: DiagnosticSink
) -> PackageContents:
    document = conversion.document
    controllers = controllers_of(document, sink, order.release)
    runs = has_gazebo_control(document, order.release, DiagnosticSink())
    contents = PackageContents(
        package=order.name,
        details=order.details,
        document=document,
        release=order.release,
        controllers=controllers,
        started=controllers_in_gazebo(controllers, document, order.release) if runs else (),
        bridges=bridges(document, order.release, sink, _WORLD),
        folders=sorted({path.partition("/")[0] for path in files if "/" in path}),
        files=sorted({path for path in files if "/" not in path}),
    )
    _check_joint_states(contents, sink)
    report_frames(document, order.release, sink)
    return contents


def _check_name(order: Order) -> None:
    name, sink = order.name, DiagnosticSink(order.source_name)
    if _NAME.fullmatch(name) and len(name) > 1:
        return
    suggested = "_".join(re.findall(r"[a-z0-9]+", name.lower())) or "robot"
    suggested = suggested if suggested[0].isalpha() else f"robot_{suggested}"
    suggested = suggested if len(suggested) > 1 else f"{suggested}_robot"
    takes = "two or more lower case letters, digits and single underscores"
    message = f"{name!r} is not a valid package name in ROS: use {takes}"
    sink.report(rules.PACKAGE_NAME, message, found=name, help=f"call it {suggested}")
    raise CompileError(tuple(sink.diagnostics))


def _check_joint_states(contents: PackageContents, sink: DiagnosticSink) -> None:
    told = contents.controlled or any(each.ros_type_name == _JOINT_STATE for each in contents.bridges)
    if contents.moves and not told:
        message = f"nothing tells ROS in Gazebo where the joints of {contents.model.name!r} are"
        old = any(urdf_elements(contents.model, contents.document.format, "transmission"))
        advice = _FROM_TRANSMISSIONS if old else _PUBLISHER
        sink.report(rules.NO_JOINT_STATES, message, contents.model.location, help=advice)


class NameSensorFrames(Pass):
    """Give each sensor that names no frame the one of its link, or a frame where it is.

    Changes: sensors on links that Gazebo simulates; the model gets a frame, in URDF a link, for those with a pose of
    their own, and for cameras one that looks along z as images of ROS do.
    Never touches: frames that a sensor names, and sensors on joints.
    """

    name: ClassVar[str] = "name-sensor-frames"

    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that runs the model.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """Return the document with frames for all sensors on links."""
        added: dict[str, list[tuple[str, Sensor, str, str]]] = defaultdict(list)
        often = Counter(sensor.name for sensor, _ in sensors_of(document))

        def change(sensor: Sensor, site: PluginSite) -> Iterable[Sensor]:
            kind = kind_of_sensor(sensor, self.release)
            link = site.link_or_joint
            if kind is None or site.scope != "link" or link is None or site.model is None or any(frames_of(sensor)):
                return (sensor,)
            own = own_frame_name(site.model, sensor, kind.type)
            if own is not None:
                own = f"{link}_{own}" if often[sensor.name] > 1 else own
                added[site.model.name].append((own, sensor, kind.type, link))
            return (set_frame_id(sensor, own or link, self.release),)

        def with_frames(model: Model) -> Model:
            for own, sensor, type_, link in added.get(model.name, ()):
                model = add_own_frame(model, own, sensor, type_, link, document.format)
            return model

        named = map_sensors(document, change)
        return rewrite(named, Model, with_frames) if added else named


def report_frames(document: Document, gazebo: str, sink: DiagnosticSink) -> None:
    """Report simulated sensors that name no frame, or the frame of their link although they are elsewhere on it."""
    for sensor, site in sensors_of(document):
        if kind_of_sensor(sensor, gazebo) is None or site.model is None:
            continue
        named = list(frames_of(sensor))
        if not named:
            _report_nameless(sensor, site, gazebo, sink)
        elif site.scope == "link" and site.link_or_joint in named and is_placed(sensor):
            message = f"messages of sensor {sensor.name!r} are in the frame of link {site.link_or_joint!r}, "
            message += "and the sensor has a pose of its own on it"
            help_ = "leave the frame out, and the package has a link where the sensor is"
            sink.report(rules.FRAME_ELSEWHERE, message, sensor.location, found=site.link_or_joint, help=help_)


def _report_nameless(sensor: Sensor, site: PluginSite, gazebo: str, sink: DiagnosticSink) -> None:
    model = site.model.name if site.model else None
    frame = "/".join(filter(None, (model, site.link_or_joint, sensor.name)))
    message = f"messages of sensor {sensor.name!r} are in the frame {frame!r}, which tf does not have"
    element = release(gazebo).frame_element
    help_ = f"write the link that it measures in into it: <{element}>LINK</{element}>"
    sink.report(rules.FRAME_NOT_IN_TF, message, sensor.location, found=frame, help=help_)
