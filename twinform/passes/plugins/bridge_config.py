"""Write the configuration of ros_gz_bridge, as a file beside the result: which topics of Gazebo map to which of ROS."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Annotated, ClassVar

from pydantic import AfterValidator, Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir import Document, Format
from twinform.lazy import lazy_pattern
from twinform.passes.framework.side_files import CompanionPath, SideFilePass
from twinform.passes.plugins.catalog import ros_message
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.topics import Topic, topics_of
from twinform.passes.plugins.yaml_text import quote


def _check_yaml_name(path: str) -> str:
    if not path.endswith((".yaml", ".yml")):
        raise ValueError("takes the name of a YAML file, which ends in .yaml or .yml")
    return path


class BridgeConfig(SideFilePass):
    """Write the YAML file that ros_gz_bridge needs to carry the topics of sensors and plugins to ROS and back.

    For the clock, each topic that a sensor or a system of the catalog writes, and each that a system reads, it has
    the names and messages on both sides and the direction. Names of ROS are short: `cmd_vel`, `odom`, `joint_states`,
    `imu`; with several models each has its own below the model's name. Transforms go to `/tf`.

    Changes nothing in the document. The file is written together with the result, below its folder, where there is
    no error; without `-o` there is no such folder. A file that is there is only replaced if it was written by twinform.
    `twinform convert --bridge FILE` writes the same for the result, into FILE.
    Never bridges: topics whose message ROS does not know, nor those whose name depends on an unknown world.
    Diagnostics: `unbridged-topic`.
    """

    name: ClassVar[str] = "bridge-config"
    example: ClassVar[str] = "bridge-config{file=bridge.yaml release=harmonic}"

    file: Annotated[CompanionPath, AfterValidator(_check_yaml_name)] = Field(
        description="Where to write it: a path below the folder of the result, ending in `.yaml` or `.yml`."
    )
    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that runs the model.")
    world: str | None = Field(default=None, description="The world that a model is put into; topics may contain it.")

    def text(self, document: Document, sink: DiagnosticSink) -> str:
        """The text of the file."""
        return bridge_yaml(bridges(document, self.release, sink, self.world))


_USUAL_NAMES = {"odometry": "odom", "joint_state": "joint_states"}
"""The usual names in ROS for the last part of a topic."""
TRANSFORMS = "gz.msgs.Pose_V"
"""The message of transforms, which become those of ROS."""
_TRANSFORM_TOPIC = "/tf"
# Transforms on topics with these last parts are for the tree of ROS (`/tf`). Others keep their
# name, so that the tree stays whole.
_TREE_TOPICS = frozenset({"tf", "pose", "pose_static"})
_STRANGE = lazy_pattern(r"[^A-Za-z0-9_]")
_IGNITION = "fortress"
"""The release whose bridge calls messages by the name of Ignition."""
_DIRECTIONS = {"<": "GZ_TO_ROS", ">": "ROS_TO_GZ"}

_HEADER = """\
# Made by twinform for ros_gz_bridge: ros2 run ros_gz_bridge parameter_bridge --ros-args -p config_file:=THIS_FILE
"""


@dataclass(frozen=True, slots=True)
class Bridge:
    """An entry of the file of ros_gz_bridge, with its keys."""

    ros_topic_name: str
    gz_topic_name: str
    ros_type_name: str
    gz_type_name: str
    direction: str


CLOCK = Topic("/clock", "/clock", "gz.msgs.Clock", "<", "", Document(format=Format.SDF))
"""The time of the simulation, which every node with `use_sim_time` waits for."""


def bridges(document: Document, release: str, sink: DiagnosticSink, world: str | None = None) -> list[Bridge]:
    """An entry for the clock and for each topic whose message ROS knows; other topics are reported."""
    wanted = [CLOCK, *(topic for topic in topics_of(document, release, world) if _can_be_bridged(topic, sink))]
    # Two plugins may share a topic (cmd_vel of a drive and of a controller); the bridge needs one
    # entry for it.
    wanted = list({(topic.name, topic.direction): topic for topic in wanted}.values())
    names = list(_ros_names(wanted))
    return [_make_entry(topic, name, release) for topic, name in zip(wanted, names, strict=True)]


def bridge_yaml(entries: Iterable[Bridge]) -> str:
    """The text of the file of ros_gz_bridge."""
    return _HEADER + "".join(_format_entry(each) for each in entries)


def _format_entry(bridge: Bridge) -> str:
    keys = ("ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name")
    lines = [f"{key}: {quote(getattr(bridge, key))}" for key in keys]
    lines.append(f"direction: {bridge.direction}")
    return "- " + "\n  ".join(lines) + "\n"


def _can_be_bridged(topic: Topic, sink: DiagnosticSink) -> bool:
    where = topic.source.location
    if topic.needs_world:
        message = f"the topic {topic.name!r} contains the name of the world, which is not known here"
        help_ = "name it with `world=NAME`, or give the sensor or plugin a topic of its own"
        sink.report(rules.UNBRIDGED_TOPIC, message, where, found=topic.name, help=help_, severity=Severity.WARNING)
        return False
    if topic.missing:
        message = f"Gazebo has no topic for {topic.message} here: {topic.missing}"
        help_ = "give the sensor or plugin a topic of its own, without blanks, @, ~, // and :="
        sink.report(rules.UNBRIDGED_TOPIC, message, where, found=topic.name, help=help_, severity=Severity.WARNING)
        return False
    if ros_message(topic.message) is None:
        message = f"the bridge knows no message of ROS for {topic.message} on {topic.name!r}"
        sink.report(rules.UNBRIDGED_TOPIC, message, where, found=topic.message)
        return False
    return True


def _ros_names(topics: list[Topic]) -> Iterator[str]:
    """The names of topics in ROS: short, below the name of the model if there are several, and unique."""
    # Names stay short for a single robot, as the nodes of ROS expect them: cmd_vel, odom, scan.
    several = len({topic.model for topic in topics if topic.model}) > 1
    names = [_short_name(topic, several=several) for topic in topics]
    count = Counter(name for name in names if name != _TRANSFORM_TOPIC)
    for name, topic in zip(names, topics, strict=True):
        yield name if count[name] <= 1 else _valid_ros_name(topic.name)


def _short_name(topic: Topic, *, several: bool) -> str:
    if topic.message == TRANSFORMS and topic.name.rpartition("/")[2] in _TREE_TOPICS:
        return _TRANSFORM_TOPIC
    if topic.short.startswith("/"):
        return topic.short
    *above, last = topic.short.split("/")
    parts = [*([topic.model] if several and topic.model else []), *above, _USUAL_NAMES.get(last, last)]
    return _valid_ros_name("/".join(parts))


def _valid_ros_name(name: str) -> str:
    """The name as ROS accepts it: letters, digits and underscores, and no part that begins with a digit."""
    parts = [_STRANGE.sub("_", part) for part in name.strip("/").split("/")]
    joined = "/".join(f"_{part}" if part[:1].isdigit() else part for part in parts if part)
    return f"/{joined}" if name.startswith("/") else joined


def _make_entry(topic: Topic, name: str, release: str) -> Bridge:
    message = topic.message.replace("gz.msgs.", "ignition.msgs.") if release == _IGNITION else topic.message
    return Bridge(name, topic.name, ros_message(topic.message) or "", message, _DIRECTIONS[topic.direction])
