"""The configuration of RViz: the robot, its frames, and what its sensors publish."""

from collections.abc import Iterable, Mapping, Sequence

from twinform.compiler.packaging.ros2.contents import PackageContents
from twinform.passes.plugins.bridge import Bridge
from twinform.passes.plugins.ground_clearance import base_link
from twinform.passes.plugins.yaml_text import Value, yaml_text

_PLUGINS = "rviz_default_plugins"
_SHOWN: Mapping[str, str] = {
    "sensor_msgs/msg/Image": "Image",
    "sensor_msgs/msg/LaserScan": "LaserScan",
    "sensor_msgs/msg/PointCloud2": "PointCloud2",
    "nav_msgs/msg/Odometry": "Odometry",
    "sensor_msgs/msg/Range": "Range",
    "geometry_msgs/msg/WrenchStamped": "Wrench",
}
"""What shows a message, of the plugins that RViz comes with; it has none for an IMU."""
_TOOLS = ("Interact", "MoveCamera", "Select", "FocusCamera", "Measure")


def rviz_config(contents: PackageContents) -> str:
    """The file for one robot, seen from its root link."""
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
