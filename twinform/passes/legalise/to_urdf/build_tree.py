"""Building one kinematic tree: choosing a root, cutting loops, connecting several roots."""

from dataclasses import field
from typing import ClassVar, NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import Fate, rules
from twinform.ir import Joint, Link, Model, count_parts
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.passes.carriers.annotations import (
    EXTENSION,
    REVERSED,
    annotate_synthesized,
    find_annotation,
    without_annotation,
)
from twinform.passes.legalise.cut_joints import cut_joints
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.joint_ends import joint_pose_attributes
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import POSE
from twinform.passes.structure.reversal import REVERSIBLE, measures_in_sensor, reroot_sdf


class _Above(NamedTuple):
    """The joint that a link hangs from, and the link, or `world`, at its other end."""

    joint: Joint
    parent: str


@dataclass(slots=True)
class _Way:
    """A path from a link towards its root, as far as it was walked."""

    start: str
    end: str
    links: list[str] = field(default_factory=list[str])


class JointTree:
    """Joints added so that each link hangs from at most one; `turned` are the names of joints to reverse.

    Adding all joints takes nearly linear time: of two paths that can be reversed the shorter one is, and the links of
    a path that cannot be reversed are remembered.
    """

    def __init__(self, links: list[str]) -> None:
        self.turned: set[str] = set()
        self._above: dict[str, _Above] = {}
        self._stuck = {WORLD}
        """Links that cannot become a root: the world, or a joint that is not reversible, is above them."""
        self._group = {name: name for name in (*links, WORLD)}

    def add(self, joint: Joint) -> bool:
        """Add a joint as it is, unless its child hangs from another joint or it closes a circle."""
        parent, child = joint.parent or WORLD, joint.child or ""
        if child in self._above or self._find(parent) == self._find(child):
            return False
        self._hang(child, _Above(joint, parent))
        return True

    def join(self, joint: Joint) -> bool:
        """Add a joint, reversing joints where needed; returns False if it closes a circle or none can be reversed."""
        if self.add(joint):
            return True
        parent, child = joint.parent or WORLD, joint.child or ""
        if self._find(parent) == self._find(child):
            return False
        way = self._shorter_way(child, parent if _is_reversible(joint) else WORLD)
        if way is None:
            return False
        self._reverse(way)
        if way.start == child:
            self._hang(child, _Above(joint, parent))
        else:
            self.turned ^= {joint.name}
            self._hang(parent, _Above(joint, child))
        return True

    def root(self, link: str) -> str:
        """The root of the tree that a link is in, which may be `world`."""
        while link in self._above:
            link = self._above[link].parent
        return link

    def holds_any(self, link: str) -> bool:
        """Whether something hangs from a link, or from `world`."""
        return any(above.parent == link for above in self._above.values())

    def _hang(self, link: str, above: _Above) -> None:
        self._above[link] = above
        self._group[self._find(link)] = self._find(above.parent)

    def _shorter_way(self, *links: str) -> _Way | None:
        """The path to the root from the link with fewer joints above it; None where neither can be reversed."""
        # Both ways are walked in turns, so that the work is that of the shorter one.
        ways = [_Way(link, link) for link in links]
        while ways:
            for way in tuple(ways):
                if way.end in self._stuck:
                    self._stuck.update(way.links)
                    ways.remove(way)
                    continue
                above = self._above.get(way.end)
                if above is None:
                    return way
                way.links.append(way.end)
                way.end = above.parent if _is_reversible(above.joint) else WORLD
        return None

    def _reverse(self, way: _Way) -> None:
        """Reverse all joints of a path, so that its end hangs from its start."""
        joints = [self._above.pop(link) for link in way.links]
        for link, above in zip(way.links, joints, strict=True):
            self.turned ^= {above.joint.name}
            self._above[above.parent] = _Above(above.joint, link)

    def _find(self, name: str) -> str:
        group = self._group
        while group[name] != name:
            group[name] = name = group[group[name]]
        return name


def _is_reversible(joint: Joint) -> bool:
    return joint.type in REVERSIBLE and not measures_in_sensor(joint)


