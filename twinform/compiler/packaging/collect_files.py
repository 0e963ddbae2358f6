"""The pass that puts the files of a document into a package, and writes the URIs that they have there."""

from contextlib import suppress
from typing import ClassVar, Self

from pydantic import PrivateAttr

from twinform.compiler.packaging.collecting import Collection, UncollectedError
from twinform.compiler.packaging.file_kinds import FileKind
from twinform.compiler.packaging.made_files import MadeFiles
from twinform.compiler.packaging.plugin_files import report_plugin_files
from twinform.compiler.search.resolve_uris import LocalAssets
from twinform.diagnostics import DiagnosticSink, Fate, Location, Severity
from twinform.diagnostics.rules import UNPACKAGED_FILE, UNPACKAGED_INCLUDE
from twinform.ir import Document, Format
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.shared.document_uris import Kind, map_uris

_STANDARD = "file://media/"
"""What Gazebo Classic brings itself begins so."""
_KINDS: dict[Kind, frozenset[FileKind]] = {
    "mesh": frozenset({"mesh"}),
    "texture": frozenset({"image", "script", "sound"}),
}
_KEPT_INCLUDES = ("model://", "http://", "https://")
"""Includes that lead to the same model from everywhere."""


class CollectFiles(AssetPass):
    """Put the files that the document names into a package, and write the URIs that they have there.

    Changes: URIs of meshes, textures and scripts.
    Never touches: includes by `model://` or of Fuel, names such as `__default__`, and the parameters of plugins.
    Diagnostics: `unpackaged-file`, `unpackaged-include`, `unpackaged-parameter`, `uri-leaves-folder`.
    """

    name: ClassVar[str] = "collect-files"

    lenient: bool = False
    # The one pass that keeps something: a package holds a model in several texts (SDF in two
    # versions, URDF), and a mesh is there once. It has no entry point, so nobody but `package`
    # makes one.
    _collection: Collection = PrivateAttr()

    @classmethod
    def into(cls, collection: Collection) -> Self:
        """A pass that puts files into this collection."""
        made = cls.unchecked(lenient=collection.lenient)
        made._collection = collection  # noqa: SLF001 - its own
        return made

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with the URIs of the package."""
        # In the scheme of the source, before the target is known: what the target wants instead is
        # the business of legalisation. To rewrite URIs in each finished text would need a second
        # reader of both formats.
        scheme = "package" if document.format is Format.URDF else "model"
        missing: dict[str, AssetError | UncollectedError] = {}
        made = MadeFiles.of(sink.side_files)

        def change(uri: str, kind: Kind, where: Location) -> str:
            written = uri.strip()
            if kind == "include":
                self._check_include(written, where, sink)
                return uri
            if written.startswith(("__", _STANDARD)):
                return uri
            try:
                place = self._collected(written, _KINDS[kind], made)
            except (AssetError, UncollectedError) as error:
                if written not in missing:
                    self._report(written, error, where, sink)
                missing.setdefault(written, error)
                return uri
            self._report_problems(written, where, sink)
            return self._collection.layout.uri(place, scheme)

        report_plugin_files(document, self._collection.is_reserved, sink)
        map_uris(document, self._collect_folders)
        return map_uris(document, change)

    def _collect_folders(self, uri: str, kind: Kind, where: Location) -> str:
        """Folders of scripts and images first, so that a file of one is not put elsewhere too; URIs stay."""
        del where
        if kind == "texture" and isinstance(self._assets, LocalAssets):
            with suppress(AssetError, UncollectedError):  # which are reported where all files are collected
                found = self._assets.find(uri.strip())
                if found.is_dir():
                    self._collection.add(found, _KINDS[kind], self._assets)
        return uri

    def _collected(self, uri: str, kinds: frozenset[FileKind], made: MadeFiles) -> str:
        """The place of a file: of one that a pass has made, or of one that is there."""
        assets = self._assets
        if uri in made.files:
            return made.put(uri, self._collection)
        if not isinstance(assets, LocalAssets):
            raise UncollectedError(f"{uri!r} cannot be looked up: only the text of the model is known")
        try:
            return self._collection.add(assets.find(uri), kinds, assets)
        except AssetError:
            path = made.named(uri)
            if path is None:
                raise
            return made.put(path, self._collection)

    def _report(self, uri: str, error: AssetError | UncollectedError, where: Location, sink: DiagnosticSink) -> None:
        """Report a file that is not in the package; an error, unless one goes on without it."""
        if error.rule.fatal:
            sink.report(error.rule, error.message, where, found=uri, help=error.help)
            return
        goes_on = self.lenient
        rest = ", so it is not in the package, and its URI stays" if goes_on else ""
        severity = Severity.WARNING if goes_on else None
        sink.report(UNPACKAGED_FILE, f"{error.message}{rest}", where, found=uri, help=error.help, severity=severity)
        if goes_on:
            sink.account(Fate.APPROXIMATED, UNPACKAGED_FILE, f"{uri!r} is not in the package", where, 0)

    def _report_problems(self, uri: str, where: Location, sink: DiagnosticSink) -> None:
        """Report what a file that is in the package names and that is not."""
        for problem in self._collection.problems:
            self._report(uri, problem, where, sink)
        self._collection.problems.clear()

    def _check_include(self, uri: str, where: Location, sink: DiagnosticSink) -> None:
        if not uri.startswith(_KEPT_INCLUDES):
            message = f"{uri!r} is a path, which leads nowhere from the package"
            advice = "put it in its place with --expand-includes, or include it as model://NAME"
            sink.report(UNPACKAGED_INCLUDE, message, where, found=uri, help=advice)
