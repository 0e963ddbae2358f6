"""Reads other model files: those that includes name, and those that passes ask for, such as a gripper for an arm.

The passes in `passes/includes` put the contents of included files in the places of the includes.
"""

import os
from collections.abc import Callable
from dataclasses import field, replace
from pathlib import Path
from posixpath import dirname
from typing import NamedTuple

from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.input.size_limits import LIFTED_BY_TAGS, excess_of_names
from twinform.compiler.model_config import manifest, model_file, newest_read
from twinform.compiler.resolve_uris import UriError
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import UNREAD_DOCUMENT
from twinform.ir import Document, Format, Include
from twinform.ir.scopes import outer_models
from twinform.ir.transform import Transform
from twinform.ir.verify import verify
from twinform.passes import Pipeline
from twinform.passes.includes import Included, expand_includes, frame_of_sdf, has_includes
from twinform.passes.legalise import Target, legalisation
from twinform.request_options import Requested
from twinform.schemas import Version, versions_of

_DEEPEST = 32
_MOST = 10_000
# About as deep as one file can nest models, since its elements may be 256 deep.
_DEEPEST_MODELS = 250
_NEWEST_WITHOUT_HARM = "1.11"
"""The version of an included URDF where the file around it has none."""

Wanted = Callable[[Include], bool]
"""Tells whether an include is to be expanded."""


class _IncludedFile(NamedTuple):
    """A file with all its includes expanded.

    It is made of a number of `files` with a total `size`, and its models are nested to a `depth`. `frame` is the frame
    of its model in the frame that an include places.
    """

    document: Document
    files: int
    size: int
    depth: int
    frame: Transform = Transform()


def expand(
    loaded: LoadResult, load_options: LoadOptions, *, wanted: Wanted | None = None, carriers: bool = True, why: str = ""
) -> LoadResult:
    """Expand the includes of a document, and report those that cannot be expanded, with the reason to expand them."""
    document = loaded.document
    if document is None or not loaded.accepted or document.format is not Format.SDF or not has_includes(document):
        return loaded
    sink = loaded.sink(strict=load_options.strict)
    if loaded.allowances:
        loaded.allowances.origins = sink.origins
    reader = _IncludeExpander(load_options, sink, carriers, why)
    whole = reader.expand_document(document, Path(loaded.path), (), wanted)
    # Each file may be within the limits and the sum of them not.
    excess = excess_of_names(len(whole.document.namespaces), whole.size)
    if excess is not None:
        sink.report(rules.TOO_MANY_INCLUDES, excess.message, document.location)
    if not sink.has_errors:
        _verify_whole(whole.document, sink)
    return replace(
        loaded,
        document=whole.document,
        diagnostics=tuple(sink.diagnostics),
        allowed=tuple(sink.allowed),
        origins=sink.origins,
        entries=tuple(sink.entries),
        included=whole.size,
        mixed=True,
    )


def _verify_whole(document: Document, sink: DiagnosticSink) -> None:
    """Report what is only wrong with the files together; the rest was reported when they were read."""
    found = DiagnosticSink(sink.file, sink.strict)
    verify(document, found)
    seen = set(sink.diagnostics)
    sink.extend(each for each in found.diagnostics if each not in seen)


@dataclass(slots=True)
class _IncludedTotal:
    own_depth: int
    largest: int
    depth: int = 0
    files: int = 1
    size: int = 0

    def add(self, file: _IncludedFile) -> str | None:
        """Count a file, and return the limit that is exceeded, or None."""
        self.files += file.files
        self.size += file.size
        self.depth = max(self.depth, self.own_depth + file.depth)
        if self.depth > _DEEPEST_MODELS:
            return f"its models are nested more than {_DEEPEST_MODELS} deep"
        if self.files > _MOST:
            return f"these are more than {_MOST:,} models"
        return f"these are more than {self.largest:,} elements and attributes" if self.size > self.largest else None


