"""Reads other model files for passes that need them, such as the gripper that is attached to an arm."""

import os
from dataclasses import dataclass, replace
from pathlib import Path

from twinform.compiler.loading import Checked, Reading, read
from twinform.compiler.model_config import manifest, model_file
from twinform.compiler.uris import UriError
from twinform.diagnostics import Notes
from twinform.diagnostics.rules.edits import UNREAD_DOCUMENT
from twinform.ir import Document, Format
from twinform.schemas import parse_version


@dataclass(frozen=True, slots=True)
class OtherDocuments:
    """A reader for passes over the document of one file, whose path is empty where it was given as bytes."""

    how: Reading
    file: str

    def read(self, path: str, around: Document, notes: Notes) -> Document | None:
        """The document of another file in the format and version of the one around it; None after an error."""
        found = self._find(path, around, notes)
        if found is None:
            return None
        checked = self._read(found)
        notes.origins.update(checked.origins)
        if checked.document is None or not checked.accepted:
            notes.extend_new(each for each in checked.diagnostics if each.is_error)
            message = f"{path!r} cannot be used: it has errors"
            notes.report(UNREAD_DOCUMENT, message, around.location, found=path)
            return None
        return self._in_terms_of(around, checked.document, found, notes)

    def _find(self, path: str, around: Document, notes: Notes) -> Path | None:
        """A path is relative to the working directory, as on the command line; URIs are searched for."""
        if "://" not in path:
            return _file(Path(path), around, notes)
        try:
            found = self.how.search.find(path, Path(self.file or "."))
        except UriError as error:
            notes.report(UNREAD_DOCUMENT, error.message, around.location, found=path, help=error.help)
            return None
        return _file(found, around, notes)

    def _read(self, path: Path) -> Checked:
        how = replace(self.how, arguments={})  # those of the command line are for the file that it names
        checked = read(path, how)
        if checked.document is None or not checked.accepted:
            return checked
        from twinform.compiler.includes import expand  # noqa: PLC0415 - it reads files by functions of `loading`

        return expand(checked, how)

    def _in_terms_of(self, around: Document, document: Document, path: Path, notes: Notes) -> Document | None:
        from twinform.compiler.orders import Order  # noqa: PLC0415 - few conversions need a second file
        from twinform.passes.includes.relocate import relocate  # noqa: PLC0415 - as above

        own = Notes(str(path), self.how.strict, origins=notes.origins)
        version = around.version if around.format is Format.SDF else None
        order = Order(to="sdf" if around.format is Format.SDF else "urdf", sdf_version=version)
        document = order.legalisation(document).run(document, own)
        notes.extend_new(own.diagnostics)
        notes.entries.extend(own.entries)
        return None if own.has_errors else relocate(document, self._folder(path))

    def _folder(self, path: Path) -> str:
        """The folder of a file, as the file that the document was read from would say it."""
        here = Path(self.file).parent if self.file else Path()
        return Path(os.path.relpath(path.resolve().parent, here.resolve())).as_posix()


def _file(path: Path, around: Document, notes: Notes) -> Path | None:
    """The path, or of the folder of a model the file that its `model.config` names; None after an error."""
    config = manifest(path) if path.is_dir() else None
    if config is None:
        return path
    asked = parse_version(around.version) if around.version and around.format is Format.SDF else None
    return model_file(config, asked, notes)
