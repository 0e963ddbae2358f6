"""Configuration of ros_gz_bridge: which topics of Gazebo map to which topics of ROS."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir import Document, Format
from twinform.passes.plugins.catalog import ros_message
from twinform.passes.plugins.topics import Topic, topics_of
from twinform.passes.plugins.yaml_text import quoted

_USUAL = {"odometry": "odom", "joint_state": "joint_states"}
"""What ROS usually calls the last part of a topic."""
_TRANSFORMS = "gz.msgs.Pose_V"
_TRANSFORM_TOPIC = "/tf"
# Transforms on topics with these last parts are for the tree of ROS (`/tf`). Others keep their
# name, so that the tree stays whole.
_TREES = frozenset({"tf", "pose", "pose_static"})
_STRANGE = re.compile(r"[^A-Za-z0-9_]")
_IGNITION = "fortress"
"""The release whose bridge calls messages by the name of Ignition."""
_DIRECTIONS = {"<": "GZ_TO_ROS", ">": "ROS_TO_GZ"}

_HEAD = """\
# Made by twinform for ros_gz_bridge: ros2 run ros_gz_bridge parameter_bridge --ros-args -p config_file:=THIS_FILE
"""


@dataclass(frozen=True, slots=True)
class Bridge:
    """One entry: the keys of ros_gz_bridge's file, in its syntax."""

    ros_topic_name: str
    gz_topic_name: str
    ros_type_name: str
    gz_type_name: str
    direction: str


CLOCK = Topic("/clock", "/clock", "gz.msgs.Clock", "<", "", Document(format=Format.SDF))
"""The time of the simulation, which every node with `use_sim_time` waits for."""


def bridges(document: Document, release: str, sink: DiagnosticSink, world: str | None = None) -> list[Bridge]:
    """An entry for the clock and for each topic that ROS knows the message of; what is left out is reported."""
    wanted = [CLOCK, *(topic for topic in topics_of(document, release, world) if _can_be_bridged(topic, sink))]
    # Two plugins may share a topic (cmd_vel of a drive and of a controller); the bridge needs one
    # entry for it.
    wanted = list({(topic.name, topic.direction): topic for topic in wanted}.values())
    names = list(_ros_names(wanted))
    return [_bridge(topic, name, release) for topic, name in zip(wanted, names, strict=True)]


def bridge_yaml(entries: Iterable[Bridge]) -> str:
    """The file of ros_gz_bridge."""
    return _HEAD + "".join(_entry_yaml(each) for each in entries)


def _entry_yaml(bridge: Bridge) -> str:
    keys = ("ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name")
    lines = [f"{key}: {quoted(getattr(bridge, key))}" for key in keys]
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
    """The topics of ROS: short, below the model's name where there are several, and each one of its own."""
    # Names stay short for a single robot, as the nodes of ROS expect them: cmd_vel, odom, scan.
    several = len({topic.model for topic in topics if topic.model}) > 1
    names = [_short(topic, several=several) for topic in topics]
    count = Counter(name for name in names if name != _TRANSFORM_TOPIC)
    for name, topic in zip(names, topics, strict=True):
        yield name if count[name] <= 1 else _valid(topic.name)


def _short(topic: Topic, *, several: bool) -> str:
    if topic.message == _TRANSFORMS and topic.name.rpartition("/")[2] in _TREES:
        return _TRANSFORM_TOPIC
    if topic.short.startswith("/"):
        return topic.short
    *above, last = topic.short.split("/")
    parts = [*([topic.model] if several and topic.model else []), *above, _USUAL.get(last, last)]
    return _valid("/".join(parts))


def _valid(name: str) -> str:
    """The name as ROS takes it: letters, digits and underscores, and no part that begins with a digit."""
    parts = [_STRANGE.sub("_", part) for part in name.strip("/").split("/")]
    joined = "/".join(f"_{part}" if part[:1].isdigit() else part for part in parts if part)
    return f"/{joined}" if name.startswith("/") else joined


def _bridge(topic: Topic, name: str, release: str) -> Bridge:
    message = topic.message.replace("gz.msgs.", "ignition.msgs.") if release == _IGNITION else topic.message
    return Bridge(name, topic.name, ros_message(topic.message) or "", message, _DIRECTIONS[topic.direction])
