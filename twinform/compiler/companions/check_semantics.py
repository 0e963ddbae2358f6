"""Checks of SRDF beyond names: groups and their states, end effectors, virtual joints and pairs of links."""

from collections.abc import Iterable
from graphlib import CycleError, TopologicalSorter
from typing import cast

from twinform.compiler.companions.robot_parts import RobotParts, range_of, variables_of
from twinform.compiler.companions.srdf_tree import SrdfTree, elements
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, Rule, rules
from twinform.schemas import XmlElement

_SLACK = 1e-3
"""How far a position may be off a limit by rounding, in rad or m."""
_PARTS = ("link", "joint", "passive_joint", "chain", "group")
_MOST_SHOWN = 5
_VIRTUAL = frozenset({"fixed", "planar", "floating"})
_MOST_GROUPS = 200
"""With more groups or chains, their contents are not collected, since each may have all joints."""


def report_semantics(srdf: SrdfTree, robot: RobotParts | None, sink: DiagnosticSink) -> None:
    """Report what MoveIt ignores or takes otherwise; what needs a robot only where it is known which."""
    report = _Report(srdf, sink)
    _report_repeated("group", ("name",), report)
    _report_repeated("group_state", ("name", "group"), report)
    _report_repeated("end_effector", ("name",), report)
    _report_pairs(report)
    groups = {each.get("name") or "": each for each in elements(srdf.root, "group")}
    _report_groups(groups, report)
    if robot is None:
        return
    roots = robot.roots
    for each in elements(srdf.root, "virtual_joint"):
        _report_virtual(each, robot, roots, report)
    chains = sum(1 for group in groups.values() for _ in elements(group, "chain"))
    if max(len(groups), chains) > _MOST_GROUPS:
        return
    contents = GroupContents(
        groups, robot, frozenset(each.get("name") or "" for each in srdf.root.iter("passive_joint"))
    )
    virtual = {each.get("name") or "": each.get("type") or "" for each in elements(srdf.root, "virtual_joint")}
    for state in elements(srdf.root, "group_state"):
        if state.get("group") in groups:
            _report_state(state, contents, virtual, report)
    for each in elements(srdf.root, "end_effector"):
        _report_effector(each, contents, report)


@dataclass(frozen=True, slots=True)
class _Report:
    """Reports findings about the elements of a file."""

    srdf: SrdfTree
    sink: DiagnosticSink

    def __call__(
        self,
        rule: Rule,
        message: str,
        element: XmlElement,
        attribute: str = "",
        *,
        found: str | None = None,
        help: str | None = None,
        expected: str | None = None,
        related: tuple[Location, ...] = (),
    ) -> None:
        where = self.srdf.place_of(element, attribute)
        found = element.get("name") if found is None else found
        self.sink.report(rule, message, where, found=found, expected=expected, help=help, related=related)


def _report_repeated(tag: str, keys: tuple[str, ...], report: _Report) -> None:
    first: dict[tuple[str | None, ...], XmlElement] = {}
    for each in elements(report.srdf.root, tag):
        key = tuple(each.get(name) for name in keys)
        if first.setdefault(key, each) is not each:
            what = tag.replace("_", " ")
            message = f"the {what} {each.get('name')!r} stands here twice; MoveIt takes one of them"
            report(rules.REPEATED_SEMANTICS, message, each, related=(report.srdf.place_of(first[key]),))


def _report_pairs(report: _Report) -> None:
    """Report the first pair of links that stands there twice, and how many others do: programs write such lists."""
    known: set[frozenset[str]] = set()
    twice: list[XmlElement] = []
    for each in elements(report.srdf.root, "disable_collisions"):
        one, other = each.get("link1") or "", each.get("link2") or ""
        pair = frozenset({one, other})
        if len(pair) == 1:
            message = f"the link {one!r} is paired with itself, which disables nothing"
            report(rules.REPEATED_SEMANTICS, message, each, found=one)
        elif pair in known:
            twice.append(each)
        known.add(pair)
    if twice:
        first = twice[0]
        more = f", as are {len(twice) - 1} other pairs" if len(twice) > 1 else ""
        message = f"collisions of {first.get('link1')!r} and {first.get('link2')!r} are disabled twice{more}"
        related = tuple(report.srdf.place_of(each) for each in twice[1:_MOST_SHOWN])
        report(rules.REPEATED_SEMANTICS, message, first, found=first.get("link1") or "", related=related)


def _report_groups(groups: dict[str, XmlElement], report: _Report) -> None:
    """Report groups without content, and the first that have each other as subgroups."""
    below = {name: [each.get("name") or "" for each in elements(group, "group")] for name, group in groups.items()}
    for group in groups.values():
        if next(elements(group, *_PARTS), None) is None:
            report(rules.BROKEN_SEMANTICS, f"the group {group.get('name')!r} is empty", group)
    try:
        TopologicalSorter(below).prepare()
    except CycleError as error:
        circle = list(dict.fromkeys(cast("list[str]", error.args[1])))
        name = next(each for each in groups if each in circle)
        others = f", by way of {', '.join(each for each in circle if each != name)}" if len(circle) > 1 else ""
        report(rules.BROKEN_SEMANTICS, f"the group {name!r} has itself as a subgroup{others}", groups[name])


