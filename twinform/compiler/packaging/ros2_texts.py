"""The generated files of a ROS 2 package: package.xml, CMake, launch files, RViz, controllers and bridge."""

import re
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources
from xml.sax.saxutils import escape, quoteattr

from twinform.compiler.packaging.controllers import Controller, controllers_yaml
from twinform.compiler.packaging.gazebo_control import CONTROLLERS, control_package
from twinform.compiler.packaging.order import PackageDetails
from twinform.dataclass import dataclass
from twinform.ir import Document, Model, Plugin
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.bridge_config import TRANSFORMS, Bridge, bridge_yaml
from twinform.passes.plugins.topics import topics_of
from twinform.passes.plugins.wheels import base_link, lowest_point
from twinform.passes.plugins.yaml_text import Value, yaml_text

_FIXED = frozenset({"fixed", "floating", "planar"})
"""The types of joints that joint states do not move."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageContents:
    """What the generated files of a package are made from: the robot in URDF, the package's name and details, and more.

    `started` are the controllers that Gazebo runs. `folders` are those of files that are not generated, and `files` are
    such files that lie beside `package.xml`.
    """

    package: str
    details: PackageDetails
    document: Document
    release: str
    controllers: Sequence[Controller] = ()
    started: Sequence[Controller] = ()
    bridges: Sequence[Bridge] = ()
    folders: Sequence[str] = ()
    files: Sequence[str] = ()

    @property
    def model(self) -> Model:
        """The robot."""
        return self.document.models[0]

    @property
    def odometry_frame(self) -> str | None:
        """The frame of `/tf` in which a drive or a controller says where the robot is; None if none names it."""
        led = (str(each.parameters.get("odom_frame_id", "")) for each in self.started)
        driven = (
            element.text
            for topic in topics_of(self.document, self.release)
            if topic.message == TRANSFORMS and isinstance(topic.source, Plugin)
            for element in topic.source.content
            if element.name in _ODOMETRY_FRAMES
        )
        return next(filter(None, (*led, *driven)), None)

    @property
    def controlled(self) -> bool:
        """Whether Gazebo runs controllers."""
        return bool(self.started)

    @property
    def moves(self) -> bool:
        """Whether the robot has joints that move."""
        return any(joint.type not in _FIXED for joint in self.model.joints)


_LAUNCH = (
    "ament_index_python",
    "launch",
    "launch_ros",
    "robot_state_publisher",
    "rviz2",
    "ros_gz_bridge",
    "ros_gz_sim",
)
_SLIDERS = ("joint_state_publisher", "joint_state_publisher_gui")
_ODOMETRY_FRAMES = frozenset({"frame_id", "odom_frame"})
_HOOKS = ("gazebo_resource_path.dsv.in", "gazebo_resource_path.sh.in")
_WORLD = "world"


def generated_files(contents: PackageContents) -> dict[str, str]:
    """Return the generated files: all but the URDF, the world, and meshes with their textures."""
    name = contents.package
    files = {
        "package.xml": package_xml(contents, _run_dependencies(contents)),
        "launch/display.launch.py": _launch_file(contents, "display.launch.py.in"),
        "launch/gazebo.launch.py": _launch_file(contents, "gazebo.launch.py.in"),
        f"rviz/{name}.rviz": rviz_config(contents),
        "config/bridge.yaml": bridge_yaml(contents.bridges),
    }
    if contents.controllers:
        files[CONTROLLERS] = controllers_yaml(contents.controllers)
    variable = "IGN_GAZEBO_RESOURCE_PATH" if contents.release == "fortress" else "GZ_SIM_RESOURCE_PATH"
    files |= {f"env-hooks/{each}": render(each, {"variable": variable}, {}) for each in _HOOKS}
    return {**files, "CMakeLists.txt": _cmake_file(contents, files)}


def _run_dependencies(contents: PackageContents) -> list[str]:
    found = [*_LAUNCH, *(_SLIDERS if contents.moves else ()), *(each.package for each in contents.controllers)]
    if contents.controlled:
        found += ["controller_manager", control_package(contents.release)]
    return found


def _cmake_file(contents: PackageContents, files: dict[str, str]) -> str:
    folders = {path.partition("/")[0] for path in files if "/" in path} - {"env-hooks"}
    folders |= {"urdf", "worlds", *contents.folders}
    values = {
        "package": contents.package,
        "folders": " ".join(map(cmake_text, sorted(folders))),
        "files": " ".join(map(cmake_text, contents.files)),
    }
    return render("CMakeLists.txt.in", values, {"files": bool(contents.files)})


def _launch_file(contents: PackageContents, template: str) -> str:
    values = {
        "package": contents.package,
        "robot": python_text(contents.model.name),
        "height": f"{_spawn_height(contents):g}",
        "odometry": python_text(contents.odometry_frame or ""),
        "controllers": "\n".join(f"    {python_text(each.name)}," for each in contents.started),
    }
    moves, controlled = contents.moves, contents.controlled
    facts = {"moves": moves, "rigid": not moves, "controlled": controlled, "uncontrolled": not controlled}
    facts |= {"odometry": bool(contents.odometry_frame)}
    return render(template, values, facts)


def _spawn_height(contents: PackageContents) -> float:
    """Return the height of the root link at which the robot stands on the ground; 0 if it is fixed to the world."""
    model = contents.model
    if any(link.name == _WORLD for link in model.links):
        return 0.0
    depth = lowest_point(model)
    return round(-depth, 9) if depth else 0.0


_SCHEMA = "http://download.ros.org/schema/package_format3.xsd"
_FORBIDDEN = lazy_pattern(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML cannot have, in any notation."""


