"""The trees of a file of MJCF as one model: what was one model before it was written, and has several roots."""

from twinform.compiler.input.mjcf.remainders import holder, with_rest
from twinform.compiler.input.mjcf.restore_contacts import with_contacts
from twinform.compiler.input.mjcf.usual_remainders import without_usual
from twinform.ir import Collision, Document, Frame, Joint, Link, Model, Node, Opaque, Pose, Visual, rewrite
from twinform.ir.frames import WORLD
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import (
    MADE_NAME,
    SAME_GEOM,
    annotate_synthesized,
    find_annotation,
    without_annotation,
)
from twinform.passes.carriers.old_names import NAME
from twinform.passes.legalise.to_mjcf.elements import make_element
from twinform.passes.legalise.to_mjcf.looks import look
from twinform.passes.shared.nodes import reserve_name


def one_model(document: Document, name: str) -> Model:
    """The links, joints and frames of all models of a document in one, whose frame is that of the world.

    A static tree hangs from the world by a fixed joint that is annotated as made. All orientations are roll, pitch and
    yaw; a quaternion comes back where a carrier says so. Remainders that are in every written file are gone, and what
    geoms say of contacts is noted.
    """
    world = document.worlds[0] if document.worlds else None
    models = world.models if world else document.models
    taken = {node.name for each in models for node in (*each.links, *each.joints, *each.frames)}
    links: list[Link] = []
    joints: list[Joint] = [*(world.joints if world else ())]
    frames: list[Frame] = [*(world.frames if world else ())]
    opaque: list[Opaque] = [*document.opaque]
    for each in models:
        links += [_placed(link, each.pose) for link in each.links]
        if each.static:
            above = {joint.child for joint in each.joints if joint.parent == WORLD}
            joints += [_held(link, taken) for link in each.links if _is_root(link) and link.name not in above]
        joints += each.joints
        frames += each.frames
        opaque += without_annotation(each, NAME, MADE_NAME).opaque
    source = world.source if world else models[0].source if models else document.source
    model = Model.unchecked(
        name=name,
        links=tuple(links),
        joints=tuple(joints),
        frames=tuple(frames),
        opaque=tuple(opaque),
        source=source,
    )

    def as_before(node: Node) -> Node:
        match node:
            case Pose():
                return _in_rpy(node)
            case Collision():
                return with_contacts(without_usual(node))
            case Link():
                return without_usual(_with_shapes_apart(node))
            case _:
                return without_usual(node) if node.opaque else node

    return rewrite(model, Node, as_before)


def _with_shapes_apart(link: Link) -> Link:
    """A link whose collisions are only seen where a visual says so: what is written has a geom for each.

    The color of a geom that is seen and touches stays with its collision.
    """
    twins = {each.name: each for each in link.visuals if find_annotation(each, SAME_GEOM) is not None}
    if not twins:
        return link
    return link.copy(
        visuals=tuple(each for each in link.visuals if each.name not in twins),
        collisions=tuple(_colored(each, twins.get(each.name)) for each in link.collisions),
    )


def _colored(collision: Collision, twin: Visual | None) -> Collision:
    rgba = look(twin).rgba if twin is not None else None
    if rgba is None:
        return collision
    return with_rest(collision, (holder(make_element("geom", [("rgba", rgba)])),))


def _is_root(link: Link) -> bool:
    """Whether a link stands in no other one: joints do not tell, as some of them close loops."""
    return link.pose is None or not link.pose.relative_to


def _placed(link: Link, at: Pose | None) -> Link:
    """A link of a model that has a pose, in the world; most links are posed in that of the body around them."""
    if at is None or not _is_root(link):
        return link
    placed = Transform.from_pose(_in_rpy(at)).compose(Transform.from_pose(link.pose and _in_rpy(link.pose)))
    return link.copy(pose=placed.to_pose())


def _held(link: Link, taken: set[str]) -> Joint:
    name = reserve_name(f"{link.name}_fixed_joint", taken)
    joint = Joint.unchecked(name=name, type="fixed", parent=WORLD, child=link.name, source=link.source)
    return annotate_synthesized(joint)


def _in_rpy(pose: Pose) -> Pose:
    if pose.quat_xyzw is None:
        return pose
    turn = Transform.from_pose(pose)
    rpy = None if turn.is_unturned else turn.rpy()
    return pose.copy(rpy=rpy, quat_xyzw=None, rotation_format=None)
