"""Checks of SRDF beyond names: groups and their states, end effectors, virtual joints and pairs of links."""

from collections.abc import Iterable

from twinform.compiler.companions.robot_parts import RobotParts, range_of, variables_of
from twinform.compiler.companions.srdf_tree import SrdfTree, elements, place_of
from twinform.diagnostics import DiagnosticSink, rules
from twinform.schemas import XmlElement

_SLACK = 1e-3
"""How far a position may be off a limit by rounding, in rad or m."""
_PARTS = ("link", "joint", "passive_joint", "chain", "group")
_VIRTUAL = frozenset({"fixed", "planar", "floating"})


def report_semantics(srdf: SrdfTree, robot: RobotParts | None, sink: DiagnosticSink) -> None:
    """Report what MoveIt ignores or takes otherwise; what needs a robot only where it is known which."""
    groups = {each.get("name") or "": each for each in elements(srdf.root, "group")}
    _report_repeated(elements(srdf.root, "group"), ("name",), "group", sink)
    _report_repeated(elements(srdf.root, "group_state"), ("name", "group"), "group state", sink)
    _report_repeated(elements(srdf.root, "end_effector"), ("name",), "end effector", sink)
    _report_pairs(elements(srdf.root, "disable_collisions"), sink)
    for group in groups.values():
        if next(elements(group, *_PARTS), None) is None:
            _report(group, f"the group {group.get('name')!r} is empty", sink)
    for name in _in_circles(groups):
        _report(groups[name], f"the group {name!r} has itself as a subgroup", sink)
    if robot is None:
        return
    contents = GroupContents(groups, robot)
    for each in elements(srdf.root, "virtual_joint"):
        _report_virtual(each, robot, sink)
    virtual = {each.get("name") or "": each.get("type") or "" for each in elements(srdf.root, "virtual_joint")}
    for state in elements(srdf.root, "group_state"):
        if state.get("group") in groups:
            _report_state(state, contents, virtual, sink)
    for each in elements(srdf.root, "end_effector"):
        _report_effector(each, contents, sink)


def _report(element: XmlElement, message: str, sink: DiagnosticSink, help: str | None = None) -> None:
    sink.report(rules.BROKEN_SEMANTICS, message, place_of(element), found=element.get("name"), help=help)


def _report_repeated(found: Iterable[XmlElement], keys: tuple[str, ...], what: str, sink: DiagnosticSink) -> None:
    first: dict[tuple[str | None, ...], XmlElement] = {}
    for each in found:
        key = tuple(each.get(name) for name in keys)
        if first.setdefault(key, each) is not each:
            message = f"the {what} {each.get('name')!r} stands here twice; MoveIt takes one of them"
            other = (place_of(first[key]),)
            sink.report(rules.REPEATED_SEMANTICS, message, place_of(each), found=each.get("name"), related=other)


def _report_pairs(found: Iterable[XmlElement], sink: DiagnosticSink) -> None:
    first: dict[frozenset[str], XmlElement] = {}
    for each in found:
        one, other = each.get("link1") or "", each.get("link2") or ""
        pair = frozenset({one, other})
        if len(pair) == 1:
            message = f"the link {one!r} is paired with itself, which disables nothing"
            sink.report(rules.REPEATED_SEMANTICS, message, place_of(each), found=one)
        elif first.setdefault(pair, each) is not each:
            message = f"collisions of {one!r} and {other!r} are disabled twice"
            before = (place_of(first[pair]),)
            sink.report(rules.REPEATED_SEMANTICS, message, place_of(each), found=one, related=before)


def _in_circles(groups: dict[str, XmlElement]) -> list[str]:
    """Return the groups that have themselves as subgroups, directly or through others."""
    below = {name: [each.get("name") or "" for each in elements(group, "group")] for name, group in groups.items()}
    found: list[str] = []
    for name in groups:
        reached: set[str] = set()
        waiting = list(below[name])
        while waiting and len(reached) <= _MOST_SUBGROUPS:
            here = waiting.pop()
            if here not in reached:
                reached.add(here)
                waiting.extend(below.get(here, ()))
        if name in reached:
            found.append(name)
    return found


