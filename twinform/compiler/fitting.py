"""Conversions for consumers: finds the passes after which they accept the result.

A consumer reads the result, so it is the result that is judged: the source is converted, assessed, and converted again
with the passes that help, until no other pass does.
"""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from twinform.compiler.conversion import Conversion, convert_once
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.load_options import Input, LoadOptions, LoadResult
from twinform.compiler.input.loading import read
from twinform.compiler.inspect_for_consumers import subject_of, unread
from twinform.compiler.inspection import inspect
from twinform.compiler.output.emitting import located
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import Diagnostic, LedgerEntry, Location, PhysicsChange, Severity
from twinform.diagnostics.rules import KEPT_PHYSICS
from twinform.ir import Document, Format
from twinform.ir.versions import parse_version
from twinform.passes import Pass, PassInstrumentation, Pipeline
from twinform.profiles import Assessment, Judgment, Profile, ProfiledFile, assess, findings
from twinform.profiles.remedies import describe_change, in_order, remedies
from twinform.request_options import URDF_VERSIONS, UrdfVersion

# How often a conversion starts over; each time, a pass has brought something else to light.
_ROUNDS = 5


def convert_for_consumers(
    request: ConversionRequest,
    source: Input | LoadResult,
    load_options: LoadOptions,
    *,
    name: str = "",
    instrumentation: PassInstrumentation | None = None,
) -> Conversion:
    """Convert for the consumers whose profiles the options have.

    Raises:
        CompileError: it cannot be converted, or a consumer would refuse the result.
    """
    name = name or (str(source) if isinstance(source, str | Path) else "")
    request = fitted(request, source, load_options, name=name)
    # Once more with the passes that were found, since instrumentation (printing, timing) is to see
    # one conversion and not all attempts.
    made = convert_once(request, source, load_options, name=name, instrumentation=instrumentation)
    told = findings(assessed(made, load_options, name))
    if any(each.is_error for each in told):
        raise CompileError((*made.diagnostics, *told))
    return replace(made, diagnostics=(*made.diagnostics, *told))


def fitted(
    request: ConversionRequest, source: Input | LoadResult, load_options: LoadOptions, *, name: str = ""
) -> ConversionRequest:
    """Return the request with the passes that help its consumers.

    Raises:
        CompileError: a consumer does not read the target, or needs what `keep_physics` forbids.
    """
    _require_readers(load_options.profiles, request, name)
    sdf = request.sdf_version or newest_sdf(load_options.profiles)
    request = replace(request, sdf_version=sdf, newest_urdf=newest_urdf(load_options.profiles))
    steps: tuple[Pass, ...] = ()
    remedied = frozenset(row.rule for each in load_options.profiles for row in each.rows if row.pipeline)
    # The result is judged, and not the source: legalisation changes much, and encodings, odd
    # numbers and stray comments are gone once a file is written anew. It costs a conversion more,
    # and only under `--for`.
    for _ in range(_ROUNDS):
        request = replace(request, remedies=Pipeline(in_order(steps)), remedied=remedied)
        found, entries = _try_conversion(request, source, load_options, name)
        # Not which passes run, but what they changed: many that could change the physics do not.
        if request.keep_physics:
            _require_kept_physics(entries)
        more = [each for each in remedies(found, Format(request.to)) if each not in steps]
        if not more:
            break
        steps = (*steps, *more)
    return request


def newest_sdf(profiles: Iterable[Profile]) -> str | None:
    """Return the newest version of SDF that all consumers read; None where none of them has a limit."""
    versions = (each.release.sdf for each in profiles if each.release.sdf)
    return min(versions, key=parse_version, default=None)


def newest_urdf(profiles: Iterable[Profile]) -> UrdfVersion | None:
    """Return the newest version of URDF that all consumers read; None where none of them has a limit."""
    limits = {each.release.urdf for each in profiles}
    return next((each for each in URDF_VERSIONS if each in limits), None)


def assessed(made: Conversion, load_options: LoadOptions, name: str) -> tuple[Assessment, ...]:
    """Read the text of a conversion as consumers do, and return their assessments, at the lines of the source."""
    plain = replace(load_options, profiles=(), xacro=False)
    loaded = inspect(read(made.text.encode(), plain, name=name), plain)
    found = assess(subject_of(loaded, plain), load_options.profiles)
    placed: dict[int, Diagnostic] = {}
    return tuple(_at_source_lines(each, made.document, placed) for each in found)


def _at_source_lines(assessment: Assessment, document: Document, placed: dict[int, Diagnostic]) -> Assessment:
    """Return an assessment at the lines of the source; findings that several consumers share stay one object."""
    judgments: list[Judgment] = []
    for judgment in assessment.judgments:
        finding = judgment.finding
        if id(finding) not in placed:
            placed[id(finding)] = located(replace(finding, location=finding.location._replace(line=0)), document)
        judgments.append(Judgment(judgment.row, placed[id(finding)]))
    return replace(assessment, judgments=tuple(judgments))


def _try_conversion(
    request: ConversionRequest, source: Input | LoadResult, load_options: LoadOptions, name: str
) -> tuple[tuple[Assessment, ...], tuple[LedgerEntry, ...]]:
    """Convert, and return the assessments with the ledger; or the assessments of the errors if there is no result."""
    try:
        made = convert_once(request, source, load_options, name=name)
    except CompileError as error:
        # The errors of a source that a pass fixes must not stop the search for that pass.
        subject = ProfiledFile(name, None, diagnostics=tuple(each for each in error.diagnostics if each.is_error))
        found = assess(subject, load_options.profiles)
        if not any(each.judgments for each in found):
            raise
        return found, ()
    return assessed(made, load_options, name), made.ledger.entries


def _require_readers(profiles: Iterable[Profile], request: ConversionRequest, name: str) -> None:
    """Raise an error where a requested consumer does not read the format to be written."""
    format_ = None if request.to == "json" else Format(request.to)
    deaf = [unread(each, format_, name) for each in profiles if each.named and format_ not in each.formats]
    if deaf:
        raise CompileError(tuple(replace(each, severity=Severity.ERROR) for each in deaf))


def _require_kept_physics(entries: Iterable[LedgerEntry]) -> None:
    """Raise an error where a pass has changed the physics."""
    changes = [(each.change, each.location) for each in entries if each.change]
    if changes:
        raise CompileError(tuple(_forbidden(change, place) for change, place in changes))


def _forbidden(change: PhysicsChange, place: Location) -> Diagnostic:
    message = f"{change.step} would change the physics, which is to be kept: {describe_change(change)}"
    return Diagnostic(KEPT_PHYSICS, message, place, Severity.ERROR)