class GroupContents:
    """The joints and links of groups, as MoveIt collects them."""

    def __init__(self, groups: dict[str, XmlElement], robot: RobotParts, passive: frozenset[str]) -> None:
        self.groups, self.robot, self.passive = groups, robot, passive
        self.unknown: set[str] = set()
        """Groups with chains of which an end is no link, so that what is in them is not known."""
        self._joints: dict[str, frozenset[str]] = {}

    def joints(self, name: str) -> frozenset[str]:
        """Return the joints of a group: its own, those that move its links, those of its chains and subgroups."""
        if name not in self._joints:
            self._joints[name] = frozenset()  # a group inside of itself adds nothing
            self._joints[name] = frozenset(self._collect(name))
        return self._joints[name]

    def _collect(self, name: str) -> Iterable[str]:
        group = self.groups.get(name)
        for each in () if group is None else elements(group, *_PARTS):
            called = each.get("name") or ""
            if each.tag in {"joint", "passive_joint"}:
                yield called
            elif each.tag == "link" and called in self.robot.above:
                yield self.robot.above[called].name
            elif each.tag == "group":
                yield from self.joints(called)
                self.unknown.update({name} if called in self.unknown or called not in self.groups else ())
            elif each.tag == "chain":
                ends = each.get("base_link") or "", each.get("tip_link") or ""
                yield from (one.name for one in self.robot.chain(*ends))
                self.unknown.update({name} if any(end not in self.robot.links for end in ends) else ())

    def links(self, name: str) -> set[str]:
        """Return the links of a group: its own, those that its joints move, and the bases of its chains."""
        group = self.groups.get(name)
        joints = (self.robot.joints.get(each) for each in self.joints(name))
        found = {each.child for each in joints if each is not None and each.child}
        for each in () if group is None else elements(group, "link", "chain", "group"):
            found.add(each.get("name" if each.tag == "link" else "base_link") or "")
        return found


def _report_virtual(joint: XmlElement, robot: RobotParts, roots: list[str], report: _Report) -> None:
    kind, child = joint.get("type") or "", joint.get("child_link") or ""
    if kind not in _VIRTUAL:
        message = f"a virtual joint is fixed, planar or floating; {kind!r} is taken for fixed"
        report(rules.BROKEN_SEMANTICS, message, joint, "type", found=kind)
    if child in robot.above and len(roots) == 1:
        message = f"the virtual joint {joint.get('name')!r} holds {child!r}, which is not the root of the robot"
        hint = f"write {roots[0]!r}: MoveIt leaves the joint out otherwise"
        report(rules.BROKEN_SEMANTICS, message, joint, "child_link", found=child, help=hint)


def _report_state(state: XmlElement, contents: GroupContents, virtual: dict[str, str], report: _Report) -> None:
    group = state.get("group") or ""
    own = contents.joints(group)
    if group in contents.unknown:
        return
    left = {name for name in own if _is_active(name, contents, virtual)}
    for each in elements(state, "joint"):
        name = each.get("name") or ""
        left.discard(name)
        joint = contents.robot.joints.get(name)
        kind = joint.type if joint is not None else virtual.get(name)
        if kind is None:
            continue  # which is reported as a name
        if name not in own:
            message = f"the joint {name!r} is not in the group {group!r}, so the state does not move it"
            report(rules.IMPOSSIBLE_STATE, message, each, "name")
            continue
        _report_position(each, kind, range_of(joint) if joint is not None else None, report)

    if left:
        shown = ", ".join(map(repr, sorted(left)[:_MOST_SHOWN]))
        message = f"the state {state.get('name')!r} of the group {group!r} has no position of {shown}"
        report(rules.IMPOSSIBLE_STATE, message, state)


def _is_active(name: str, contents: GroupContents, virtual: dict[str, str]) -> bool:
    """Whether a joint of a group has a position of its own: passive ones and those that follow others have none."""
    joint = contents.robot.joints.get(name)
    if joint is None:
        return variables_of(virtual.get(name, "fixed")) > 0
    follows = joint.axis is not None and joint.axis.mimic is not None
    return name not in contents.passive and not follows and variables_of(joint.type) > 0


def _report_position(element: XmlElement, kind: str, allowed: tuple[float, float] | None, report: _Report) -> None:
    name, text = element.get("name"), element.get("value") or ""
    try:
        values = [float(each) for each in text.split()]
    except ValueError:
        message = f"the position of {name!r} is {text!r}, and no number"
        report(rules.IMPOSSIBLE_STATE, message, element, "value", found=text)
        return
    wanted = variables_of(kind)
    if len(values) != wanted:
        message = f"the position of {name!r} has {len(values)} numbers; a {kind} joint takes {wanted}"
        report(rules.IMPOSSIBLE_STATE, message, element, "value", found=text, expected=str(wanted))
    elif allowed is not None and wanted == 1 and not allowed[0] - _SLACK <= values[0] <= allowed[1] + _SLACK:
        message = f"the joint {name!r} cannot be at {values[0]:g}: its limits are {allowed[0]:g} and {allowed[1]:g}"
        expected = f"{allowed[0]:g} to {allowed[1]:g}"
        report(rules.IMPOSSIBLE_STATE, message, element, "value", found=text, expected=expected)


def _report_effector(effector: XmlElement, contents: GroupContents, report: _Report) -> None:
    parent, link = effector.get("parent_group"), effector.get("parent_link") or ""
    if parent not in contents.groups or link not in contents.robot.links:
        return
    if link not in contents.links(parent) and parent not in contents.unknown:
        message = f"the parent link {link!r} of end effector {effector.get('name')!r} is not in the group {parent!r}"
        report(rules.BROKEN_SEMANTICS, message, effector, "parent_link", found=link)
