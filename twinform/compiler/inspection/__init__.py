"""What `check` looks at beyond what makes a document valid: named files, driven joints, mass of moving links, passes.

A conversion asks none of this; the passes that it runs say what becomes of such parts.
"""

from dataclasses import replace
from pathlib import Path

from twinform.compiler.exact_lines import with_exact_lines
from twinform.compiler.inspection.contact_sensors import report_contact_sensors
from twinform.compiler.inspection.driven_joints import report_driven_joints
from twinform.compiler.inspection.looking import LookingError, look
from twinform.compiler.inspection.massless import report_massless
from twinform.compiler.inspection.named_files import report_named_files
from twinform.compiler.loading import Checked, Reading
from twinform.diagnostics import Diagnostic, Notes
from twinform.passes import Pipeline

__all__ = ["LookingError", "inspect"]


def inspect(checked: Checked, how: Reading, passes: Pipeline | None = None) -> Checked:
    """The same with what is found in a document that was read; `passes` look at one that has no error.

    Raises:
        LookingError: a pass would change the document.
        PassError: a pass is at fault.
    """
    document = checked.document
    if document is None:
        return checked
    file = checked.text_name
    notes = Notes(file, how.strict)
    report_driven_joints(document, notes)
    if checked.accepted:
        report_massless(document, notes)
        report_contact_sensors(document, notes)
    report_named_files(document, Path(checked.path), how.search, checked.tree, notes)
    whole = Notes(checked.path, how.strict, list(checked.diagnostics), origins=dict(checked.origins))
    whole.extend_new(_placed(notes, checked))
    if passes and checked.accepted:
        found = Notes(file, how.strict)
        look(document, passes, found, Path(checked.path), how)
        whole.extend_new(_placed(found, checked))
    ordered = sorted(whole.diagnostics, key=lambda each: each.location.line)
    return replace(checked, diagnostics=tuple(ordered))


def _placed(notes: Notes, checked: Checked) -> list[Diagnostic]:
    """What was found, at exact lines where there is a text."""
    found = notes.diagnostics
    return found if checked.tree is None else list(with_exact_lines(found, checked.tree, notes.file))
