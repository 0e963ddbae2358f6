"""Converting a root link called `world` to the world of SDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Joint, Link, Model, Opaque, count_parts
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import Keeper, carry, is_carrier, to_element, unpack
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.free_links import links_in_static_models, needs_no_joint
from twinform.passes.shared.poses import BODY


class WorldLink(ModelPass):
    """Replace a root link called `world` by SDF's world.

    Changes: 1. the link goes; 2. poses of joints in its frame are in the model frame, which a robot has at the world's
    origin when it is fixed to it. A body of the link is carried, or dropped with `carriers` false.
    Never touches: a link called `world` that is a joint's child; `unique-names` renames it.
    Diagnostics: `world-link` when the link has a body.
    """

    name: ClassVar[str] = "world-link"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with `world` as a parent only."""
        world = next((link for link in model.links if link.name == "world"), None)
        if (
            world is None
            or find_annotation(world, BODY) is not None
            or any(joint.child == "world" for joint in model.joints)
            # A robot of nothing but a link "world" would be an empty model, which SDF refuses.
            or len(model.links) == 1
        ):
            return model
        links = tuple(link for link in model.links if link is not world)
        joints = tuple(_pose_in_model(joint) for joint in model.joints)
        model = model.copy(links=links, joints=joints)
        held = links_in_static_models(model)
        if not any(joint.parent == "world" and not needs_no_joint(joint, held) for joint in joints):
            message = "nothing is fixed to the link 'world', and SDF always has a world"
            Keeper(sink, self.carriers).account(rules.URDF_ONLY, message, world.location, count_parts(world))
        own = tuple(piece for part in world.opaque for piece in (unpack(part) if is_carrier(part, "urdf") else (part,)))
        body = world.copy(opaque=own)
        return self._keep_body(model, body, sink) if count_parts(body) > 2 else model

    def _keep_body(self, model: Model, world: Link, sink: DiagnosticSink) -> Model:
        message = "the link 'world' has a body, which SDF's world cannot have"
        sink.report(rules.WORLD_LINK, message, world.location)
        Keeper(sink, self.carriers).account(rules.WORLD_LINK, message, world.location, count_parts(world))
        if not self.carriers:
            return model
        return carry(model, [Opaque.unchecked(element=to_element(world, "link", "urdf"))], "urdf")


def _pose_in_model(joint: Joint) -> Joint:
    if joint.parent != "world" or joint.pose is None:
        return joint
    # A robot that hangs from the world stands at the world's origin, so its frame and the model's
    # are one.
    return joint.copy(pose=joint.pose.copy(relative_to="__model__"))
