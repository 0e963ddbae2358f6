"""Planning of fixed-joint lumping: which links are merged into which, and which have to stay."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from twinform.diagnostics import rules
from twinform.ir import Joint, Link, Model
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.passes.framework.pass_base import matches
from twinform.passes.structure.model_edit import EditContext

Obstacle = Callable[[Joint, Link, Link], str | None]
"""Why a link (the last) that a joint fixes to another has to stay; None where it may be lumped."""


@dataclass(frozen=True, slots=True)
class LumpingPlan:
    """The joints that go, by the names of their children; `hosts` has the link that each of these goes into."""

    joints: Mapping[str, Joint]
    hosts: Mapping[str, str]

    def guests(self) -> dict[str, list[str]]:
        """The links that go into another, by its name: parents before children, and these in the order of joints."""
        below: dict[str, list[str]] = {}
        for child, joint in self.joints.items():
            below.setdefault(joint.parent or "", []).append(child)
        return {host: list(_below(host, below)) for host in dict.fromkeys(self.hosts.values())}


def _below(name: str, below: Mapping[str, list[str]]) -> Iterator[str]:
    stack = list(reversed(below.get(name, [])))
    while stack:
        child = stack.pop()
        yield child
        stack.extend(reversed(below.get(child, [])))


@dataclass(frozen=True, slots=True)
class LumpingCandidate:
    """A fixed joint between two links; `parent` and `child` are the links that its ends move with."""

    joint: Joint
    parent: str
    child: str


def plan(model: Model, graph: FrameGraph, keep: tuple[str, ...], obstacle: Obstacle, place: EditContext) -> LumpingPlan:
    """What can go, with a diagnostic for each link that cannot."""
    links = {link.name: link for link in model.links}
    ends = [
        LumpingCandidate(joint, _body(joint.parent, links, graph), _body(joint.child, links, graph))
        for joint in model.joints
    ]
    # A gearbox couples two joints and holds no link.
    carried = Counter(each.child for each in ends if each.joint.type != "gearbox")
    going: dict[str, LumpingCandidate] = {}
    for each in ends:
        if each.joint.type != "fixed" or each.child not in links or each.parent == WORLD or _kept(each, keep):
            continue
        why = _why_not(each, links, carried, obstacle)
        if why is None:
            going[each.child] = each
        elif why:
            _report(each, why, place)
    for name in _circles(going):
        _report(going.pop(name), "fixed joints go round in a circle there", place)
    _leave_what_others_hold(going, ends, place)
    return LumpingPlan(
        {name: each.joint.copy(parent=each.parent) for name, each in going.items()},
        {name: _host(name, going) for name in going},
    )


def _body(name: str | None, links: Mapping[str, Link], graph: FrameGraph) -> str:
    if not name or name in links or name == WORLD:
        return name or ""
    try:
        return graph.body(name)
    except FrameError:  # it is in the model of an include that was not read
        return name


def _kept(each: LumpingCandidate, keep: tuple[str, ...]) -> bool:
    return matches(each.child, keep) or matches(each.joint.name, keep)


def _why_not(
    each: LumpingCandidate, links: Mapping[str, Link], carried: Counter[str], obstacle: Obstacle
) -> str | None:
    if each.parent not in links:
        return f"{each.parent!r}, which it is fixed to, is in another model"
    if carried[each.child] > 1:
        return "it is the child of several joints"
    return obstacle(each.joint, links[each.parent], links[each.child])


def _circles(going: Mapping[str, LumpingCandidate]) -> list[str]:
    """The links from which the way up never ends."""
    good: set[str] = set()
    bad: list[str] = []
    for name in going:
        path: list[str] = []
        here = name
        while here in going and here not in good and here not in path:
            path.append(here)
            here = going[here].parent
        if here in path or here in bad:
            bad.extend(path)
        else:
            good.update(path)
    return list(dict.fromkeys(bad))


def _leave_what_others_hold(
    going: dict[str, LumpingCandidate], ends: list[LumpingCandidate], place: EditContext
) -> None:
    """A joint must not end up with both of its ends in one link."""
    while True:
        same = next((each for each in ends if _joins_itself(each, going)), None)
        if same is None:
            return
        why = f"joint {same.joint.name!r} would connect one link with itself"
        for name in dict.fromkeys((*_way_up(same.child, going), *_way_up(same.parent, going))):
            _report(going.pop(name), why, place)


def _joins_itself(each: LumpingCandidate, going: Mapping[str, LumpingCandidate]) -> bool:
    if each.child in going and going[each.child] is each:
        return False
    return each.parent != each.child and _host(each.parent, going) == _host(each.child, going)


def _way_up(name: str, going: Mapping[str, LumpingCandidate]) -> list[str]:
    """The links that go, from a link up to the one that stays."""
    way: list[str] = []
    while name in going:
        way.append(name)
        name = going[name].parent
    return way


def _host(name: str, going: Mapping[str, LumpingCandidate]) -> str:
    while name in going:
        name = going[name].parent
    return name


def _report(each: LumpingCandidate, why: str, place: EditContext) -> None:
    message = f"link {each.child!r} is not lumped into {each.parent!r}: {why}"
    place.sink.report(rules.LINK_NOT_LUMPED, message, each.joint.location, found=each.child)
