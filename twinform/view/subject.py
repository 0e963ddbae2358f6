"""What the viewer shows: a robot or world as a scene, with findings and the fates of its parts in a conversion."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import convert
from twinform.compiler.expand_includes import expand
from twinform.compiler.input.loading import Input, LoadOptions, LoadResult, read
from twinform.compiler.inspection import inspect
from twinform.compiler.resolve_uris import SearchPath
from twinform.compiler.scene import Scene, build_scene
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Location
from twinform.diagnostics.ledger import LedgerEntry
from twinform.ir import Document, Model
from twinform.passes import PassError
from twinform.passes.shared.candidates import candidates

About = Diagnostic | LedgerEntry
"""A finding about a place in the file, or the fate of the part there in a conversion."""


@dataclass(frozen=True)
class ViewSubject:
    """A document to be shown. `path` is its file; meshes are looked for beside it.

    `unconverted` says why there are no `entries` of a model.
    """

    document: Document
    scene: Scene
    path: str = ""
    search: SearchPath | None = None
    findings: tuple[Diagnostic, ...] = ()
    entries: tuple[LedgerEntry, ...] = ()
    unconverted: tuple[str, ...] = ()

    @property
    def beside(self) -> Path | None:
        """The file of the document, if it has one."""
        return Path(self.path) if self.path else None

    @cached_property
    def links(self) -> frozenset[str]:
        """The names of all links."""
        return frozenset(link.name for link in self.scene.links)

    @cached_property
    def about(self) -> Mapping[str, tuple[About, ...]]:
        """Findings and ledger entries about links and the joints that move them, by the names of links."""
        found: defaultdict[str, list[About]] = defaultdict(list)
        for each in (*self.findings, *self.entries):
            for link in self.links_at(each.location):
                found[link].append(each)
        return {link: tuple(each) for link, each in found.items()}

    def links_at(self, place: Location) -> tuple[str, ...]:
        """Return the links at a place in a file; for a joint, the link that it moves.

        A file that is included more than once has a link in each of its copies. Macros of xacro may be in another file
        than what they are used in: then the path alone counts.
        """
        return self._find_links(place.file, place.path) or self._find_links(None, place.path)

    def _find_links(self, file: str | None, path: str) -> tuple[str, ...]:
        while path:
            if found := self._parts.get((file, path)):
                return found
            path = path.rpartition("/")[0]
        return ()

    @cached_property
    def _parts(self) -> Mapping[tuple[str | None, str], tuple[str, ...]]:
        """Links by the file and path of links and joints, and by the path alone."""
        found: defaultdict[tuple[str | None, str], tuple[str, ...]] = defaultdict(tuple)
        places = [(link.where, link.name) for link in self.scene.links]
        places += [(joint.where, joint.child) for joint in self.scene.joints if joint.child in self.links]
        for where, link in places:
            for file in {where.file, None}:
                found[file, where.path] += (link,)
        return found


def read_subject(source: Input, load_options: LoadOptions, *, name: str = "") -> tuple[ViewSubject | None, LoadResult]:
    """Read a file or document for the viewer; None if so much is wrong with it that there is nothing to show."""
    loaded = inspect(expand(read(source, load_options, name=name), load_options), load_options)
    document = loaded.document
    if document is None:
        return None, loaded
    scene = build_scene(document)
    entries, unconverted = _convert_each(document) if loaded.accepted else ((), ("it has errors",))
    subject = ViewSubject(
        document, scene, loaded.path, load_options.search, loaded.diagnostics, entries, unconverted
    )  # fmt: skip
    return subject, loaded


def _convert_each(document: Document) -> tuple[tuple[LedgerEntry, ...], tuple[str, ...]]:
    """Convert each model alone to the other format; return the ledger entries, and why models were not converted."""
    entries: list[LedgerEntry] = []
    reasons: list[str] = []
    # With the world around it, each conversion would list all other models as dropped: 28 s and
    # 41,000 entries for 200 models instead of 0.4 s.
    for alone in _separate_models(document):
        try:
            entries += convert(alone, to=document.format.counterpart.value).ledger.entries
        except (CompileError, PassError) as error:
            reasons.append(str(error).partition("\n")[0])
    return tuple(entries), tuple(reasons)


def _separate_models(document: Document) -> Iterator[Document]:
    """Yield a document for each model, since URDF holds one robot; its pose in a world does not matter here."""
    found = [each.model for each in candidates(document) if isinstance(each.model, Model)]
    if len(found) < 2 and not document.worlds:
        yield document
        return
    for model in found:
        alone = model.copy(pose=None)
        yield document.copy(worlds=(), includes=(), models=(alone,))


class ViewError(Exception):
    """A view cannot be shown."""


class ViewerMissingError(ViewError):
    """A library that draws the view is not installed."""

    def __init__(self, library: str) -> None:
        from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

        self.library = library
        super().__init__(f"the 3D view needs {library}; run: {install_command('view')}")


class PortTakenError(ViewError):
    """Another program listens at the port."""

    def __init__(self, port: int) -> None:
        super().__init__(f"port {port} of this machine is taken: choose another one, or leave --port out")
