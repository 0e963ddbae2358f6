"""What is wrong in the `<gazebo>` elements of a URDF file."""

from twinform.diagnostics import Notes
from twinform.ir import Document


def check_extensions(document: Document, notes: Notes) -> None:
    """Fold them as a conversion would, only to see what it has to say."""
    if not any(model.extensions for model in document.models):
        return
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - most files have none

    found = Notes(file=notes.file, strict=notes.strict)
    FoldGazebo().run(document, found)
    notes.extend_new(found.diagnostics)
