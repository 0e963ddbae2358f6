"""`convert --into` and `sync`: a file follows the edits of another one that was made of it."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property, partial
from pathlib import Path
from typing import cast

from twinform.compiler.compare import Comparison, Difference, Side, compare_files
from twinform.compiler.compare.comparison import USUAL, ComparisonOptions
from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.in_place import Updated, updated
from twinform.compiler.input.loading import LoadOptions, LoadResult, read
from twinform.compiler.mjcf_remainder import DropKept, in_degrees, is_in_degrees, without_own_sites
from twinform.compiler.request import ConversionRequest
from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, Diagnostic, DiagnosticSink, Location
from twinform.diagnostics.rules import EDIT_CONFLICT
from twinform.ir import Document, Format
from twinform.passes import Pipeline
from twinform.passes.shared.candidates import candidates
from twinform.request_options import Language
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
    return Follower.of(request, edited, into, load_options, base=base).updated()


@dataclass(frozen=True)  # no slots: what is made once is kept in the dictionary
class Follower:
    """The file `into`, which is to follow the edits of another one; conversions are made when they are asked for."""

    request: ConversionRequest
    edited: LoadResult
    into: LoadResult
    load_options: LoadOptions
    base: Path | None = None

    @classmethod
    def of(
        cls,
        request: ConversionRequest,
        edited: Path,
        into: Path,
        load_options: LoadOptions,
        *,
        base: Path | None = None,
    ) -> "Follower":
        """Read both files."""
        followed = read(str(into), load_options, name=str(into))
        request = replace(request, comments=False, sdf_version=_version(request, followed))
        source = read(str(edited), load_options.read_by(request.sdf_version), name=str(edited))
        if request.to == "mjcf" and not source.is_mjcf:
            # Whoever edits a URDF has not taken the actuators out of the MJCF by writing none, and
            # those that travel in it may be older.
            request = replace(request, passes=Pipeline((*request.passes, DropKept.unchecked())))
        return cls(request, source, followed, load_options, base)

    @cached_property
    def conversion(self) -> Conversion:
        """What the edited file is converted to.

        Raises:
            CompileError: it cannot be converted.
        """
        return run_conversion(self._forth, self.edited, self.load_options, name=self.edited.path)

    @property
    def _forth(self) -> ConversionRequest:
        return replace(self.request, model=None) if self.request.to == "sdf" else self.request

    @cached_property
    def before(self) -> Conversion:
        """What the edited file was converted to before the edits.

        Raises:
            CompileError: one of the files cannot be converted.
        """
        if self.base:
            return run_conversion(self._forth, str(self.base), self.load_options, name=str(self.base))
        # There and back, so that what no conversion keeps is no edit.
        forth = replace(self.request, model=None)
        return run_conversion(forth, self._built(), self.load_options, name=self.into.path)

    def _built(self) -> bytes:
        """What the file is converted to, in the format and the version of the edited one."""
        document, to = _document(self.edited), _language(self.edited)
        back = replace(self.request, to=to, sdf_version=None, urdf_version=None, passes=Pipeline())
        if to == "sdf":
            back = replace(back, sdf_version=document.version, model=None)
        # A file with carriers was made by a conversion, in which all of this file had its place; one
        # without them has no place for what its format lacks, and has not taken that away.
        back = replace(back, carriers=back.carriers or has_carriers(self.edited))
        return run_conversion(back, self.into, self.load_options, name=self.into.path).text.encode()

    def updated(self) -> Updated:
        """Change in the file only what the edits change.

        Raises:
            CompileError: one of the files cannot be converted, or both sides have changed the same.
        """
        sink = DiagnosticSink(self.into.path, self.load_options.strict)
        before, after = self.before.document, self.conversion
        if self._of_mjcf:
            before = without_own_sites(before, after.document)
            if self.into.tree is not None and is_in_degrees(self.into.tree):
                before, after = in_degrees(before), replace(after, document=in_degrees(after.document))
        made = updated(self.into, before, after, sink, same=self.base is None)
        # A merge pairs parts by names, content and likeness, and a wrong pair would write a wrong robot
        # silently. So the file as it would be is compared with the edited one. It costs two
        # comparisons.
        _require_the_robot(made, self.before, self.into, self.load_options)
        return made

    def differences(self, options: ComparisonOptions = USUAL) -> Comparison:
        """Compare the file with what the edited one is converted to, in the terms that both formats have words for.

        Notes are left out, and so is what no edit of the other file could change.

        Raises:
            CompileError: one of the files cannot be converted or compared.
        """
        a = _located(self.conversion, self.edited, self.load_options)
        names = (self.edited.path, self.into.path)
        model = (self.request.model or self.robot_name) if self.has_several else None
        compared = partial(compare_files, load_options=self.load_options, options=options, model=model)
        found = compared(a, self.into, names=names)
        wrong = self._reachable(found.counted, compared) if found.counted else ()
        if self._of_mjcf:  # lines of the source are those of a text that was read again
            wrong = (
                replace(each, a=replace(each.a, location=NOWHERE)) for each in wrong if not _is_own_frame(each, each.a)
            )
        return replace(found, items=tuple(wrong))

    def _reachable(self, found: tuple[Difference, ...], compared: "partial[Comparison]") -> Iterator[Difference]:
        """Leave out the differences that the file would have too if nothing had been edited."""
        own = _keys(compared(self.before.text.encode(), self.into))
        edits = _keys(compared(self.conversion.text.encode(), self.before.text.encode())) if own else own
        return (each for each in found if _key(each) not in own or _key(each) in edits)

    @property
    def _of_mjcf(self) -> bool:
        return self.request.to == "mjcf"

    @property
    def has_several(self) -> bool:
        """Whether the file has models beside the one that follows."""
        return sum(1 for _ in candidates(_document(self.into))) > 1

    @property
    def has_world(self) -> bool:
        """Whether the file has a world around the model that follows."""
        return bool(_document(self.into).worlds)

    @property
    def robot_name(self) -> str | None:
        """The name of the robot that is followed, if there is one at the root of its file."""
        return next((each.name for each in _document(self.edited).models), None)


_CARRIERS = (b"urn:twinform:1", b'"twinform:')
"""What stands in a file with carriers: our namespace in URDF and SDF, and names of texts in MJCF."""


def has_carriers(loaded: LoadResult) -> bool:
    """Whether a file has carriers, as conversions write them."""
    content = loaded.content or b""
    return any(mark in content for mark in _CARRIERS)


def _is_own_frame(found: Difference, source: Side) -> bool:
    """Whether a difference is a frame, which is a site of MJCF, that the side of the source lacks."""
    return found.group == "frame" and not found.aspect and source.text is None


def _located(conversion: Conversion, edited: LoadResult, load_options: LoadOptions) -> LoadResult:
    """Return what was converted with the places of its parts in the edited file, as far as its format keeps them."""
    if conversion.document.format is Format.MJCF:  # its elements are untyped, and only its text is read as a robot
        return read(conversion.text.encode(), load_options, name=edited.path)
    return LoadResult(edited.path, conversion.document, (), origins=edited.origins)


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


def _language(loaded: LoadResult) -> Language:
    """Return the format of a file, which for MJCF is not that of its document.

    Raises:
        CompileError: it cannot be read.
    """
    return cast("Language", (loaded.format or _document(loaded).format).value)


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
            f"cannot be changed in place: it would be wrong: {_first_error(error)}",
            Location(line=1, path="/"),
        )
        raise CompileError((*after.diagnostics, *sink.diagnostics)) from error
    # What differed before the edit is none of its doing.
    known = {_key(each) for each in compared(into, before.text.encode()).counted} if found else set[Key]()
    for each in found:
        if _key(each) not in known and not (into.is_mjcf and _is_own_frame(each, each.b)):
            where = each.a.location
            message = f"cannot be changed in place: {each.message} would not be as in the edited file"
            sink.report(EDIT_CONFLICT, message, Location(line=where.line or 1, path=where.path or "/"))
    if sink.diagnostics:
        raise CompileError((*after.diagnostics, *sink.diagnostics))


def _first_error(error: CompileError) -> str:
    return next(each.message for each in (*filter(_is_error, error.diagnostics), *error.diagnostics))


def _is_error(found: Diagnostic) -> bool:
    return found.is_error


def _key(found: Difference) -> Key:
    return found.group, found.name, found.aspect


def _keys(found: Comparison) -> frozenset[Key]:
    return frozenset(map(_key, found.counted))