_MOST_SUBGROUPS = 100
"""So many are followed from each group."""


class GroupContents:
    """The joints and links of groups, as MoveIt collects them."""

    def __init__(self, groups: dict[str, XmlElement], robot: RobotParts) -> None:
        self.groups, self.robot = groups, robot
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
            elif each.tag == "chain":
                base = each.get("base_link") or ""
                yield from (one.name for one in self.robot.chain(base, each.get("tip_link") or ""))
                if base in self.robot.above:
                    yield self.robot.above[base].name

    def links(self, name: str) -> set[str]:
        """Return the links of a group: its own, those that its joints move, and the bases of its chains."""
        group = self.groups.get(name)
        joints = (self.robot.joints.get(each) for each in self.joints(name))
        found = {each.child for each in joints if each is not None and each.child}
        for each in () if group is None else elements(group, "link", "chain", "group"):
            found.add(each.get("name" if each.tag == "link" else "base_link") or "")
        return found


def _report_virtual(joint: XmlElement, robot: RobotParts, sink: DiagnosticSink) -> None:
    kind, child = joint.get("type") or "", joint.get("child_link") or ""
    if kind not in _VIRTUAL:
        message = f"a virtual joint is fixed, planar or floating; {kind!r} is taken for fixed"
        sink.report(rules.BROKEN_SEMANTICS, message, place_of(joint, "type"), found=kind)
    if child in robot.links and child not in robot.roots and len(robot.roots) == 1:
        message = f"the virtual joint {joint.get('name')!r} holds {child!r}, which is not the root of the robot"
        hint = f"write {robot.roots[0]!r}: MoveIt leaves the joint out otherwise"
        sink.report(rules.BROKEN_SEMANTICS, message, place_of(joint, "child_link"), found=child, help=hint)


def _report_state(state: XmlElement, contents: GroupContents, virtual: dict[str, str], sink: DiagnosticSink) -> None:
    group = state.get("group") or ""
    own = contents.joints(group)
    for each in elements(state, "joint"):
        name = each.get("name") or ""
        joint = contents.robot.joints.get(name)
        kind = joint.type if joint is not None else virtual.get(name)
        if kind is None:
            continue  # which is reported as a name
        if name not in own:
            message = f"the joint {name!r} is not in the group {group!r}, so the state does not move it"
            sink.report(rules.IMPOSSIBLE_STATE, message, place_of(each, "name"), found=name)
            continue
        _report_position(each, kind, range_of(joint) if joint is not None else None, sink)


def _report_position(element: XmlElement, kind: str, allowed: tuple[float, float] | None, sink: DiagnosticSink) -> None:
    name, text = element.get("name"), element.get("value") or ""
    where = place_of(element, "value")
    try:
        values = [float(each) for each in text.split()]
    except ValueError:
        sink.report(rules.IMPOSSIBLE_STATE, f"the position of {name!r} is {text!r}, and no number", where, found=text)
        return
    wanted = variables_of(kind)
    if len(values) != wanted:
        message = f"the position of {name!r} has {len(values)} numbers; a {kind} joint takes {wanted}"
        sink.report(rules.IMPOSSIBLE_STATE, message, where, found=text, expected=str(wanted))
    elif allowed is not None and wanted == 1 and not allowed[0] - _SLACK <= values[0] <= allowed[1] + _SLACK:
        message = f"the joint {name!r} cannot be at {values[0]:g}: its limits are {allowed[0]:g} and {allowed[1]:g}"
        expected = f"{allowed[0]:g} to {allowed[1]:g}"
        sink.report(rules.IMPOSSIBLE_STATE, message, where, found=text, expected=expected)


def _report_effector(effector: XmlElement, contents: GroupContents, sink: DiagnosticSink) -> None:
    parent, link = effector.get("parent_group"), effector.get("parent_link") or ""
    if parent in contents.groups and link in contents.robot.links and link not in contents.links(parent):
        message = f"the parent link {link!r} of end effector {effector.get('name')!r} is not in the group {parent!r}"
        sink.report(rules.BROKEN_SEMANTICS, message, place_of(effector, "parent_link"), found=link)
