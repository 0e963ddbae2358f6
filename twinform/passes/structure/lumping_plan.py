"""Planning of fixed-joint lumping: which links are merged into which, and which have to stay."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping

from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.ir import Joint, Link, Model
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.passes.framework.pass_base import matches
from twinform.passes.structure.model_edit import EditContext

Obstacle = Callable[[Joint, Link, Link], str | None]
"""Why a joint cannot lump its child (the last link) into its parent; None where it can."""


@dataclass(frozen=True, slots=True)
class LumpingPlan:
    """The joints that are removed, by the names of their children, and the link that each child goes into, its host."""

    joints: Mapping[str, Joint]
    hosts: Mapping[str, str]

    def guests(self) -> dict[str, list[str]]:
        """The links that go into each host: parents before children, and these in the order of joints."""
        below: dict[str, list[str]] = {}
        for child, joint in self.joints.items():
            below.setdefault(joint.parent or "", []).append(child)
        return {host: list(_links_below(host, below)) for host in dict.fromkeys(self.hosts.values())}


def _links_below(name: str, below: Mapping[str, list[str]]) -> Iterator[str]:
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


def plan_lumping(
    model: Model, graph: FrameGraph, keep: tuple[str, ...], obstacle: Obstacle, place: EditContext
) -> LumpingPlan:
    """The links that can be lumped; each link that cannot is reported."""
    links = {link.name: link for link in model.links}
    ends = [
        LumpingCandidate(joint, _body_of(joint.parent, links, graph), _body_of(joint.child, links, graph))
        for joint in model.joints
    ]
    # A gearbox couples two joints and holds no link.
    carried = Counter(each.child for each in ends if each.joint.type != "gearbox")
    going: dict[str, LumpingCandidate] = {}
    for each in ends:
        if each.joint.type != "fixed" or each.child not in links or each.parent == WORLD or _is_kept(each, keep):
            continue
        why = _find_obstacle(each, links, carried, obstacle)
        if why is None:
            going[each.child] = each
        elif why:
            _report_obstacle(each, why, place)
    for name in _links_in_circles(going):
        _report_obstacle(going.pop(name), "fixed joints go round in a circle there", place)
    _keep_links_held_apart(going, ends, place)
    return LumpingPlan(
        {name: each.joint.copy(parent=each.parent) for name, each in going.items()},
        {name: _host_of(name, going) for name in going},
    )


def _body_of(name: str | None, links: Mapping[str, Link], graph: FrameGraph) -> str:
    if not name or name in links or name == WORLD:
        return name or ""
    try:
        return graph.body(name)
    except FrameError:  # it is in the model of an include that was not read
        return name


def _is_kept(each: LumpingCandidate, keep: tuple[str, ...]) -> bool:
    return matches(each.child, keep) or matches(each.joint.name, keep)


def _find_obstacle(
    each: LumpingCandidate, links: Mapping[str, Link], carried: Counter[str], obstacle: Obstacle
) -> str | None:
    if each.parent not in links:
        return f"{each.parent!r}, which it is fixed to, is in another model"
    if carried[each.child] > 1:
        return "it is the child of several joints"
    return obstacle(each.joint, links[each.parent], links[each.child])


def _links_in_circles(going: Mapping[str, LumpingCandidate]) -> list[str]:
    """The links from which parents lead round in a circle."""
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


def _keep_links_held_apart(
    going: dict[str, LumpingCandidate], ends: list[LumpingCandidate], place: EditContext
) -> None:
    """Keep links that another joint connects, which would otherwise connect one link with itself."""
    while True:
        same = next((each for each in ends if _would_join_itself(each, going)), None)
        if same is None:
            return
        why = f"joint {same.joint.name!r} would connect one link with itself"
        for name in dict.fromkeys((*_links_to_host(same.child, going), *_links_to_host(same.parent, going))):
            _report_obstacle(going.pop(name), why, place)


def _would_join_itself(each: LumpingCandidate, going: Mapping[str, LumpingCandidate]) -> bool:
    if each.child in going and going[each.child] is each:
        return False
    return each.parent != each.child and _host_of(each.parent, going) == _host_of(each.child, going)


def _links_to_host(name: str, going: Mapping[str, LumpingCandidate]) -> list[str]:
    """The lumped links from a link up to its host."""
    way: list[str] = []
    while name in going:
        way.append(name)
        name = going[name].parent
    return way


def _host_of(name: str, going: Mapping[str, LumpingCandidate]) -> str:
    while name in going:
        name = going[name].parent
    return name


def _report_obstacle(each: LumpingCandidate, why: str, place: EditContext) -> None:
    message = f"link {each.child!r} is not lumped into {each.parent!r}: {why}"
    place.sink.report(rules.LINK_NOT_LUMPED, message, each.joint.location, found=each.child)
