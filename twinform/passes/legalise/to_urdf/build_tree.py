"""Building one kinematic tree: choosing a root, cutting loops, connecting several roots."""

from typing import ClassVar

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
from twinform.passes.legalise.to_urdf.cut_joints import cut_joints
from twinform.passes.legalise.to_urdf.joint_tree import JointTree
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.joint_ends import joint_pose_attributes
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.pose_notation import POSE
from twinform.passes.structure.reversal import reroot_sdf


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
        for joint in model.joints:
            if find_annotation(joint, EXTENSION) is None:
                (kept if joint.type == "gearbox" or take_in(joint) else cut).append(joint.name)
        for joint in annotated:  # what nothing else holds needs it
            (kept if joint.parent != WORLD and tree.add(joint) else extensions).append(joint.name)
        model = _reversed(model, tree.turned, keeper)
        joints = {joint.name: without_annotation(joint, EXTENSION) for joint in model.joints}
        holding = {joint.child or "": joint for joint in map(joints.__getitem__, kept) if joint.type != "gearbox"}
        for name in cut:
            _report_cut(joints[name], holding.get(joints[name].child or ""), keeper)
        if cut or extensions:
            out = [joints[name] for name in (*extensions, *cut)]
            model = cut_joints(model, [joints[name] for name in kept], out, holding, keeper)
        roots = [link for link in model.links if link.name not in holding]
        first = _first_root(model, tree, keeper)
        return _hang(model, [link for link in roots if link.name != first], first, keeper)


def _reversed(model: Model, names: set[str], keeper: UrdfKeeper) -> Model:
    """The model with these joints reversed, each of which has an annotation that says so."""
    turned = [joint for joint in model.joints if joint.name in names]
    if not turned:
        return model
    model = reroot_sdf(model, turned)
    for joint in turned:
        message = f"joint {joint.name!r} is reversed: link {joint.child!r} hangs from another joint in URDF"
        keeper.account(rules.REVERSED_JOINT, message, joint.location, 2)
    before = {joint.name: joint for joint in turned}
    joints = (_annotated(each, before[each.name], keeper) if each.name in names else each for each in model.joints)
    return model.copy(joints=tuple(joints))


def _annotated(joint: Joint, before: Joint, keeper: UrdfKeeper) -> Joint:
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


def _hang(model: Model, roots: list[Link], first: str, keeper: UrdfKeeper) -> Model:
    if not roots:
        return model
    taken = {node.name for node in (*model.links, *model.joints)}
    joints = list(model.joints)
    kind = "fixed" if model.static else "floating"
    for link in roots:
        name = unique_name(f"{link.name}_{kind}_joint", taken)
        taken.add(name)
        made = Joint(name=name, type=kind, parent=first, child=link.name, source=link.source)
        joints.append(annotate_synthesized(made))
        message = f"link {link.name!r} is attached by a {kind} joint to {first!r}"
        keeper.sink.account(Fate.APPROXIMATED, rules.HUNG_ROOT, message, link.location, 0)
    return model.copy(joints=tuple(joints))
