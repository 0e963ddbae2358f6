"""What `check` looks at beyond what makes a document valid: named files, driven joints, mass of moving links, passes.

A conversion asks none of this; the passes that it runs say what becomes of such parts.
"""

from dataclasses import replace
from pathlib import Path

from twinform.compiler.exact_lines import with_exact_lines
from twinform.compiler.inspection.driven_joints import report_driven_joints
from twinform.compiler.inspection.looking import LookingError, look
from twinform.compiler.inspection.massless import report_massless
from twinform.compiler.inspection.named_files import report_named_files
from twinform.compiler.loading import Checked, Reading
from twinform.diagnostics import Notes
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
    report_named_files(document, Path(checked.path), how.search, checked.tree, notes)
    if passes and checked.accepted:
        look(document, passes, notes, Path(checked.path), how)
    found = notes.diagnostics
    if checked.tree is not None:
        found = list(with_exact_lines(found, checked.tree, file))
    whole = Notes(checked.path, how.strict, list(checked.diagnostics), origins=dict(checked.origins))
    whole.extend_new(found)
    ordered = sorted(whole.diagnostics, key=lambda each: each.location.line)
    return replace(checked, diagnostics=tuple(ordered))
