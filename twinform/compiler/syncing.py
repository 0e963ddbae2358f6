"""`twinform sync`: which files of one robot are out of date against the one that is their source, and what they become.

Each file is compared with what the source converts to in its format. One that is out of date follows the source by the
smallest change of its text, as by `convert --into`; one that is missing is made new.
"""

from collections.abc import Iterator
from dataclasses import replace
from enum import StrEnum
from pathlib import Path

from twinform.compiler.compare import USUAL, Comparison, ComparisonOptions
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.in_place import TextChange
from twinform.compiler.input.loading import LoadOptions, LoadResult
from twinform.compiler.into import Follower, has_carriers
from twinform.compiler.mjcf_remainder import AdoptKept
from twinform.compiler.request import ConversionRequest
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, SideFile
from twinform.diagnostics.rules import EDIT_CONFLICT
from twinform.ir import Document, Link, walk
from twinform.passes import Pipeline
from twinform.request_options import Language


class SyncState(StrEnum):
    """What a file is, compared with its source."""

    CURRENT = "up to date"
    OUTDATED = "out of date"
    MISSING = "missing"


@dataclass(frozen=True, slots=True, kw_only=True)
class SyncedFile:
    """A file that is made of the source: its state, how its robot differs, and what it becomes.

    `data` are its bytes then, where they were asked for and anything changes, and `read` those that it has now;
    `changes` are the pieces of its text that change, unless it is written `anew`.
    """

    path: str
    format: Language
    state: SyncState
    comparison: Comparison | None = None
    diagnostics: tuple[Diagnostic, ...] = ()
    data: bytes | None = None
    read: bytes | None = None
    changes: tuple[TextChange, ...] = ()
    anew: bool = False
    side_files: tuple[SideFile, ...] = ()


class AnotherRobotError(Exception):
    """A file has no link of the source, so it is another robot than one that is out of date."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SyncOptions:
    """How files follow their source.

    With `make`, what they become is made too. `rewrite` writes those anew in which the smallest change is not possible.
    With `carriers_as_found`, a file that has no carriers gets none.
    """

    make: bool = True
    rewrite: bool = False
    carriers_as_found: bool = True
    comparison: ComparisonOptions = USUAL


# A default class or an included file of MJCF can hold what has changed, and the smallest change of it
# is not known. Where it cannot be made, the file is written anew.
_ANEW: frozenset[Language] = frozenset({"mjcf"})


def sync_file(
    request: ConversionRequest,
    source: Path,
    target: Path,
    load_options: LoadOptions,
    options: SyncOptions,
) -> SyncedFile:
    """Compare a file with what its source converts to, and say what it becomes.

    Raises:
        CompileError: one of the files has an error, or the smallest change cannot be made.
        AnotherRobotError: the file has no link of the source.
    """
    request = request.beside(target)
    if not target.exists():
        made = run_conversion(request, str(source), load_options, name=str(source))
        return SyncedFile(
            path=str(target),
            format=request.to,
            state=SyncState.MISSING,
            diagnostics=made.diagnostics,
            data=made.text.encode(),
            anew=True,
            side_files=made.side_files,
        )
    follower = Follower.of(request, source, target, load_options)
    _require_accepted(follower.into)
    follower = _fitted(follower, options)
    diagnostics = follower.conversion.diagnostics
    _require_common_links(follower)
    comparison = follower.differences(options.comparison)
    state = SyncState.OUTDATED if comparison.counted else SyncState.CURRENT
    found = SyncedFile(path=str(target), format=request.to, state=state, comparison=comparison, diagnostics=diagnostics)
    return _followed(found, follower, options) if comparison.counted and options.make else found


def _fitted(follower: Follower, options: SyncOptions) -> Follower:
    """Fit what is asked for to the file: to the model in it that has the name of the robot, and to its carriers."""
    request = follower.request
    if options.carriers_as_found and not has_carriers(follower.into):
        request = replace(request, carriers=False)
    if request.model is None and follower.has_several:
        request = replace(request, model=follower.robot_name)
    return replace(follower, request=request)


def _require_accepted(loaded: LoadResult) -> None:
    """Require that a file can be compared.

    Raises:
        CompileError: it has an error.
    """
    if not loaded.accepted:
        raise loaded.error()


def _require_common_links(follower: Follower) -> None:
    """Require that a file has a link of the robot that it is to follow.

    Raises:
        AnotherRobotError: it has none.
    """
    # A wrong name on the command line must not become the end of another robot.
    robot, own = (frozenset(_link_names(each.document)) for each in (follower.edited, follower.into))
    if robot and own and not robot & own:
        raise AnotherRobotError(
            f"{follower.into.path} has no link of {follower.edited.path}, so it is another robot; "
            "delete it, and it is made anew"
        )


def _link_names(document: Document | None) -> Iterator[str]:
    return (each.name for each in walk(document) if isinstance(each, Link)) if document else iter(())


def _followed(found: SyncedFile, follower: Follower, options: SyncOptions) -> SyncedFile:
    """Add what a file becomes that is out of date.

    Raises:
        CompileError: the smallest change cannot be made, and the file may not be written anew.
    """
    # Of a file with a world, what stands around the robot would be lost.
    anew = (options.rewrite or found.format in _ANEW) and not (follower.has_several or follower.has_world)
    try:
        made = follower.updated()
        if not made.changes:
            raise _unreached(found, follower)
    except CompileError as error:
        if anew and _is_conflict(error):
            return _written_anew(found, follower)
        raise
    return replace(
        found,
        data=made.data,
        read=made.source,
        changes=made.changes,
        side_files=made.conversion.side_files,
    )


def _is_conflict(error: CompileError) -> bool:
    """Whether the only errors are about changes of a text."""
    return all(each.rule is EDIT_CONFLICT for each in error.diagnostics if each.is_error)


def _unreached(found: SyncedFile, follower: Follower) -> CompileError:
    """Return the error about a file that is out of date in what no change of its text would reach."""
    sink = DiagnosticSink(found.path, follower.load_options.strict)
    for each in found.comparison.counted if found.comparison else ():
        where = Location(line=each.b.location.line or 1, path=each.b.location.path or "/")
        sink.report(EDIT_CONFLICT, f"cannot be changed in place: {each.message}", where)
    return CompileError((*found.diagnostics, *sink.diagnostics))


def _written_anew(found: SyncedFile, follower: Follower) -> SyncedFile:
    """Write a whole file, with what only its format says of parts that are still there.

    Raises:
        CompileError: the source cannot be converted.
    """
    name, request = follower.edited.path, replace(follower.request, comments=True)
    models = follower.into.document.models if found.format == "mjcf" and follower.into.document else ()
    if models:
        request = replace(request, passes=Pipeline((*request.passes, AdoptKept.of(models[0]))))
    made = run_conversion(request, name, follower.load_options, name=name)
    return replace(
        found,
        diagnostics=made.diagnostics,
        data=made.text.encode(),
        read=follower.into.content,
        anew=True,
        side_files=made.side_files,
    )
