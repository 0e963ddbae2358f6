"""The output of the program around gz-physics, as typed results."""

import re
from signal import SIGALRM
from typing import NotRequired, TypedDict

from testbed.engines.gazebo.results import (
    Console,
    InsideJoint,
    Joint,
    Link,
    LinkState,
    Moment,
    Numbers,
    Outcome,
    Simulation,
)

_COLOR = re.compile(r"\x1b\[[0-9;]*m")
_PROFILER = "Error launching Remotery"
"""Only one process can have the port of gz-common's profiler, which nobody asks here."""
_ERROR = re.compile(r"^(\[Err\]|Error\b)")
_WARNING = re.compile(r"^(\[Wrn\]|Warning\b)")
_ASSERTION = re.compile(r"^\S+: \S*/(?P<file>[^/:]+):\d+: .* Assertion `(?P<claim>.*)' failed\.$")
_PREFIX = re.compile(r"^(\[(Err|Wrn|Msg|Dbg)\]|Error:?|Warning:?)\s*(\[[^\]]*:\d+\])?\s*")


class _InsideRow(TypedDict):
    kind: str
    screws: list[list[float]]
    lower: list[float]
    upper: list[float]
    effort: list[float]
    velocity: list[float]
    damping: list[float]
    friction: list[float]
    stiffness: list[float]
    rest: list[float]


class _JointRow(TypedDict):
    name: str
    kind: str
    parent: str
    child: str
    freedom: NotRequired[int]
    inside: NotRequired[_InsideRow]


class _LinkRow(TypedDict):
    name: str
    mass: NotRequired[float]
    center: NotRequired[list[float]]
    moments: NotRequired[list[float]]


class _MomentRow(TypedDict):
    time: float
    poses: list[list[float]]
    velocities: list[list[float]]
    positions: list[list[float]]
    rates: list[list[float]]


class Row(TypedDict):
    """A line of the program's output."""

    path: str
    signal: int
    stage: str
    console: str
    errors: NotRequired[list[str]]
    links: NotRequired[list[_LinkRow]]
    joints: NotRequired[list[_JointRow]]
    left_out: NotRequired[list[str]]
    moments: NotRequired[list[_MomentRow]]


def simulation(row: Row) -> Simulation:
    """The result for one file."""
    links = tuple(_link(each) for each in row.get("links", ()))
    joints = tuple(_joint(each) for each in row.get("joints", ()))
    return Simulation(
        _outcome(row),
        row["stage"],
        console(row["console"]),
        tuple(row.get("errors", ())),
        tuple(row.get("left_out", ())),
        links,
        joints,
        tuple(_moment(each, links, joints) for each in row.get("moments", ())),
    )


def console(text: str) -> Console:
    """Lines by how grave they are, as gz-common, libsdformat and DART label them."""
    found: dict[str, list[str]] = {"errors": [], "warnings": [], "other": []}
    for raw in _COLOR.sub("", text).splitlines():
        line = _ASSERTION.sub(r"Error: assertion \g<claim> of \g<file> failed", raw)
        kind = "errors" if _ERROR.match(line) else "warnings" if _WARNING.match(line) else "other"
        words = _PREFIX.sub("", line).strip()
        if words and not words.startswith(_PROFILER):
            found[kind].append(words)
    return Console(*(tuple(lines) for lines in found.values()))


def _outcome(row: Row) -> Outcome:
    if row["signal"] == SIGALRM:
        return Outcome.HUNG
    if row["signal"]:
        return Outcome.CRASHED
    return Outcome.REFUSED if row.get("errors") else Outcome.DONE


def _link(row: _LinkRow) -> Link:
    return Link(row["name"], row.get("mass"), tuple(row.get("center", ())), tuple(row.get("moments", ())))


def _joint(row: _JointRow) -> Joint:
    inside = _inside(row["inside"]) if "inside" in row else None
    return Joint(row["name"], row["kind"], row["parent"], row["child"], row.get("freedom"), inside)


def _inside(row: _InsideRow) -> InsideJoint:
    screws = tuple(tuple(screw) for screw in row["screws"])
    names = ("lower", "upper", "effort", "velocity", "damping", "friction", "stiffness", "rest")
    return InsideJoint(row["kind"], screws, *(tuple(row[name]) for name in names))


def _moment(row: _MomentRow, links: tuple[Link, ...], joints: tuple[Joint, ...]) -> Moment:
    states = zip(row["poses"], row["velocities"], strict=True)
    return Moment(
        row["time"],
        {link.name: LinkState(tuple(pose), tuple(speed)) for link, (pose, speed) in zip(links, states, strict=True)},
        _by_joint(joints, row["positions"]),
        _by_joint(joints, row["rates"]),
    )


def _by_joint(joints: tuple[Joint, ...], rows: list[list[float]]) -> dict[str, Numbers]:
    """Numbers by joint; none where the engine has no joints at all."""
    return {joint.name: tuple(row) for joint, row in zip(joints, rows, strict=False)}
