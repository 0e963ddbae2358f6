"""Reports names in companion files that no robot and no group has."""

from collections.abc import Iterable, Sequence

from twinform.compiler.companions.name_places import Mention, NameSet
from twinform.compiler.companions.robot_parts import RobotParts
from twinform.compiler.companions.srdf_tree import SrdfTree
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, Severity, did_you_mean, is_typo, near_names, rules

_ELSEWHERE = frozenset({"map", "odom", "world", "earth", "utm"})
"""Frames that ROS has for what is no part of a robot (REP 105)."""
_FOOTPRINT = "base_footprint"
"""A link of robots on wheels; for what walks, a node publishes it (REP 120)."""


@dataclass(frozen=True, slots=True)
class KnownParts:
    """What names may mean: parts of any of some robots, and groups and virtual joints of SRDF files."""

    robots: Sequence[RobotParts]
    semantics: Sequence[SrdfTree] = ()

    @property
    def whose(self) -> str:
        """The robots in words."""
        if len(self.robots) == 1:
            return f"the robot {self.robots[0].name!r} does not have"
        return f"none of {len(self.robots)} robots has"

    def may_have(self, name: str) -> bool:
        """Whether a robot or SRDF would have a part of this name with other arguments."""
        return any(name in each.possible for each in (*self.robots, *self.semantics))

    @property
    def links(self) -> NameSet:
        """All links."""
        return NameSet(name for robot in self.robots for name in robot.links)

    @property
    def joints(self) -> NameSet:
        """All joints, with those that SRDF adds."""
        virtual = (name for each in self.semantics for name in each.names("virtual_joint"))
        return NameSet((*virtual, *(name for robot in self.robots for name in robot.joints)))

    @property
    def rolls(self) -> bool:
        """Whether any of the robots has wheels."""
        return any(joint.type == "continuous" for robot in self.robots for joint in robot.joints.values())

    @property
    def groups(self) -> NameSet:
        """All groups."""
        return NameSet(name for each in self.semantics for name in each.names("group"))

    @property
    def sensors(self) -> NameSet:
        """All sensors of `<ros2_control>`."""
        return NameSet(name for robot in self.robots for name in robot.sensors)


def report_names(found: Iterable[Mention[Location]], known: KnownParts, sink: DiagnosticSink) -> None:
    """Report each name in a file that is none of what is known."""
    links, joints, groups, sensors = known.links, known.joints, known.groups, known.sensors
    controlled = all(robot.is_controlled for robot in known.robots)
    found = list(found)
    _report_controllers([each for each in found if each.kind == "controller"], sink)
    for each in found:
        match each.kind:
            case "joint" | "driven joint" if known.robots:
                _report_stale(each, "joint", joints, known, sink)
            case "interface" if known.robots and "/" in each.text:
                _report_stale(each, "joint", joints, known, sink)
                _report_interface(each, known.robots, sink)
            case "group" if groups:
                _report_group(each, groups, known, sink)
            case "sensor" if known.robots and controlled and each.text not in sensors and not known.may_have(each.text):
                message = f"the sensor {each.text!r} is in no <ros2_control> of the robot"
                _report(each, message, sensors, sink, Severity.ERROR)
            case "link" if known.robots and each.leaf.path[-1].text.startswith("@"):
                _report_stale(each, "link", links, known, sink)
            case "link" | "frame" if known.robots:
                _report_frame(each, links, known, sink)
            case _:
                pass


def _report_controllers(listed: Sequence[Mention[Location]], sink: DiagnosticSink) -> None:
    """Report controllers of a list that are not described beside it."""
    beside = {id(each.leaf.beside): each.leaf.beside for each in listed}
    described = {key: NameSet(names) for key, names in beside.items()}
    # A list for another program names controllers of which none is described beside it.
    describes = any(each.text in described[id(each.leaf.beside)] for each in listed)
    for each in listed:
        names = described[id(each.leaf.beside)]
        # the manager's own list, or that of a file which holds nothing else
        around = [step.text for step in each.leaf.path[:-1]]
        is_meant = describes or around[-1:] == ["moveit_simple_controller_manager"] or (not around and len(names) > 1)
        if "/" not in each.text and each.text not in names and (is_meant or _is_misspelt(each.text, names)):
            message = f"the controller {each.text!r} is listed here, and not described in this file"
            _report(each, message, names, sink)


def _report_stale(
    mention: Mention[Location], what: str, names: NameSet, known: KnownParts, sink: DiagnosticSink
) -> None:
    if mention.name in names or known.may_have(mention.name):
        return
    # the controller manager ends, or refuses to activate the controller
    severity = Severity.ERROR if mention.kind == "driven joint" else None
    _report(mention, f"there is no {what} {mention.name!r}, which {known.whose}", names, sink, severity)


def _report_interface(mention: Mention[Location], robots: Sequence[RobotParts], sink: DiagnosticSink) -> None:
    """Report an interface of a joint that has others, of the only robot that is meant."""
    driven = robots[0].driven.get(mention.name) if len(robots) == 1 else None
    name = mention.text.rpartition("/")[2]
    if driven is not None and name not in driven.commands | driven.states:
        message = f"the joint {mention.name!r} has no interface {name!r} in <ros2_control>"
        hint = f"it has {', '.join(sorted(driven.commands | driven.states))}"
        sink.report(rules.MISSING_INTERFACE, message, mention.place, found=mention.text, help=hint)


def _report_group(mention: Mention[Location], groups: NameSet, known: KnownParts, sink: DiagnosticSink) -> None:
    if mention.text not in groups and not known.may_have(mention.text):
        _report(mention, f"there is no group {mention.text!r} in SRDF", groups, sink)


def _is_misspelt(name: str, known: NameSet) -> bool:
    return any(is_typo(name, each) for each in near_names(name, known))


def _report_frame(mention: Mention[Location], links: NameSet, known: KnownParts, sink: DiagnosticSink) -> None:
    """Report a frame that is no link; one that may be of something else only where a link is meant."""
    name = mention.text.rpartition("/")[2]
    if not name or name in links or name in _ELSEWHERE or not sink.takes(Severity.WARNING):
        return
    # a driver may publish `tool0_controller` beside the link `tool0`
    if known.may_have(name) or (mention.kind == "frame" and not _is_misspelt(name, links)):
        return
    if name == _FOOTPRINT and not known.rolls and not _is_misspelt(name, links):
        return
    message = f"there is no link {name!r} for this frame, which {known.whose}"
    hint = did_you_mean(name, links)
    sink.report(rules.STALE_FRAME, message, mention.place, found=mention.text, help=hint)


def _report(
    mention: Mention[Location],
    message: str,
    names: NameSet,
    sink: DiagnosticSink,
    severity: Severity | None = None,
) -> None:
    if not sink.takes(severity or Severity.WARNING):
        return  # a hostile file has a hundred thousand, and looking for what is meant takes a while
    hint = did_you_mean(mention.name, names)
    sink.report(rules.STALE_NAME, message, mention.place, found=mention.text, help=hint, severity=severity)
