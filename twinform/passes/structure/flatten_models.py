"""Flatten nested models into one model."""

from itertools import islice
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import INCLUDE_NOT_EXPANDED
from twinform.ir import Document, Format, Frame, Model, World
from twinform.ir.frames import MODEL, FrameGraph
from twinform.ir.scopes import SCOPE, nested_models, nested_names, scoped_models
from twinform.passes.carriers.annotations import without_synthesized
from twinform.passes.shared.flattening import differing_rests, flatten, settle_links, with_static_models_fixed
from twinform.passes.shared.joint_ends import report_self_joint, resolve_ends
from twinform.passes.structure.model_edit import EditContext, ModelEdit
from twinform.passes.structure.rename_parts import (
    Part,
    RenamedScope,
    follow_references,
    prefixed_scope,
    rename_in_world,
    rename_model,
    report_clashes,
    scope_of,
)

_LAST_WITH_COLONS = "1.7"
"""The last version of SDF in which names may contain `::`."""


class FlattenModels(ModelEdit):
    """Bring the links, joints and frames of nested models up into the model around them.

    Changes: 1. they are called `inner_name`, with `separator` between, and what names them follows; 2. a frame called
    `inner` stands for the nested model's own, and poses that were relative to it name it; 3. plugins and other parts of
    the nested model become those of the outer one, with names followed; its `self_collide` and `enable_wind` become
    those of its links; 4. the roots of a static one are fixed to the world, unless the outer model is static; 5. joints
    and frames of the world that name what was nested follow. With `separator="::"` names
    are as libsdformat writes them before 1.8, with the frame called `inner::__model__`, and the result is SDF 1.7,
    since later versions forbid `::` in names.
    Never touches: where anything is; URDF, which has no models in models.
    Diagnostics: `include-not-expanded`; `nested-setting` where a nested model may rest and the outer one may not, or
    the other way round; `self-joint`; `name-clash`; `unfollowed-name`.
    """

    name: ClassVar[str] = "flatten-models"
    example: ClassVar[str] = "flatten-models{separator=__}"

    separator: str = Field(default="_", min_length=1, description="The separator between the names.")

    def edit(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without models in models."""
        made = super().edit(document, sink)
        if made is document or self.separator != SCOPE or sink.has_errors:
            return made
        from twinform.passes.sdf_versions import change_version  # noqa: PLC0415 - this case alone needs it

        for step in change_version(made.version, _LAST_WITH_COLONS):
            made = step.run(made, sink)
        return made

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model without models in it."""
        if place.format is Format.URDF or not model.models or _report_includes(model, place.sink):
            return model
        _report_settings(model, place)
        flat = without_synthesized(flatten(with_static_models_fixed(settle_links(model)), _keep_frame))
        flat = _add_contents(flat, model, place)
        if _report_self_joints(flat, place.sink):
            return model
        scope = self._scope(flat, model)
        if self.separator != SCOPE and report_clashes(flat, scope, place.format, place.sink):
            return model
        return rename_model(flat, scope, place.format, place.sink)

    def _scope(self, flat: Model, model: Model) -> RenamedScope:
        """The new names for the parts of a flattened model."""
        stand_ins = set(nested_names(model))  # so are the frames called that stand for them

        def choose(part: Part, name: str) -> str:
            if self.separator != SCOPE:
                return name.replace(SCOPE, self.separator)
            return f"{name}{SCOPE}{MODEL}" if part == "frame" and name in stand_ins else name

        return scope_of(flat, choose)

    def update_world(self, before: World, after: World) -> World:
        """The world, whose joints and frames follow the new names."""

        def scope(model: Model) -> RenamedScope:
            return self._scope(flatten(model, _keep_frame) if model.models else model, model)

        return rename_in_world(before, after, scope, self.model)


def _keep_frame(frame: Frame, shell: Model) -> Frame:
    del shell
    return frame


def _report_includes(model: Model, sink: DiagnosticSink) -> bool:
    """Report includes that were not read; whether there are any."""
    found = [(each, include) for each in nested_models(model) for include in each.includes]
    for each, include in found:
        message = f"model {each.name!r} includes {include.uri!r}, which was not read"
        help_ = "convert with --expand-includes"
        sink.report(INCLUDE_NOT_EXPANDED, message, include.location, found=include.uri, help=help_)
    return bool(found)


def _report_self_joints(model: Model, sink: DiagnosticSink) -> bool:
    """Report joints of a link with itself, which libsdformat accepts only in nested models."""
    graph, found = FrameGraph(model), False
    links = {link.name for link in model.links}
    for joint in model.joints:
        resolved, _ = resolve_ends(joint, links, graph)
        if resolved.parent == resolved.child:
            report_self_joint(joint, resolved, sink)
            found = True
    return found


def _report_settings(model: Model, place: EditContext) -> None:
    for nested, message in differing_rests(model):
        where, value = nested.location.at("allow_auto_disable"), str(nested.allow_auto_disable).lower()
        place.sink.report(rules.NESTED_SETTING, message, where, found=value)


def _add_contents(flat: Model, model: Model, place: EditContext) -> Model:
    """The flat model with plugins and untyped parts of its nested models, in which the new names are used."""
    plugins, opaque = list(model.plugins), list(model.opaque)
    for prefix, nested in islice(scoped_models(model), 1, None):
        scope = prefixed_scope(nested, prefix)
        rest = Model(name=nested.name, plugins=nested.plugins, opaque=nested.opaque, source=nested.source)
        contents = follow_references(rest, scope, place.format, place.sink)
        plugins += contents.plugins
        opaque += [part for part in contents.opaque if part.element is not None]
    return flat.copy(plugins=tuple(plugins), opaque=tuple(opaque))
