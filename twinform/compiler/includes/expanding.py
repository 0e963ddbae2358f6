"""Reads the files that includes name, for `passes/includes`, which puts them in their place."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from posixpath import dirname
from typing import NamedTuple

from twinform.compiler.includes.model_config import manifest, model_file, newest_read
from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.input.size_limits import LIFTED_BY_TAGS, excess_of_names
from twinform.compiler.search.resolve_uris import UriError
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Include
from twinform.ir.scopes import outer_models
from twinform.ir.transform import Transform
from twinform.ir.verify import verify
from twinform.passes import Pipeline
from twinform.passes.includes import Included, expand_includes, frame_of_sdf, has_includes
from twinform.passes.legalise import Target, legalisation
from twinform.schemas import versions_of

_DEEPEST = 32
_MOST = 10_000
# About as deep as one file can nest models, since its elements may be 256 deep.
_DEEPEST_MODELS = 250
_NEWEST_WITHOUT_HARM = "1.11"
"""What URDF becomes where the file around it has no version."""

Wanted = Callable[[Include], bool]
"""Which of a document's includes are to be expanded."""


class _IncludedFile(NamedTuple):
    """A file with all its includes expanded.

    How many files it is made of, how large these are together, and how deep its models are nested. `frame` is that of
    its model in the one that an include places.
    """

    document: Document
    files: int
    size: int
    depth: int
    frame: Transform = Transform()


def expand(
    loaded: LoadResult, load_options: LoadOptions, *, wanted: Wanted | None = None, carriers: bool = True
) -> LoadResult:
    """What was found, with the document's includes expanded; errors among the findings where that cannot be done."""
    document = loaded.document
    if document is None or not loaded.accepted or document.format is not Format.SDF or not has_includes(document):
        return loaded
    sink = _sink(loaded, load_options)
    reader = _Reader(load_options, sink, carriers)
    whole = reader.expanded(document, Path(loaded.path), (), wanted)
    # Each file may be within the limits and the sum of them not.
    excess = excess_of_names(len(whole.document.namespaces), whole.size)
    if excess is not None:
        sink.report(rules.TOO_MANY_INCLUDES, excess.message, document.location)
    if not sink.has_errors:
        _verify(whole.document, sink)
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


def _sink(loaded: LoadResult, load_options: LoadOptions) -> DiagnosticSink:
    origins = dict(loaded.origins)
    if loaded.allowances:
        loaded.allowances.origins = origins
    return DiagnosticSink(
        loaded.path,
        load_options.strict,
        list(loaded.diagnostics),
        origins=origins,
        allows=loaded.allowances and loaded.allowances.in_conversion,
        allowed=list(loaded.allowed),
    )


def _verify(document: Document, sink: DiagnosticSink) -> None:
    """Verify what only shows when all is in one place; the rest was reported when the files were read."""
    found = DiagnosticSink(sink.file, sink.strict)
    verify(document, found)
    seen = set(sink.diagnostics)
    sink.extend(each for each in found.diagnostics if each not in seen)


@dataclass(slots=True)
class _Total:
    own_depth: int
    largest: int
    depth: int = 0
    files: int = 1
    size: int = 0

    def add(self, file: _IncludedFile) -> str | None:
        """Count a file; gives what there is too much of."""
        self.files += file.files
        self.size += file.size
        self.depth = max(self.depth, self.own_depth + file.depth)
        if self.depth > _DEEPEST_MODELS:
            return f"its models are nested more than {_DEEPEST_MODELS} deep"
        if self.files > _MOST:
            return f"these are more than {_MOST:,} models"
        return f"these are more than {self.largest:,} elements and attributes" if self.size > self.largest else None


@dataclass(slots=True)
class _Reader:
    """One run. Every file is read once, whatever includes it; none once it is `full`."""

    load_options: LoadOptions
    sink: DiagnosticSink
    carriers: bool
    full: bool = False
    files: dict[tuple[Path, str | None], _IncludedFile | None] = field(
        default_factory=dict[tuple[Path, str | None], "_IncludedFile | None"]
    )

    def expanded(self, document: Document, file: Path, above: tuple[Path, ...], wanted: Wanted | None) -> _IncludedFile:
        """A document with its includes expanded; `above` are the files that are being read already."""
        total = _Total(_nesting(document), self.load_options.limits.tags)

        def resolve(include: Include) -> Included | None:
            if self.full:
                return None
            path = self._find(include, file, document) if wanted is None or wanted(include) else None
            found = self._file(include, path, document, (*above, file.resolve())) if path else None
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
        """The file that an include names."""
        try:
            path = self.load_options.search.find(include.uri or "", file)
        except UriError as error:
            self.sink.report(error.rule, error.message, include.location.at("uri"), found=include.uri, help=error.help)
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
        self.sink.report(rule, message, include.location.at("uri"), found=include.uri)
        return usual if usual.is_file() else None

    def _file(self, include: Include, path: Path, around: Document, above: tuple[Path, ...]) -> _IncludedFile | None:
        """An included file, expanded; None where it cannot be, which the diagnostics then report."""
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
        inner = self.expanded(document, path, above, None)
        return inner._replace(size=inner.size + loaded.size, frame=frame)

    def _as_sdf(self, document: Document, path: Path, around: Document) -> Document:
        """A URDF document in the terms of the file that includes it."""
        version = around.version if around.version in versions_of("sdf") else _NEWEST_WITHOUT_HARM
        target = Target(Format.SDF, version or _NEWEST_WITHOUT_HARM, carriers=self.carriers)
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
    """How deep models are nested, one that holds none counting as one."""
    depth, level = 0, [*outer_models(document)]
    while level:
        depth, level = depth + 1, [inner for model in level for inner in model.models]
    return depth


def _folder(include: Include, path: Path) -> str:
    """The URI of the folder that the file lies in, as the file that includes it would say it."""
    uri = (include.uri or "").strip().rstrip("/")
    if path.name == uri.rpartition("/")[2]:
        return dirname(uri)
    if uri.startswith(("http://", "https://")):
        version = uri.rpartition("/models/")[2].partition("/")[2]
        return f"{uri}/files" if version else f"{uri}/tip/files"
    return uri
