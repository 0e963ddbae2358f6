"""Migration outside plugins and sensors: material scripts, `<ros2_control>` hardware, emptied `<gazebo>` elements."""

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Document, Element, Format, GazeboExtension, Model, replace_fields, rewrite
from twinform.passes.classic.element_edits import text_at, with_text
from twinform.passes.classic.tables import hardware_names
from twinform.passes.control.carried_elements import as_parts, elements, place_of, replace
from twinform.passes.framework.pass_registry import find_pass, registered_passes
from twinform.passes.plugins.catalog_types import Release

_MATERIALS = "materials"
# Fortress, whose ros2_control plugin has names of its own.
_OWN_NAMES = 6
_PLUGIN = "hardware/plugin"


def in_colors(document: Document, sink: DiagnosticSink) -> Document:
    """The document with material scripts as colors, by the pass that knows them, where it is installed."""
    return find_pass(_MATERIALS)().run(document, sink) if _MATERIALS in registered_passes() else document


def modern_hardware(document: Document, release: Release, sink: DiagnosticSink) -> Document:
    """The document with the simulator's hardware in `<ros2_control>` under the name for a release."""
    if release.sim <= _OWN_NAMES:
        return document
    return rewrite(document, Model, lambda model: _with_modern_hardware(model, document.format, sink))


def _with_modern_hardware(model: Model, format_: Format, sink: DiagnosticSink) -> Model:
    names, result = hardware_names(), model
    for part, system in list(elements(model, format_, "ros2_control")):
        old = text_at(system, _PLUGIN)
        if old is None or old not in names:
            continue
        where = place_of(part, model)
        message = f"the hardware of ros2_control {system.get('name')!r} is {names[old]} now, and was {old}"
        sink.report(rules.MIGRATED_PLUGIN, message, where, found=old)
        sink.account(Fate.APPROXIMATED, rules.MIGRATED_PLUGIN, message, where.at("hardware/plugin"))
        changed: Element = with_text(system, _PLUGIN, names[old])
        result = replace(result, (part,), as_parts([changed], format_), after=part)
    return result


def without_emptied(before: Document, after: Document) -> Document:
    """The document without the `<gazebo>` elements from which everything has gone; empty ones of the source stay."""
    if before is after:
        return after
    return replace_fields(after, models=tuple(map(_without_emptied, before.models, after.models)))


def _without_emptied(before: Model, after: Model) -> Model:
    pairs = zip(before.extensions, after.extensions, strict=True)
    return replace_fields(after, extensions=tuple(new for old, new in pairs if not _is_emptied(old, new)))


def _is_emptied(before: GazeboExtension, after: GazeboExtension) -> bool:
    # A <gazebo> that was empty in the source stays: only what this migration emptied is cleared
    # away.
    return bool(before.content) and not after.content and not after.opaque
