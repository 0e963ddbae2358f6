"""A root link called `world`: the world of SDF, which has no body, and a link on it with the body that URDF wrote."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Format, Joint, Link, Model, Opaque, Pose, count_parts
from twinform.ir.frames import MODEL, WORLD
from twinform.passes.carriers.annotations import (
    annotate_synthesized,
    find_annotation,
    is_synthesized,
    with_annotation,
    without_annotation,
)
from twinform.passes.carriers.carriers import Keeper, carry, is_carrier, to_element, unpack
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import fixed_joint_name, renamed
from twinform.passes.legalise.free_links import links_in_static_models, needs_no_joint
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import BODY

OF_WORLD = "of-world"
"""The annotation on a link of SDF that has the body of the link `world` in URDF, while it is still called so."""


class WorldLink(ModelPass):
    """Replace a root link called `world` by SDF's world.

    Changes: 1. the link goes; 2. poses of joints in its frame are in the model frame, which a robot has at the world's
    origin when it is fixed to it; 3. its shapes, sensors and lights are on a link of their own that is fixed there. A
    mass without any of these is carried, or dropped with `carriers` false: what stands still needs none.
    Never touches: a link called `world` that is a joint's child; `unique-names` renames it.
    Diagnostics: `world-link` when the link has a body.
    """

    name: ClassVar[str] = "world-link"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with `world` as a parent only."""
        world = next((link for link in model.links if link.name == WORLD), None)
        if (
            world is None
            or find_annotation(world, BODY) is not None
            or any(joint.child == WORLD for joint in model.joints)
            # A robot of nothing but a link "world" would be an empty model, which SDF refuses.
            or len(model.links) == 1
        ):
            return model
        links = tuple(link for link in model.links if link is not world)
        joints = tuple(_pose_in_model(joint) for joint in model.joints)
        model = model.copy(links=links, joints=joints)
        held = links_in_static_models(model)
        if not any(joint.parent == WORLD and not needs_no_joint(joint, held) for joint in joints):
            message = "nothing is fixed to the link 'world', and SDF always has a world"
            Keeper(sink, self.carriers).account(rules.URDF_ONLY, message, world.location, count_parts(world))
        own = tuple(piece for part in world.opaque for piece in (unpack(part) if is_carrier(part, "urdf") else (part,)))
        if any((world.visuals, world.collisions, world.sensors, world.lights)):
            return self._put_on_a_link(model, world, sink)
        body = world.copy(opaque=own)
        return self._keep_body(model, body, sink) if count_parts(body) > 2 else model

    def _put_on_a_link(self, model: Model, world: Link, sink: DiagnosticSink) -> Model:
        taken = {each.name for each in (*model.links, *model.joints, *model.frames)}
        name = reserve_name(f"{WORLD}_link", taken)
        message = f"the link 'world' has a body, which SDF's world cannot have: link {name!r} has it"
        sink.report(rules.WORLD_LINK, message, world.location)
        Keeper(sink, self.carriers).account(rules.WORLD_LINK, message, world.location.at("@name"), 1)
        joint = Joint.unchecked(
            name=reserve_name(fixed_joint_name(name), taken),
            type="fixed",
            parent=WORLD,
            child=name,
            pose=Pose.unchecked(relative_to=MODEL),
            source=world.source,
        )
        link = with_annotation(world, OF_WORLD, WORLD, {"instead_of": name}) if self.carriers else world
        links = (link.copy(name=name), *model.links)
        return model.copy(links=links, joints=(annotate_synthesized(joint), *model.joints))

    def _keep_body(self, model: Model, world: Link, sink: DiagnosticSink) -> Model:
        message = "the link 'world' has a body, which SDF's world cannot have"
        sink.report(rules.WORLD_LINK, message, world.location)
        Keeper(sink, self.carriers).account(rules.WORLD_LINK, message, world.location, count_parts(world))
        if not self.carriers:
            return model
        return carry(model, [Opaque.unchecked(element=to_element(world, "link", "urdf"))], "urdf")


def _pose_in_model(joint: Joint) -> Joint:
    if joint.parent != WORLD or joint.pose is None:
        return joint
    # A robot that hangs from the world stands at the world's origin, so its frame and the model's
    # are one.
    return joint.copy(pose=joint.pose.copy(relative_to=MODEL))


class RestoreWorldLink(ToUrdfPass):
    """Put the body that a link `world` had in URDF back on it.

    Changes: a link that is annotated as the body of the world becomes the link `world`, without the joint that was made
    for it; what names it follows.
    Never touches: one that was renamed, that something else than this joint holds by now, or that stands elsewhere.
    Diagnostics: none.
    """

    name: ClassVar[str] = "restore-world-link"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model whose link `world` has its body."""
        del keeper
        body = next(filter(_is_body_of_world, model.links), None)
        world = next((each for each in model.links if each.name == WORLD), Link.unchecked(name=WORLD))
        if body is None or count_parts(world) > 2:
            return model
        holds = [each for each in model.joints if each.child == body.name]
        if not all(each.parent == WORLD and is_synthesized(each) and _is_at_origin(each) for each in holds):
            return model
        links = (without_annotation(each, OF_WORLD) if each is body else each for each in model.links)
        bare = model.copy(
            links=tuple(each for each in links if each is not world),
            joints=tuple(each for each in model.joints if each not in holds),
        )
        return renamed(bare, {("link", body.name): WORLD}, Format.URDF)


def _is_body_of_world(link: Link) -> bool:
    found = find_annotation(link, OF_WORLD)
    return found is not None and found.get("instead_of") == link.name


def _is_at_origin(joint: Joint) -> bool:
    return joint.type == "fixed" and (joint.pose is None or joint.pose.copy(relative_to=None) == Pose.unchecked())
