"""Flattening nested models, which URDF does not have."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import Fate, rules
from twinform.ir import Format, Frame, Model, Opaque, count_parts
from twinform.ir.scopes import SCOPE, nested_models
from twinform.passes.carriers.annotations import with_annotation
from twinform.passes.carriers.carriers import NAMESPACE, to_element
from twinform.passes.legalise.changed_names import Names, renamed, with_old_names
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.flattening import differing_rests, flatten, settle_links, with_static_models_fixed
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import NESTED, POSE, pose_attributes


class FlattenForUrdf(ToUrdfPass):
    """Bring the links, joints and frames of nested models up into the model.

    Changes: 1. they are called `inner__name`, and what names them does so too, also where a file before 1.8 calls its
    parts `inner::name` without a model of that name; 2. a frame called `inner` stands for the
    nested model's own frame, and poses that were relative to it name it; 3. the roots in a static one are fixed to the
    world; 4. its `self_collide` and `enable_wind` are also those of its links, which Gazebo reads; 5. all else that the
    nested model has is carried on that frame.
    Diagnostics: `include-not-expanded` for includes in any of the models; in the ledger `nested-model`, and
    `nested-setting` where a nested model may rest and the outer one may not, or the other way round.
    """

    name: ClassVar[str] = "flatten-for-urdf"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model without models in it."""
        _refuse_includes(model, keeper)
        if keeper.sink.has_errors:
            return model
        flat = flat_model(model, keeper) if model.models else model
        names = _legal_names(flat)
        if not names:
            return flat
        flat = renamed(flat, names, Format.SDF)
        return with_old_names(flat, names) if keeper.carriers else flat


def flat_model(model: Model, keeper: UrdfKeeper) -> Model:
    """The model without models in it: their parts have scoped names, and annotated frames stand for the models."""
    for nested, message in differing_rests(model):
        where = nested.location.at("allow_auto_disable")
        keeper.sink.account(Fate.APPROXIMATED, rules.NESTED_SETTING, f"{message}: Gazebo reads the outer one", where, 0)
    settled = settle_links(model, annotated=keeper.carriers)
    return flatten(with_static_models_fixed(settled), partial(_keep_settings, keeper))


def _keep_settings(keeper: UrdfKeeper, frame: Frame, shell: Model) -> Frame:
    """The frame of a nested model with all else that the model has; its pose is the frame's."""
    message = f"nested model {frame.name!r} is flattened"
    keeper.account(rules.NESTED_MODEL, message, shell.location, count_parts(shell))
    if not keeper.carriers:
        return frame
    own = to_element(shell.copy(pose=None), "model", "sdf")
    attributes = tuple(pair for pair in own.attributes if pair[0] != "name")
    annotation = own.copy(name=f"{{{NAMESPACE}}}{NESTED}", attributes=attributes)
    frame = frame.copy(opaque=(*frame.opaque, Opaque.unchecked(element=annotation)))
    written = pose_attributes(shell.pose)
    if "relative_to" in written and frame.pose:
        written["relative_to"] = frame.pose.relative_to  # by its name in the outermost model
    return with_annotation(frame, POSE, attributes=written) if written else frame


def _legal_names(model: Model) -> Names:
    """What the parts of nested models are called in URDF, whose readers take `::` for something else."""
    taken = {node.name for field in ("links", "joints", "frames") for node in getattr(model, field)}
    names: Names = {}
    for part, field in (("link", "links"), ("joint", "joints"), ("frame", "frames")):
        for node in getattr(model, field):
            if SCOPE in node.name:
                # libsdformat refuses `::` in a URDF (it writes SDF of a version where that is a
                # scope).
                names[part, node.name] = reserve_name(node.name.replace(SCOPE, "__"), taken)
    return names


def _refuse_includes(model: Model, keeper: UrdfKeeper) -> None:
    for each in nested_models(model):
        for include in each.includes:
            message = f"model {each.name!r} includes {include.uri!r}, which was not read"
            keeper.sink.report(rules.INCLUDE_NOT_EXPANDED, message, include.location, found=include.uri)
