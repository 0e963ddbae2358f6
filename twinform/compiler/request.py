"""The request of a conversion: target format, version, passes and options."""

from collections.abc import Iterable
from dataclasses import field, fields, replace
from pathlib import Path
from typing import Any, get_args

from twinform.dataclass import dataclass
from twinform.ir import Document, Format
from twinform.option import require_value
from twinform.passes import NO_ASSETS, Assets, Pass, Pipeline
from twinform.passes.carriers.annotations import has_mixed_words, source_version
from twinform.passes.legalise import Target, legalisation
from twinform.request_options import URDF_VERSIONS, Language, Requested, RequestOptions, UrdfVersion, known_sdf_version
from twinform.schemas import DEFAULT_SDF_VERSION, print_version, version_read, versions_of

_OPTIONS = tuple(each.name for each in fields(Requested))


@dataclass(frozen=True, slots=True, kw_only=True)
class ConversionRequest(Requested):
    """What a conversion is to make; `passes` are the user's, and `assets` the files that the source names.

    `mixed` means that the source has elements that its version does not have, and `comments` that the comments of the
    source are kept. `remedies` are the passes that consumers need, and `remedied` the rules of errors that they fix;
    with `keep_physics` none of them may change the physics. `newest_urdf` is the newest version of URDF that all
    consumers read, and None where none of them minds. `folder` is where the result will lie, from which its relative
    paths lead; without it they stay as they are in the source.
    """

    to: Language
    passes: Pipeline = field(default_factory=Pipeline)
    mixed: bool = False
    remedies: Pipeline = field(default_factory=Pipeline)
    remedied: frozenset[str] = frozenset()
    newest_urdf: UrdfVersion | None = None
    folder: Path | None = None
    assets: Assets = field(default=NO_ASSETS, compare=False, repr=False)

    @classmethod
    def of(cls, to: Language, options: RequestOptions) -> "ConversionRequest":
        """Make a request of options; one that is `None` is not given.

        Raises:
            PipelineError: `passes` is not a pipeline.
            ValueError: there is no such format, or SDF has no such version.
        """
        require_value("to", to, get_args(Language))
        version = options.get("sdf_version")
        if version is not None:
            known_sdf_version(version)
        wanted: dict[str, Any] = {name: options.get(name) for name in _OPTIONS}
        given = {name: value for name, value in wanted.items() if value is not None}
        return cls(to=to, passes=_pipeline(options.get("passes")), **given)

    def beside(self, result: Path) -> "ConversionRequest":
        """Return the request for a result with this path."""
        return self if self.keep_paths else replace(self, folder=result.parent)

    @property
    def requested(self) -> Requested:
        """The options alone."""
        return Requested(**{name: getattr(self, name) for name in _OPTIONS})

    def plan(self, source: Document) -> Pipeline:
        """Return every pass that a conversion of a document runs, in order: the user's, then those of the target."""
        return Pipeline((*self.passes, *self.remedies, *self.selection(source), *self.legalisation(source)))

    def selection(self, source: Document) -> Pipeline:
        """Return the pass that selects the requested model, where the passes of the target do not begin with it."""
        if self.model is None or (source.format is Format.SDF and self.to == "urdf"):
            return Pipeline()
        from twinform.passes.legalise.to_urdf.select_model import SelectModel  # noqa: PLC0415 - few ask for a model

        return Pipeline((SelectModel.unchecked(model=self.model),))

    def legalisation(self, source: Document) -> Pipeline:
        """Return the passes that the target needs."""
        if self.to == "json":
            return Pipeline()
        target = self.target(source, Format(self.to))
        return Pipeline(legalisation(source.format, source.version, target)).with_files(self.assets)

    def target(self, source: Document, format_: Format) -> Target:
        """Return the target for a document: in the requested version, or else in the one that it came from."""
        own = source.version if source.format is Format.SDF else None
        before = None if source.format is format_ else source_version(source, format_)
        if source.format is format_ is Format.URDF:
            before = print_version(version_read("urdf", source.version))
        before = before if before in versions_of(format_) else None
        version = self.sdf_version or own or before or DEFAULT_SDF_VERSION
        urdf = self.urdf_version or self._readable_urdf(before)
        if source.format is format_:  # words of a newer URDF stay in an older one, whose readers ignore them
            mixed = format_ is Format.URDF and urdf != before
        else:
            mixed = (version if format_ is Format.SDF else urdf) == before and has_mixed_words(source)
        return Target(format_, version, urdf, self.requested, mixed, self.mixed)

    def _readable_urdf(self, before: str | None) -> UrdfVersion:
        """Return the version of URDF of a source, where consumers read it, and otherwise the newest that they read."""
        usual = before if before in URDF_VERSIONS else "1.0"
        return next(each for each in URDF_VERSIONS if each in {usual, self.newest_urdf})


def _pipeline(passes: str | Iterable[Pass] | None) -> Pipeline:
    if not isinstance(passes, str):
        return passes if isinstance(passes, Pipeline) else Pipeline(tuple(passes or ()))
    from twinform.passes import parse_pipeline  # noqa: PLC0415 - most conversions have no passes of the user

    return parse_pipeline(passes)
