"""The hardware of `<ros2_control>` that simulators bring, under the name that it has now."""

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import classic as rules
from twinform.ir import Document, Element, Format, Model, rewrite
from twinform.passes.classic.element_edits import text_at, with_text
from twinform.passes.classic.tables import hardware_names
from twinform.passes.control.carried_elements import as_parts, elements, place_of, replace
from twinform.passes.plugins.parts import Release

_OWN_NAMES = 6
"""The version of gz-sim, Fortress, whose ros2_control has names of its own."""
_PLUGIN = "hardware/plugin"


def modern_hardware(document: Document, release: Release, sink: DiagnosticSink) -> Document:
    """The document with the simulator's hardware in `<ros2_control>` under the name for a release."""
    if release.sim <= _OWN_NAMES:
        return document
    return rewrite(document, Model, lambda model: _in_model(model, document.format, sink))


def _in_model(model: Model, format_: Format, sink: DiagnosticSink) -> Model:
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
