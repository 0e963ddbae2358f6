"""`convert --into`: a file follows the edits of another one that was made of it."""

from dataclasses import replace
from functools import partial
from pathlib import Path

from twinform.compiler.compare import Difference, compare_files
from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.in_place import Updated, updated
from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import EDIT_CONFLICT
from twinform.ir import Document, Format
from twinform.passes import Pipeline
from twinform.schemas import versions_of

Key = tuple[str, str, str]
"""What differs: its group, name and aspect."""


def convert_into(
    request: ConversionRequest, edited: Path, into: Path, load_options: LoadOptions, *, base: Path | None = None
) -> Updated:
    """Convert an edited file, and change in the file `into` only what the edits change.

    The edits are what differs from `base`: the file as it was before them, or else what `into` is converted to. Where
    the SDF is a world, `request.model` names the robot in it, if there are several.

    Raises:
        CompileError: one of the files cannot be converted, or both sides have changed the same.
    """
    followed = read(str(into), load_options, name=str(into))
    request = replace(request, comments=False, sdf_version=_version(request, followed))
    forth = request if request.to == "urdf" else replace(request, model=None)
    source = read(str(edited), load_options.read_by(request.sdf_version), name=str(edited))
    conversion = run_conversion(forth, source, load_options, name=str(edited))
    if base:
        before = run_conversion(forth, str(base), load_options, name=str(base))
    else:
        # There and back, so that what no conversion keeps is no edit.
        built = _built(request, source, followed, load_options)
        before = run_conversion(replace(request, model=None), built, load_options, name=str(into))
    sink = DiagnosticSink(str(into), load_options.strict)
    made = updated(followed, before.document, conversion, sink, same=base is None)
    # A merge pairs parts by names, content and likeness, and a wrong pair would write a wrong robot
    # silently. So the file as it would be is compared with the edited one. It costs two
    # comparisons.
    _require_the_robot(made, before, followed, load_options)
    return made


def _version(request: ConversionRequest, into: LoadResult) -> str | None:
    """The version of SDF that parts are written in: that of the file that they go into, if no other is asked for."""
    if request.to != "sdf" or request.sdf_version:
        return request.sdf_version
    version = _document(into).version
    return version if version in versions_of("sdf") else None


def _document(loaded: LoadResult) -> Document:
    """The document in a file.

    Raises:
        CompileError: it cannot be read.
    """
    if loaded.document is None:
        raise loaded.error()
    return loaded.document


def _built(request: ConversionRequest, edited: LoadResult, into: LoadResult, load_options: LoadOptions) -> bytes:
    """What a file is converted to, in the format and the version of the edited one."""
    document = _document(edited)
    back = replace(request, to=document.format.value, sdf_version=None, urdf_version=None, passes=Pipeline())
    if document.format is Format.SDF:
        back = replace(back, sdf_version=document.version, model=None)
    return run_conversion(back, into, load_options, name=into.path).text.encode()


def _require_the_robot(made: Updated, before: Conversion, into: LoadResult, load_options: LoadOptions) -> None:
    """Raise where a file that has followed the edits is another robot than the edited one, to any reader.

    What differed between them before the edits may differ after them.

    Raises:
        CompileError: a difference is new.
    """
    if not made.changes:
        return
    after, sink = made.conversion, DiagnosticSink(into.path, load_options.strict)
    name = next((each.name for each in after.document.models), None)
    # As `diff` asks by default, without our carriers: an edit that reaches only a carrier has not
    # reached RViz or Gazebo, for whom this file is kept.
    compared = partial(compare_files, load_options=load_options, names=(into.path, into.path), model=name)
    try:
        found = compared(made.data, after.text.encode()).counted
    except CompileError as error:
        sink.report(
            EDIT_CONFLICT,
            f"cannot be changed in place: it would be wrong: {error.diagnostics[0].message}",
            Location(line=1, path="/"),
        )
        raise CompileError((*after.diagnostics, *sink.diagnostics)) from error
    # What differed before the edit is none of its doing.
    known = {_key(each) for each in compared(into, before.text.encode()).counted} if found else set[Key]()
    for each in found:
        if _key(each) not in known:
            where = each.a.location
            message = f"cannot be changed in place: {each.message} would not be as in the edited file"
            sink.report(EDIT_CONFLICT, message, Location(line=where.line or 1, path=where.path or "/"))
    if sink.diagnostics:
        raise CompileError((*after.diagnostics, *sink.diagnostics))


def _key(found: Difference) -> Key:
    return found.group, found.name, found.aspect
