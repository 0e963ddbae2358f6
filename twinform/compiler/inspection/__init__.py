"""Checks of `twinform check` beyond validity: named files, driven joints, mass of moving links, read-only passes.

A conversion does without them; its passes report what becomes of such parts.
"""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from twinform.compiler.input.allowances import report_unused
from twinform.compiler.input.finding_lines import with_exact_lines
from twinform.compiler.input.loading import LoadOptions, LoadResult
from twinform.compiler.inspection.named_files import report_named_files
from twinform.compiler.inspection.part_checks import report_contact_sensors, report_driven_joints, report_massless
from twinform.diagnostics import Diagnostic, DiagnosticSink

if TYPE_CHECKING:
    from twinform.passes import Pipeline

__all__ = ["inspect"]


def inspect(loaded: LoadResult, load_options: LoadOptions, passes: "Pipeline | None" = None) -> LoadResult:
    """Add the findings of all inspections to a result of reading, and those of `passes` if there is no error.

    Raises:
        ReadOnlyPassError: a pass would change the document.
        PassError: a pass is at fault.
    """
    document = loaded.document
    if document is None:
        return loaded
    file = loaded.text_name
    sink = DiagnosticSink(file, load_options.strict)
    report_driven_joints(document, sink)
    # These checks take a fifth of the time of `check` where the files are there.
    if loaded.accepted:
        report_massless(document, sink)
        report_contact_sensors(document, sink)
    report_named_files(document, Path(loaded.path), load_options.search, loaded.tree, sink)
    whole = DiagnosticSink(loaded.path, load_options.strict, list(loaded.diagnostics), origins=dict(loaded.origins))
    whole.allows, whole.allowed = loaded.allowances, list(loaded.allowed)
    whole.extend_new(_with_lines(sink, loaded))
    if passes and loaded.accepted:
        from twinform.compiler.inspection.read_only_passes import run_read_only  # noqa: PLC0415 - few runs have passes

        found = DiagnosticSink(file, load_options.strict)
        run_read_only(document, passes, found, Path(loaded.path), load_options)
        whole.extend_new(_with_lines(found, loaded))
    if load_options.profiles:
        # few files are for certain consumers
        from twinform.compiler.inspection.inspect_for_consumers import report_for_consumers  # noqa: PLC0415 - see above

        report_for_consumers(loaded, load_options, whole)
    if loaded.allowances:
        loaded.allowances.checked = True
        loaded.allowances.settle(whole)
        # Errors keep other findings from being looked for, so a suppression of one of these would
        # seem unused.
        if not whole.has_errors:
            report_unused(loaded.allowances, whole)
    ordered = sorted(whole.diagnostics, key=lambda each: each.location.line)
    return replace(loaded, diagnostics=tuple(ordered), allowed=tuple(whole.allowed))


def _with_lines(sink: DiagnosticSink, loaded: LoadResult) -> list[Diagnostic]:
    """Return the findings of a sink, with exact lines where there is a text."""
    found = sink.diagnostics
    return found if loaded.tree is None else list(with_exact_lines(found, loaded.tree, sink.file))