def package_xml(contents: PackageContents, depends: Iterable[str]) -> str:
    """Write `package.xml`, format 3 (REP 149), with these packages as dependencies at run time."""
    details = contents.details
    lines = [
        '<?xml version="1.0"?>',
        f'<?xml-model href="{_SCHEMA}" schematypens="http://www.w3.org/2001/XMLSchema"?>',
        '<package format="3">',
        f"  <name>{_xml_text(contents.package)}</name>",
        f"  <version>{_xml_text(details.version)}</version>",
        f"  <description>{_xml_text(details.description)}</description>",
        f"  <maintainer email={quoteattr(_xml_plain(details.email))}>{_xml_text(details.maintainer)}</maintainer>",
        f"  <license>{_xml_text(details.license)}</license>",
        *([f"  <author>{_xml_text(details.author)}</author>"] if details.author else []),
        "",
        "  <buildtool_depend>ament_cmake</buildtool_depend>",
        "",
        *(f"  <exec_depend>{_xml_text(each)}</exec_depend>" for each in sorted(set(depends))),
        "",
        "  <export>",
        "    <build_type>ament_cmake</build_type>",
        "  </export>",
        "</package>",
    ]
    return "\n".join(lines) + "\n"


def _xml_text(text: str) -> str:
    return escape(_xml_plain(text))


def _xml_plain(text: str) -> str:
    """Return a text on one line, without characters that XML cannot have."""
    return " ".join(_FORBIDDEN.sub("", text).split())


# Templates read as what they become. A template engine would be a dependency of everybody for forty
# marked lines.
_PLACE = lazy_pattern(r"\{\{(\w+)\}\}")
_PLAIN = lazy_pattern(r"[A-Za-z0-9_./-]+")
_CONDITION = lazy_pattern(r"  #\? (\w+)$")


def render(template: str, values: Mapping[str, str], facts: Mapping[str, bool]) -> str:
    """Fill a template with values for its `{{NAMES}}`; a line that ends in `#? FACT` is kept only where that is true.

    Values are not looked at again, so they may be any text.
    """
    text = (resources.files("twinform.compiler.packaging") / "templates" / template).read_text(encoding="utf-8")
    kept: list[str] = []
    for line in text.splitlines():
        condition = _CONDITION.search(line)
        if condition is None or facts[condition[1]]:
            kept.append(_PLACE.sub(lambda found: values[found[1]], _CONDITION.sub("", line)))
    return "\n".join(kept) + "\n"


