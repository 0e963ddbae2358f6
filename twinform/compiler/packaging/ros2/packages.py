"""Builds the ROS 2 package of one robot."""

import re
from collections.abc import Sequence
from dataclasses import replace

from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.gazebo_files import world_without_text
from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.order import Built, Order
from twinform.compiler.packaging.package import Content, Package
from twinform.compiler.packaging.ros2.contents import PackageContents
from twinform.compiler.packaging.ros2.controllers import controllers_in_gazebo, controllers_of
from twinform.compiler.packaging.ros2.gazebo_control import CONTROLLERS, ConnectControllers, has_gazebo_control
from twinform.compiler.packaging.ros2.sensor_frames import NameSensorFrames, report_frames
from twinform.compiler.packaging.ros2.texts import generated_files
from twinform.diagnostics import DiagnosticSink, rules
from twinform.passes import Pipeline
from twinform.passes.control.carried_elements import urdf_elements
from twinform.passes.plugins.bridge import bridges

_NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
"""Names of packages (REP 144): lower case, digits, single underscores, a letter first."""
_WORLD = "default"
"""What the world of the package is called; names of topics contain it."""
_PUBLISHER = "add the system that does with --passes add-plugin{system=joint-state-publisher}"
_FROM_TRANSMISSIONS = (
    "turn its transmissions of ROS 1 into what ROS 2 reads with --passes ros2-control-from-transmissions, "
    "or add a system with --passes add-plugin{system=joint-state-publisher}"
)
_JOINT_STATE = "sensor_msgs/msg/JointState"


def build(order: Order, collection: Collection) -> Built:
    """The package of a robot.

    Raises:
        CompileError: the model or a file of it has an error, or ROS does not take the name.
    """
    _check_name(order)
    collection.reserve(CONTROLLERS)
    sink = DiagnosticSink(order.source_name)
    conversion = _converted(order, collection)
    contents = _contents(order, conversion, [*collection.files, *order.beside], sink)
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


def _converted(order: Order, collection: Collection) -> Conversion:
    connect = ConnectControllers.unchecked(package=order.name, release=order.release)
    frames = NameSensorFrames.unchecked(release=order.release)
    passes = Pipeline((*order.conversion.passes, connect, frames))
    ordered = replace(order, conversion=replace(order.conversion, passes=passes))
    return ordered.convert(collection, "urdf")


def _contents(order: Order, conversion: Conversion, files: Sequence[str], sink: DiagnosticSink) -> PackageContents:
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
