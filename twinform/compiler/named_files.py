"""Missing files that a model names: meshes, textures and includes, and paths that only Windows reads."""

import os
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from posixpath import normpath
from typing import NamedTuple
from urllib.parse import unquote

from twinform.compiler.input.finding_lines import PartFinder, line_of_text
from twinform.compiler.mistakes.mesh_checks import MeshFiles, find_mesh_fault, find_package_fault
from twinform.compiler.resolve_uris import SearchPath, UriError, exists
from twinform.diagnostics import DiagnosticSink, Location, is_typo, near_names, rules, suggest
from twinform.file_access import Readable
from twinform.ir import Document
from twinform.passes.shared.document_uris import Kind, map_uris
from twinform.schemas import XmlElement

# Different URIs that are looked for; a hostile file may have a million.
_MOST = 1000
# The most missing files for which similar names are looked for.
_MOST_NEAR = 50
_MANY = 5
"""So many missing files of one package are one finding, though others of it are there: a folder was moved."""
_WORDS: dict[Kind, str] = {"mesh": "mesh", "texture": "file", "include": "included model"}


class _Use(NamedTuple):
    """A URI, and where it stands first."""

    uri: str
    kind: Kind
    where: Location


_NO_FILE = "__default__"
"""What the description of SDF has as the default of URIs of materials (sdf/material.sdf)."""


class _Missing(NamedTuple):
    """A URI that leads nowhere, similar names, and where was looked."""

    use: _Use
    near: Sequence[str]
    looked: str | None


def report_named_files(
    document: Document, path: Path, search: SearchPath, tree: XmlElement | None, sink: DiagnosticSink
) -> MeshFiles:
    """Report each missing or broken file once, where it is named first, and paths with backslashes.

    If nothing of a package, or nothing that is named by a path, is there, it is one finding. For a text that came from
    no file, only backslashes are reported. Returns the meshes that are there.
    """
    files = MeshFiles(search.readable(path))
    uses = _uris_of(document)
    parts = None if tree is None else PartFinder(tree)
    wrong = [use for use in uses if "\\" in use.uri]
    for use in wrong:
        message = f"backslashes in the path of a file, '{use.uri}', are no separators"
        hint = f"write '{use.uri.replace(chr(92), '/')}'"
        sink.report(rules.BACKSLASH_IN_PATH, message, _place(use, parts), found=use.uri, help=hint)
    if not exists(path):
        return files
    found: set[str] = set()
    missing: defaultdict[str, list[_Missing]] = defaultdict(list)
    gone_before = 0
    for use in (use for use in uses if use.uri and "\\" not in use.uri and "$" not in use.uri):
        gone = _look_for(use, path, search, files, asks=gone_before < _MOST_NEAR)
        gone_before += gone is not None
        if gone is None:
            _report_found(use, parts, (path, search, files), found, sink)
            found.add(_holder(use.uri))
        elif gone.near:
            _report_missing((gone,), parts, sink)
        else:
            missing[_holder(use.uri)].append(gone)
    for holder, gone in missing.items():
        if is_elsewhere(gone[0].use.uri, search, path):
            _report_elsewhere(holder, gone, parts, sink)
            continue
        some_are_there = holder in found
        for group in ((each,) for each in gone) if some_are_there and len(gone) < _MANY else (gone,):
            _report_missing(group, parts, sink, some_are_there=some_are_there)
    return files


def _report_elsewhere(holder: str, gone: list[_Missing], parts: PartFinder | None, sink: DiagnosticSink) -> None:
    """Note a package that is not on this machine."""
    # It may be installed where the robot is. Of 1,489 corpus files, whose meshes were mostly left
    # behind, 698 had 4,589 missing files: a finding for each would have hidden everything else, so
    # a package of which nothing is there is one finding (777 in all).
    if not holder.startswith("package://"):
        return
    name = holder.removeprefix("package://")
    files = "1 file of it" if len(gone) == 1 else f"{len(gone)} files of it"
    message = f"package {name!r} is not on this machine: {files} cannot be checked"
    hint = "source the workspace, or name its folder with --path DIR"
    sink.report(rules.UNKNOWN_PACKAGE, message, _place(gone[0].use, parts), found=name, help=hint)


def _report_found(
    use: _Use,
    parts: PartFinder | None,
    around: tuple[Path, SearchPath, MeshFiles],
    holders: set[str],
    sink: DiagnosticSink,
) -> None:
    """Report what is wrong with a file that is there, and with its package, the first time that it is named."""
    path, search, files = around
    is_new = use.uri.startswith("package://") and _holder(use.uri) not in holders
    mesh_fault = find_mesh_fault(use.uri, _shown(use), files)
    faults = (find_package_fault(use.uri, search, path) if is_new else None, mesh_fault)
    for each in filter(None, faults):
        sink.report(each.rule, each.message, _place(use, parts), found=use.uri, help=each.help)


def _uris_of(document: Document) -> list[_Use]:
    """Return the URIs of a document."""
    found: dict[str, _Use] = {}

    def note(uri: str, kind: Kind, where: Location) -> str:
        if len(found) < _MOST and uri.strip() != _NO_FILE:
            found.setdefault(uri.strip(), _Use(uri.strip(), kind, where))
        return uri

    map_uris(document, note)
    return list(found.values())


def _holder(uri: str) -> str:
    """Return the package or model of a URI; empty for a path."""
    scheme, separator, rest = uri.partition("://")
    return f"{scheme}://{rest.partition('/')[0]}" if separator else ""