class BuildTree(ToUrdfPass):
    """Cut loops and connect what is not connected.

    Changes: 1. where a second joint has a link as its child and closes no circle, as few joints as possible are
    reversed, exactly, so that each link hangs from one; 2. of joints that close a circle, or cannot be reversed, the
    first ones in the file stay; each of the others becomes a `<joint>` in a `<gazebo>` element, with its pose in the
    child's frame of URDF, and so does one that a conversion from URDF found there, if it is not all that holds a link;
    a floating one goes; 3. a root beside the first one hangs from it by a `floating` joint. The first root is `world`
    where a joint has it as its parent, else the one that the canonical link hangs from; 4. in a static model every root
    is fixed to `world`, but not the first one of a model that came from URDF, where `<static>` is set.
    Never touches: gearboxes, which hold no link.
    Diagnostics: `cut-loop`; in the ledger `cut-loop`, `reversed-joint` and `hung-root`.
    """

    name: ClassVar[str] = "build-tree"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with its joints in a tree."""
        tree = JointTree([link.name for link in model.links])
        kept: list[str] = []
        cut: list[str] = []
        extensions: list[str] = []
        annotated = [joint for joint in model.joints if find_annotation(joint, EXTENSION)]
        geared = any(joint.type == "gearbox" for joint in model.joints)  # gearboxes know the joints by their ends
        take_in = tree.add if geared else tree.join
        # Floating ones first: those that were in URDF are in no `<gazebo>`, which has no such joint.
        for joint in sorted(model.joints, key=lambda joint: joint.type != "floating"):
            if find_annotation(joint, EXTENSION) is None:
                (kept if joint.type == "gearbox" or take_in(joint) else cut).append(joint.name)
        for joint in annotated:  # what nothing else holds needs it
            (kept if joint.parent != WORLD and tree.add(joint) else extensions).append(joint.name)
        places = {joint.name: place for place, joint in enumerate(model.joints)}
        kept.sort(key=places.__getitem__)
        model = _reverse_joints(model, tree.turned, keeper)
        joints = {joint.name: joint for joint in model.joints}
        holding = {joint.child or "": joint for joint in map(joints.__getitem__, kept) if joint.type != "gearbox"}
        for name in cut:
            _report_cut(joints[name], holding.get(joints[name].child or ""), keeper)
        if cut or extensions:
            out = [joints[name] for name in (*extensions, *cut)]
            kept_joints = [without_annotation(joints[name], EXTENSION) for name in kept]
            model = cut_joints(model, kept_joints, out, holding, keeper)
        roots = [link for link in model.links if link.name not in holding]
        first = _first_root(model, tree, keeper)
        return _hang_roots(model, [link for link in roots if link.name != first], first, keeper)


def _reverse_joints(model: Model, names: set[str], keeper: UrdfKeeper) -> Model:
    """The model with the named joints reversed and annotated."""
    turned = [joint for joint in model.joints if joint.name in names]
    if not turned:
        return model
    model = reroot_sdf(model, turned)
    for joint in turned:
        message = f"joint {joint.name!r} is reversed: link {joint.child!r} hangs from another joint in URDF"
        keeper.account(rules.REVERSED_JOINT, message, joint.location, 2)
    before = {joint.name: joint for joint in turned}
    joints = (
        _annotate_reversed(each, before[each.name], keeper) if each.name in names else each for each in model.joints
    )
    return model.copy(joints=tuple(joints))


def _annotate_reversed(joint: Joint, before: Joint, keeper: UrdfKeeper) -> Joint:
    # A word and no copy: reversing again is exact whatever was edited in between.
    joint = keeper.annotate(joint, REVERSED, always=True)
    attributes = joint_pose_attributes(before)
    return keeper.annotate(joint, POSE, attributes=attributes) if attributes else joint


def _first_root(model: Model, tree: JointTree, keeper: UrdfKeeper) -> str:
    # Readers without Gazebo's extensions learn from the joint to `world` that nothing moves. A
    # model that came from URDF had <static> in an extension and hung from nothing.
    if (model.static and not keeper.back) or tree.holds_any(WORLD):
        return WORLD
    return tree.root(FrameGraph(model).body(MODEL, kind="model"))


def _report_cut(joint: Joint, closed: Joint | None, keeper: UrdfKeeper) -> None:
    message = f"joint {joint.name!r} closes a loop at link {joint.child!r}"
    related = (closed.location,) if closed else ()
    keeper.sink.report(rules.CUT_LOOP, message, joint.location, found=joint.child, related=related)
    keeper.sink.account(Fate.CARRIED, rules.CUT_LOOP, message, joint.location, count_parts(joint))


def _hang_roots(model: Model, roots: list[Link], first: str, keeper: UrdfKeeper) -> Model:
    if not roots:
        return model
    taken = {node.name for node in (*model.links, *model.joints)}
    joints = list(model.joints)
    kind = "fixed" if model.static else "floating"
    for link in roots:
        name = reserve_name(f"{link.name}_{kind}_joint", taken)
        made = Joint.unchecked(name=name, type=kind, parent=first, child=link.name, source=link.source)
        joints.append(annotate_synthesized(made))
        message = f"link {link.name!r} is attached by a {kind} joint to {first!r}"
        keeper.sink.account(Fate.APPROXIMATED, rules.HUNG_ROOT, message, link.location, 0)
    return model.copy(joints=tuple(joints))