@dataclass(slots=True)
class _IncludeExpander:
    """Expands includes. Every file is read once, whatever includes it, and none after a limit makes it `full`."""

    load_options: LoadOptions
    sink: DiagnosticSink
    carriers: bool
    why: str = ""
    full: bool = False
    files: dict[tuple[Path, str | None], _IncludedFile | None] = field(
        default_factory=dict[tuple[Path, str | None], "_IncludedFile | None"]
    )

    def expand_document(
        self, document: Document, file: Path, above: tuple[Path, ...], wanted: Wanted | None
    ) -> _IncludedFile:
        """Expand the includes of a document; `above` are the files that are being read already."""
        total = _IncludedTotal(_nesting(document), self.load_options.limits.tags)

        def resolve(include: Include) -> Included | None:
            if self.full:
                return None
            path = self._find(include, file, document) if wanted is None or wanted(include) else None
            found = self._model_file(include, path, document, (*above, file.resolve())) if path else None
            if path is None or found is None:
                return None
            too_much = total.add(found)
            if too_much:
                excess = total.size > total.largest
                self._report_too_many(include, too_much, LIFTED_BY_TAGS if excess else None)
                return None
            return Included(found.document, _folder(include, path), found.frame)

        whole = expand_includes(document, resolve, self.sink, carriers=self.carriers)
        return _IncludedFile(whole, total.files, total.size, max(total.own_depth, total.depth))

    def _find(self, include: Include, file: Path, document: Document) -> Path | None:
        """Find the file that an include names."""
        try:
            path = self.load_options.search.find(include.uri or "", file)
        except UriError as error:
            message = f"{error.message}; {self.why}" if self.why else error.message
            self.sink.report(error.rule, message, include.location.at("uri"), found=include.uri, help=error.help)
            return None
        # An include may name the SDF file itself instead of the folder of its model.
        if not path.is_dir():
            return path
        config = manifest(path)
        if config is not None:
            self.load_options.search.seen.add(config)
            # A model.config may list a file for each version of SDF, and libsdformat takes the
            # newest that it can read, whatever the file with the include declares. So one world has
            # another model in Fortress than in Harmonic; we take what the reader of the result
            # takes.
            return model_file(config, newest_read(document, self.load_options), self.sink)
        usual = path / "model.sdf"
        rule = rules.MISSING_MODEL_CONFIG if usual.is_file() else rules.BROKEN_MODEL_CONFIG
        message = f"{include.uri!r} is the folder {str(path)!r}, which has no model.config"
        self.sink.report(rule, message, include.location.at("uri"), found=include.uri, refused=True)
        return usual if usual.is_file() else None

    def _model_file(
        self, include: Include, path: Path, around: Document, above: tuple[Path, ...]
    ) -> _IncludedFile | None:
        """Return an included file, expanded; None where it cannot be read, which is reported."""
        real = path.resolve()
        if not path.is_file():
            message = f"{include.uri!r} leads to {str(path)!r}, but there is no such file"
            self.sink.report(rules.UNRESOLVED_URI, message, include.location.at("uri"), found=include.uri)
            return None
        # By real paths, since a symbolic link would hide the circle.
        if real in above:
            names = " includes ".join(repr(each.name) for each in (*above[above.index(real) :], real))
            self.sink.report(rules.INCLUDE_CYCLE, names, include.location.at("uri"), found=include.uri)
            return None
        if len(above) >= _DEEPEST:
            self._report_too_many(include, f"it is inside {_DEEPEST} others")
            return None
        # what URDF becomes depends on the version around it
        key = (real, around.version)
        if key not in self.files:
            self.files[key] = self._read(path, around, above)
        return self.files[key]

    def _read(self, path: Path, around: Document, above: tuple[Path, ...]) -> _IncludedFile | None:
        loaded = read(path, self.load_options)
        self.sink.origins.update(loaded.origins)
        known = set(self.sink.diagnostics)
        self.sink.extend(each for each in loaded.diagnostics if each not in known)
        if loaded.document is None or not loaded.accepted:
            return None
        document, frame = loaded.document, Transform()
        if document.format is Format.URDF:
            frame = frame_of_sdf(document.models[0])
            document = self._as_sdf(document, path, around)
        inner = self.expand_document(document, path, above, None)
        return inner._replace(size=inner.size + loaded.size, frame=frame)

    def _as_sdf(self, document: Document, path: Path, around: Document) -> Document:
        """Convert a URDF document for the SDF file that includes it."""
        version = around.version if around.version in versions_of("sdf") else _NEWEST_WITHOUT_HARM
        target = Target(Format.SDF, version or _NEWEST_WITHOUT_HARM, requested=Requested(carriers=self.carriers))
        own = DiagnosticSink(str(path), self.load_options.strict, origins=self.sink.origins)
        document = Pipeline(legalisation(Format.URDF, document.version, target)).run(document, own)
        self.sink.extend(own.diagnostics)
        self.sink.entries.extend(own.entries)
        return document

    def _report_too_many(self, include: Include, why: str, help: str | None = None) -> None:
        if self.full:
            return  # the files above would only say the same again
        self.full = True
        message = f"{include.uri!r} is not expanded: {why}"
        where = include.location.at("uri")
        self.sink.report(rules.TOO_MANY_INCLUDES, message, where, found=include.uri, help=help)


def _nesting(document: Document) -> int:
    """Return how deep models are nested; models without nested ones count as one."""
    depth, level = 0, [*outer_models(document)]
    while level:
        depth, level = depth + 1, [inner for model in level for inner in model.models]
    return depth


def _folder(include: Include, path: Path) -> str:
    """Return the URI of the folder of an included file, for the file that includes it."""
    uri = (include.uri or "").strip().rstrip("/")
    if path.name == uri.rpartition("/")[2]:
        return dirname(uri)
    if uri.startswith(("http://", "https://")):
        version = uri.rpartition("/models/")[2].partition("/")[2]
        return f"{uri}/files" if version else f"{uri}/tip/files"
    return uri


@dataclass(frozen=True, slots=True)
class OtherDocuments:
    """Reads other files for passes over the document of a file, whose path is empty where it was given as bytes."""

    load_options: LoadOptions
    file: str

    def read(self, path: str, around: Document, sink: DiagnosticSink) -> Document | None:
        """Read another file, and convert it to the format and version of a document; None after an error."""
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
        """Find a file by a path from the working directory, as on the command line, or by a URI."""
        if "://" not in path:
            return _model_file(Path(path), newest_read(around, self.load_options), sink)
        try:
            found = self.load_options.search.find(path, Path(self.file or "."))
        except UriError as error:
            sink.report(UNREAD_DOCUMENT, error.message, around.location, found=path, help=error.help)
            return None
        return _model_file(found, newest_read(around, self.load_options), sink)

    def _read(self, path: Path) -> LoadResult:
        load_options = replace(
            self.load_options, arguments={}
        )  # those of the command line are for the file that it names
        loaded = read(path, load_options)
        if loaded.document is None or not loaded.accepted:
            return loaded

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
        """Return the folder of a file, relative to the file that the document was read from."""
        here = Path(self.file).parent if self.file else Path()
        return Path(os.path.relpath(path.resolve().parent, here.resolve())).as_posix()


def _model_file(path: Path, asked: Version, sink: DiagnosticSink) -> Path | None:
    """Return a path, or for the folder of a model the file that its `model.config` names; None after an error."""
    config = manifest(path) if path.is_dir() else None
    if config is None:
        return path
    return model_file(config, asked, sink)