def _look_for(use: _Use, path: Path, search: SearchPath, files: MeshFiles, *, asks: bool) -> _Missing | None:
    """Return a URI as missing; None for a file that is there, even where it must not be read."""
    try:
        found = search.find(use.uri, path)
        if use.kind == "mesh":
            files.paths[use.uri] = found
    except UriError as error:
        if error.rule is rules.UNRESOLVED_URI:
            return _Missing(use, near_files(use.uri, search, path) if asks else (), error.help)
    return None


def _report_missing(
    missing: Iterable[_Missing], parts: PartFinder | None, sink: DiagnosticSink, *, some_are_there: bool = True
) -> None:
    first, *others = missing
    use = first.use
    message = f"the {_WORDS[use.kind]} {_shown(use)!r} is not there"
    holder = _holder(use.uri) or "what is named by a path"
    if others and some_are_there:
        message += f", nor are {len(others)} more files of {holder}"
    elif others:
        message += f", nor is anything else of {holder}: {len(others)} more"
    hint = suggest(first.near) or first.looked
    related = tuple(each.use.where for each in others)
    sink.report(rules.MISSING_FILE, message, _place(use, parts), found=use.uri, help=hint, related=related)


def _shown(use: _Use) -> str:
    """Return a URI as a message has it: an absolute path, as `$(find)` makes it, is named as the file itself is."""
    path = unquote(use.uri.removeprefix("file://"))
    if not path.startswith(os.sep):
        return use.uri
    from twinform.compiler.input.xacro_needs import shown_name  # noqa: PLC0415 - few files have absolute paths

    return shown_name(path, use.where.file)


def _place(use: _Use, parts: PartFinder | None) -> Location:
    line = line_of_text(parts, use.where, use.uri) if parts else 0
    return use.where._replace(line=line or use.where.line)


# Models and packages are often not on this machine at all, so only a very similar name is taken for
# the intended one.
_ALIKE = 0.75
_NAMED = frozenset({"model", "package"})
MESHES = (".stl", ".dae", ".obj", ".glb", ".gltf", ".ply", ".off", ".fbx")
IMAGES = (".png", ".jpg", ".jpeg", ".tga", ".bmp", ".dds", ".gif", ".tif", ".tiff")
_SCHEMES = ("file", "http", "https", "model", "package")


def is_elsewhere(uri: str, search: SearchPath, beside: Path) -> bool:
    """Whether a URI leads to something that is not on this machine: an unknown package or model, or the network."""
    scheme, separator, rest = uri.partition("://")
    if not separator:
        return False
    if scheme not in _NAMED:
        return scheme != "file" or rest.lower().startswith("media/")  # of Gazebo Classic, or a package for it
    name = normpath(unquote(rest)).partition("/")[0]
    return _package_folder(name, search, beside) is None


def near_files(uri: str, search: SearchPath, beside: Path) -> Sequence[str]:
    """Return what may have been meant by the first part of a URI that is not there."""
    scheme, separator, rest = uri.partition("://")
    before, colon, _ = uri.partition(":")
    if colon and not separator and before in _SCHEMES:
        return [f"{before}://"]
    if separator and scheme not in _SCHEMES:
        return [f"{each}://" for each in near_names(scheme, _SCHEMES, _ALIKE) if is_typo(scheme, each)]
    path = normpath(unquote(rest)) if separator else normpath(uri)
    if scheme not in _NAMED or not separator:
        return _near_below(beside.parent, path, search, beside)
    name, _, inner = path.partition("/")
    folder = _package_folder(name, search, beside)
    if folder is None:
        known = _known_names(scheme, search, beside)
        return [each for each in near_names(name, known, _ALIKE) if is_typo(name, each)]
    return _near_below(folder, inner, search, beside)


def _package_folder(name: str, search: SearchPath, beside: Path) -> Path | None:
    try:
        return search.package(name, beside)
    except UriError:
        return None


def _near_below(folder: Path, path: str, search: SearchPath, beside: Path) -> Sequence[str]:
    """Return the names of files that are similar to the first part of a path that is not there."""
    for part in path.split("/"):
        if not exists(folder / part):
            # a file from elsewhere must learn of no names but those around it
            if not Readable.of(beside).allows(folder):
                return ()
            by_suffix, suffix = search.index.listing(folder).by_suffix, Path(part).suffix.lower()
            return _near_parts(part, by_suffix.get(suffix, ())) or _with_other_suffixes(part, suffix, by_suffix)
        folder = folder / part
    return ()


def _with_other_suffixes(part: str, suffix: str, by_suffix: Mapping[str, Sequence[str]]) -> Sequence[str]:
    """Return the files of the same kind and name that have another suffix: meshes and images are often converted."""
    kind = next((each for each in (MESHES, IMAGES) if suffix in each), ())
    found = (name for each in kind for name in by_suffix.get(each, ()))
    return [name for name in found if Path(name).stem == Path(part).stem]


def _near_parts(part: str, names: Iterable[str]) -> Sequence[str]:
    """Return the files or folders with a similar name; the suffix, which is the same, makes no two names similar."""
    stem = Path(part).stem
    stems: defaultdict[str, list[str]] = defaultdict(list)
    for name in names:
        stems[Path(name).stem].append(name)
    near = (stem,) if stem in stems else near_names(stem, stems)
    return [name for each in near for name in stems[each]]


def _known_names(scheme: str, search: SearchPath, beside: Path) -> Iterator[str]:
    """Yield the names of the packages or models around a file, and in the folders that were named."""
    around = search.surroundings(beside).folders
    index = search.index
    if scheme == "package":
        for folder in (*search.own, *around):
            inside = (folder / name for name in index.listing(folder).folders)
            yield from filter(None, map(index.name_of, (folder, *inside)))
        return
    for folder in (*search.own, *search.models, *around, *(each / "models" for each in around)):
        yield from index.models_in(folder)
