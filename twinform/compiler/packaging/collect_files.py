"""The pass that puts the files of a document into a package, and writes their URIs in the package.

Files that passes have made and nobody has written yet, such as simpler meshes, keep their paths. Files that parameters
of plugins name are reported and not collected, since only the plugin knows what they mean.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from posixpath import dirname, join, normpath
from typing import ClassVar, Self

from twinform.compiler.packaging.collecting import Collection, UncollectedError
from twinform.compiler.packaging.package import FileKind, suffix_of
from twinform.compiler.resolve_uris import LocalAssets
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, Severity, SideFile
from twinform.diagnostics.rules import UNPACKAGED_FILE, UNPACKAGED_INCLUDE, UNPACKAGED_PARAMETER
from twinform.ir import Document, Element, Format, Plugin, rewrite
from twinform.ir.rewrite import untyped_elements
from twinform.lazy import lazy_pattern
from twinform.passes.framework.assets import AssetError, FindingError
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.mesh_references import FORMATS
from twinform.passes.shared.document_uris import Kind, map_uris


@dataclass(frozen=True, slots=True)
class MadeFiles:
    """Files that passes have made, by their paths below the folder of the result."""

    files: Mapping[str, bytes]

    @classmethod
    def of(cls, side_files: Iterable[SideFile]) -> Self:
        """Collect the files that passes have put into a diagnostic sink."""
        return cls({path: data if isinstance(data, bytes) else data.encode() for path, data, *_ in side_files})

    def named(self, uri: str) -> str | None:
        """Return the path of the file that a URI ends with; None where no pass has made it."""
        return next((path for path in self.files if uri == path or uri.endswith(f"/{path}")), None)

    def put(self, path: str, collection: Collection) -> str:
        """Put a file and those that it names into the package; return its place, which is its path.

        Raises:
            UncollectedError: another file is in its place.
        """
        waiting = [path]
        done: set[str] = set()
        while waiting:
            one = waiting.pop()
            if one not in done:
                done.add(one)
                collection.put(one, self.files[one])
                waiting += self._named(one)
        return path

    def _named(self, path: str) -> list[str]:
        format_ = FORMATS.get(suffix_of(path))
        names = format_.references(self.files[path]) if format_ else []
        return [inner for name in names if (inner := normpath(join(dirname(path), name))) in self.files]


_STANDARD = "file://media/"
"""The beginning of URIs of files that come with Gazebo Classic."""
_KINDS: dict[Kind, frozenset[FileKind]] = {
    "mesh": frozenset({"mesh"}),
    "texture": frozenset({"image", "script", "sound"}),
}
_KEPT_INCLUDES = ("model://", "http://", "https://")
"""Includes that lead to the same model from everywhere."""


class CollectFiles(AssetPass):
    """Put the files that the document names into a package, and write their URIs in the package.

    Changes: URIs of meshes, textures and scripts.
    Never touches: includes by `model://` or of Fuel, names such as `__default__`, and the parameters of plugins.
    Diagnostics: `unpackaged-file`, `unpackaged-include`, `unpackaged-parameter`, `uri-leaves-folder`.
    """

    name: ClassVar[str] = "collect-files"

    lenient: bool = False
    # The one pass that keeps something: a package holds a model in several texts (SDF in two
    # versions, URDF), and a mesh is there once. It has no entry point, so nobody but `package`
    # makes one.
    _collection: Collection

    @classmethod
    def into(cls, collection: Collection) -> Self:
        """Make a pass that puts files into a collection."""
        return cls.unchecked(lenient=collection.lenient, _collection=collection)

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with the URIs of the package."""
        # In the scheme of the source, before the target is known: what the target wants instead is
        # the business of legalisation. To rewrite URIs in each finished text would need a second
        # reader of both formats.
        scheme = "package" if document.format is Format.URDF else "model"
        missing: dict[str, FindingError] = {}
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
        """Collect a folder of scripts or images, before single files, so that its files are not put elsewhere too."""
        del where
        if kind == "texture" and isinstance(self._assets, LocalAssets):
            with suppress(AssetError, UncollectedError):  # which are reported where all files are collected
                found = self._assets.find(uri.strip())
                if found.is_dir():
                    self._collection.add(found, _KINDS[kind], self._assets)
        return uri

    def _collected(self, uri: str, kinds: frozenset[FileKind], made: MadeFiles) -> str:
        """Put a file that is there, or that a pass has made, into the package, and return its place."""
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

    def _report(self, uri: str, error: FindingError, where: Location, sink: DiagnosticSink) -> None:
        """Report a file that is not in the package, as an error unless missing files are allowed."""
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
        """Report files that are missing in the package and named by a file in it."""
        for problem in self._collection.problems:
            self._report(uri, problem, where, sink)
        self._collection.problems.clear()

    def _check_include(self, uri: str, where: Location, sink: DiagnosticSink) -> None:
        if not uri.startswith(_KEPT_INCLUDES):
            message = f"{uri!r} is a path, which leads nowhere from the package"
            advice = "put it in its place with --expand-includes, or include it as model://NAME"
            sink.report(UNPACKAGED_INCLUDE, message, where, found=uri, help=advice)


_FILE_URI = lazy_pattern(r"(?:package|model|file)://\S+|\$\(find [^)]*\)\S*")


def report_plugin_files(document: Document, is_there: Callable[[str], bool], sink: DiagnosticSink) -> None:
    """Report each URI in parameters of plugins once, except for files that are known to be in the package."""
    reported: set[str] = set()
    for uri, plugin, where in _parameter_uris(document):
        if uri not in reported and not is_there(uri):
            reported.add(uri)
            message = f"plugin {plugin!r} names {uri!r}, which is not put into the package"
            sink.report(UNPACKAGED_PARAMETER, message, where, found=uri)


def _parameter_uris(document: Document) -> Iterator[tuple[str, str, Location]]:
    """Yield the URIs in parameters of plugins, with the plugin and the place of each."""
    plugins: list[Plugin] = []

    def note(plugin: Plugin) -> Plugin:
        plugins.append(plugin)
        return plugin

    rewrite(document, Plugin, note)
    for plugin in plugins:
        for part in plugin.content:
            yield from _uris_in(part, plugin.name or plugin.filename or "", plugin.location)
    for element in untyped_elements(document):
        for inner in element.walk() if element.name == "plugin" else ():
            yield from _uris_in(inner, element.get("name") or element.get("filename") or "", document.location)


def _uris_in(element: Element, plugin: str, around: Location) -> Iterator[tuple[str, str, Location]]:
    for inner in element.walk():
        where = inner.location if inner.source else around
        for text in (inner.text or "", *(value for _, value in inner.attributes)):
            yield from ((uri, plugin, where) for uri in _FILE_URI.findall(text))
