"""Building one kinematic tree: choosing a root, cutting loops, connecting several roots."""

from typing import ClassVar

from twinform.diagnostics import Fate
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Joint, Link, Model, count_parts
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.passes.carriers.annotations import EXTENSION, annotate_synthesized, find_annotation, without_annotation
from twinform.passes.legalise.to_urdf.base import Keeper, ToUrdfPass
from twinform.passes.legalise.to_urdf.cut_joints import cut_joints
from twinform.passes.transforms.nodes import unique_name


class BuildTree(ToUrdfPass):
    """Cut loops and connect what is not connected.

    Changes: 1. of several joints with one child, and of joints that close a circle, the first ones in the file stay;
    each of the others becomes a `<joint>` in a `<gazebo>` element, with its pose in the child's frame of URDF, and so
    does one that a conversion from URDF found there, if it is not all that holds a link; a floating one goes; 2. a
    root beside the first one hangs from it by a `floating` joint. The first root is `world` where a joint has it as its
    parent, else the one that the canonical link hangs from; 3. in a static model every root is fixed to `world`, but
    not the first one of a model that came from URDF, where `<static>` is set.
    Never touches: gearboxes, which hold no link.
    Diagnostics: `cut-loop`; in the ledger `cut-loop` and `hung-root`.
    """

    name: ClassVar[str] = "build-tree"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with its joints in a tree."""
        tree = Tree([link.name for link in model.links])
        kept: list[Joint] = []
        cut: list[Joint] = []
        extensions: list[Joint] = []
        annotated = [joint for joint in model.joints if find_annotation(joint, EXTENSION)]
        for joint in model.joints:
            if find_annotation(joint, EXTENSION) is None:
                (kept if joint.type == "gearbox" or tree.add(joint) else cut).append(joint)
        for joint in (without_annotation(joint, EXTENSION) for joint in annotated):  # what nothing else holds needs it
            (kept if joint.parent != WORLD and tree.add(joint) else extensions).append(joint)
        for joint in cut:
            _report_cut(joint, tree.parent_joint.get(joint.child or ""), keeper)
        if cut or extensions:
            model = cut_joints(model, kept, [*extensions, *cut], tree.parent_joint)
        roots = [link for link in model.links if link.name not in tree.parent_joint]
        first = _first_root(model, tree, keeper)
        return _hang(model, [link for link in roots if link.name != first], first, keeper)


class Tree:
    """The joints that make a forest, as far as they were added; `parent_joint` is by the name of the child."""

    def __init__(self, links: list[str]) -> None:
        self.parent_joint: dict[str, Joint] = {}
        self._group = {name: name for name in (*links, WORLD)}

    def add(self, joint: Joint) -> bool:
        """Take a joint in, unless it closes a loop."""
        parent, child = joint.parent or WORLD, joint.child or ""
        if child in self.parent_joint or self._find(parent) == self._find(child):
            return False
        self.parent_joint[child] = joint
        self._group[self._find(child)] = self._find(parent)
        return True

    def root(self, link: str) -> str:
        """The link, or `world`, that a link hangs from in the end."""
        while link in self.parent_joint:
            link = self.parent_joint[link].parent or WORLD
        return link

    def _find(self, name: str) -> str:
        group = self._group
        while group[name] != name:
            group[name] = name = group[group[name]]
        return name


def _first_root(model: Model, tree: Tree, keeper: Keeper) -> str:
    if (model.static and not keeper.back) or any(joint.parent == WORLD for joint in tree.parent_joint.values()):
        return WORLD
    return tree.root(FrameGraph(model).body(MODEL, kind="model"))


def _report_cut(joint: Joint, closed: Joint | None, keeper: Keeper) -> None:
    message = f"joint {joint.name!r} closes a loop at link {joint.child!r}"
    related = (closed.location,) if closed else ()
    keeper.sink.report(rules.CUT_LOOP, message, joint.location, found=joint.child, related=related)
    keeper.sink.account(Fate.CARRIED, rules.CUT_LOOP, message, joint.location, count_parts(joint))


def _hang(model: Model, roots: list[Link], first: str, keeper: Keeper) -> Model:
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
    return model.model_copy(update={"joints": tuple(joints)})
