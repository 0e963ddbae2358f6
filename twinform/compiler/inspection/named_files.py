"""Missing files that a model names: meshes, textures and includes, and paths that only Windows reads."""

from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.input.finding_lines import PartFinder, line_of_text
from twinform.compiler.inspection.near_files import is_elsewhere, near_file
from twinform.compiler.search.resolve_uris import SearchPath, UriError, exists
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document
from twinform.passes.shared.document_uris import Kind, map_uris
from twinform.schemas import XmlElement

# Different URIs that are looked for; a hostile file may have a million.
_MOST = 1000
# The most missing files for which similar names are looked for.
_MOST_NEAR = 50
_WORDS: dict[Kind, str] = {"mesh": "mesh", "texture": "file", "include": "included model"}


class _Use(NamedTuple):
    """A URI where it stands first."""

    uri: str
    kind: Kind
    where: Location


class _Missing(NamedTuple):
    """A URI that leads nowhere, what is called nearly so, and where was looked."""

    use: _Use
    near: str | None
    looked: str | None


def report_named_files(
    document: Document, path: Path, search: SearchPath, tree: XmlElement | None, sink: DiagnosticSink
) -> None:
    """Report each URI once, where it stands first; of a text that lies nowhere only how it is written.

    Where nothing of a package, or of what is beside the file, is there, that is one finding.
    """
    uses = _uses(document)
    parts = None if tree is None else PartFinder(tree)
    wrong = [use for use in uses if "\\" in use.uri]
    for use in wrong:
        message = f"backslashes in the path of a file, '{use.uri}', are no separators"
        hint = f"write '{use.uri.replace(chr(92), '/')}'"
        sink.report(rules.BACKSLASH_IN_PATH, message, _place(use, parts), found=use.uri, help=hint)
    if not exists(path):
        return
    found: set[str] = set()
    missing: defaultdict[str, list[_Missing]] = defaultdict(list)
    gone_before = 0
    for use in (use for use in uses if "\\" not in use.uri and "$" not in use.uri):
        gone = _look_for(use, path, search, asks=gone_before < _MOST_NEAR)
        gone_before += gone is not None
        if gone is None:
            found.add(_holder(use.uri))
        elif gone.near is not None:
            _report((gone,), parts, sink)
        # Packages and models that are not on this machine may be installed where the robot is. Of
        # 1,489 corpus files, whose meshes were mostly left behind, 698 had 4,589 missing files: a
        # finding for each would have hidden everything else, so a package of which nothing is there
        # is one finding (777 in all).
        elif not is_elsewhere(use.uri, search, path):
            missing[_holder(use.uri)].append(gone)
    for holder, gone in missing.items():
        for group in ((each,) for each in gone) if holder in found else (gone,):
            _report(group, parts, sink)


def _uses(document: Document) -> list[_Use]:
    """The URIs of a document."""
    found: dict[str, _Use] = {}

    def note(uri: str, kind: Kind, where: Location) -> str:
        if len(found) < _MOST:
            found.setdefault(uri.strip(), _Use(uri.strip(), kind, where))
        return uri

    map_uris(document, note)
    return list(found.values())


def _holder(uri: str) -> str:
    """The package or model of a URI; empty for a path."""
    scheme, separator, rest = uri.partition("://")
    return f"{scheme}://{rest.partition('/')[0]}" if separator else ""


def _look_for(use: _Use, path: Path, search: SearchPath, *, asks: bool) -> _Missing | None:
    """What is missing; None for what is there, even where it must not be read."""
    try:
        search.find(use.uri, path)
    except UriError as error:
        if error.rule is rules.UNRESOLVED_URI:
            return _Missing(use, near_file(use.uri, search, path) if asks else None, error.help)
    return None


def _report(missing: Iterable[_Missing], parts: PartFinder | None, sink: DiagnosticSink) -> None:
    first, *others = missing
    use = first.use
    message = f"the {_WORDS[use.kind]} {use.uri!r} is not there"
    if others:
        message += f", nor is anything else of {_holder(use.uri) or 'what is named by a path'}: {len(others)} more"
    hint = f"did you mean {first.near!r}?" if first.near else first.looked
    related = tuple(each.use.where for each in others)
    sink.report(rules.MISSING_FILE, message, _place(use, parts), found=use.uri, help=hint, related=related)


def _place(use: _Use, parts: PartFinder | None) -> Location:
    line = line_of_text(parts, use.where, use.uri) if parts else 0
    return use.where._replace(line=line or use.where.line)