def python_text(text: str) -> str:
    """Return a text as a literal of Python, in single quotes wherever that needs no more escapes."""
    # Single quotes and 99 columns, as ament's linters want generated Python.
    return ascii(text)


def cmake_text(text: str) -> str:
    """Return a text as an argument of CMake, in quotes where it needs them."""
    return text if _PLAIN.fullmatch(text) else '"' + re.sub(r'([\\"$@])', r"\\\1", text) + '"'


_PLUGINS = "rviz_default_plugins"
_SHOWN: Mapping[str, str] = {
    "sensor_msgs/msg/Image": "Image",
    "sensor_msgs/msg/LaserScan": "LaserScan",
    "sensor_msgs/msg/PointCloud2": "PointCloud2",
    "nav_msgs/msg/Odometry": "Odometry",
    "sensor_msgs/msg/Range": "Range",
    "geometry_msgs/msg/WrenchStamped": "Wrench",
}
"""The display for a message, of the plugins that come with RViz; it has none for an IMU."""
_TOOLS = ("Interact", "MoveCamera", "Select", "FocusCamera", "Measure")


def rviz_config(contents: PackageContents) -> str:
    """Write the configuration of RViz for one robot, seen from its root link."""
    fixed = base_link(contents.model, contents.document.format)
    panels = ("Displays", "Tool Properties", "Views", "Time")
    return yaml_text({
        "Panels": [{"Class": f"rviz_common/{each}", "Name": each} for each in panels],
        "Visualization Manager": {
            "Class": "",
            "Displays": list(_displays(contents.bridges)),
            "Enabled": True,
            "Global Options": {"Background Color": "48; 48; 48", "Fixed Frame": fixed, "Frame Rate": 30},
            "Name": "root",
            "Tools": [{"Class": f"{_PLUGINS}/{each}"} for each in _TOOLS],
            "Value": True,
            "Views": {
                "Current": {
                    "Class": f"{_PLUGINS}/Orbit",
                    "Distance": 3.0,
                    "Name": "Current View",
                    "Pitch": 0.5,
                    "Target Frame": fixed,
                    "Value": "Orbit (rviz_default_plugins)",
                    "Yaw": 0.8,
                },
            },
        },
        "Window Geometry": {"Height": 800, "Width": 1200},
    })  # fmt: skip


def _displays(bridges: Sequence[Bridge]) -> Iterable[Mapping[str, Value]]:
    yield _display("Grid", "Grid", {"Cell Size": 1, "Plane Cell Count": 10, "Reference Frame": "<Fixed Frame>"})
    source = {"Description Source": "Topic", "Description Topic": _topic("/robot_description", latched=True)}
    yield _display("RobotModel", "RobotModel", {**source, "Visual Enabled": True, "Collision Enabled": False})
    yield _display("TF", "TF", {"Frame Timeout": 15, "Marker Scale": 0.3, "Show Axes": True, "Show Names": False})
    for bridge in bridges:
        kind = _SHOWN.get(bridge.ros_type_name)
        if kind and bridge.direction == "GZ_TO_ROS":
            topic = f"/{bridge.ros_topic_name.lstrip('/')}"
            yield _display(kind, topic.lstrip("/"), {"Topic": _topic(topic)})


def _display(kind: str, name: str, rest: Mapping[str, Value]) -> dict[str, Value]:
    return {"Class": f"{_PLUGINS}/{kind}", "Enabled": True, "Name": name, **rest, "Value": True}


def _topic(name: str, *, latched: bool = False) -> dict[str, Value]:
    return {
        "Depth": 5,
        "Durability Policy": "Transient Local" if latched else "Volatile",
        "History Policy": "Keep Last",
        "Reliability Policy": "Reliable",
        "Value": name,
    }
