"""Reads other model files for passes that need them, such as the gripper that is attached to an arm."""

import os
from dataclasses import dataclass, replace
from pathlib import Path

from twinform.compiler.includes.model_config import manifest, model_file, newest_read
from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.search.resolve_uris import UriError
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import UNREAD_DOCUMENT
from twinform.ir import Document, Format
from twinform.schemas import Version


@dataclass(frozen=True, slots=True)
class OtherDocuments:
    """A reader for passes over the document of one file, whose path is empty where it was given as bytes."""

    load_options: LoadOptions
    file: str

    def read(self, path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        """The document of another file in the format and version of the one around it; None after an error."""
        found = self._find(path, around, sink)
        if found is None:
            return None
        loaded = self._read(found)
        sink.origins.update(loaded.origins)
        if loaded.document is None or not loaded.accepted:
            sink.extend_new(each for each in loaded.diagnostics if each.is_error)
            message = f"{path!r} cannot be used: it has errors"
            sink.report(UNREAD_DOCUMENT, message, around.location, found=path)
            return None
        return self._in_terms_of(around, loaded.document, found, sink)

    def _find(self, path: str, around: Document, sink: DiagnosticSink) -> Path | None:
        """A path is relative to the working directory, as on the command line; URIs are searched for."""
        if "://" not in path:
            return _file(Path(path), newest_read(around, self.load_options), sink)
        try:
            found = self.load_options.search.find(path, Path(self.file or "."))
        except UriError as error:
            sink.report(UNREAD_DOCUMENT, error.message, around.location, found=path, help=error.help)
            return None
        return _file(found, newest_read(around, self.load_options), sink)

    def _read(self, path: Path) -> LoadResult:
        load_options = replace(
            self.load_options, arguments={}
        )  # those of the command line are for the file that it names
        loaded = read(path, load_options)
        if loaded.document is None or not loaded.accepted:
            return loaded
        from twinform.compiler.includes.expanding import expand  # noqa: PLC0415 - it reads files by functions of `loading`

        return expand(loaded, load_options)

    def _in_terms_of(self, around: Document, document: Document, path: Path, sink: DiagnosticSink) -> Document | None:
        from twinform.compiler.request import ConversionRequest  # noqa: PLC0415 - few conversions need a second file
        from twinform.passes.includes.expand import relocate  # noqa: PLC0415 - as above

        own = DiagnosticSink(str(path), self.load_options.strict, origins=sink.origins)
        version = around.version if around.format is Format.SDF else None
        request = ConversionRequest(to="sdf" if around.format is Format.SDF else "urdf", sdf_version=version)
        document = request.legalisation(document).run(document, own)
        sink.extend_new(own.diagnostics)
        sink.entries.extend(own.entries)
        return None if own.has_errors else relocate(document, self._folder(path))

    def _folder(self, path: Path) -> str:
        """The folder of a file, as the file that the document was read from would say it."""
        here = Path(self.file).parent if self.file else Path()
        return Path(os.path.relpath(path.resolve().parent, here.resolve())).as_posix()


def _file(path: Path, asked: Version, sink: DiagnosticSink) -> Path | None:
    """The path, or of the folder of a model the file that its `model.config` names; None after an error."""
    config = manifest(path) if path.is_dir() else None
    if config is None:
        return path
    return model_file(config, asked, sink)
