"""All that is claimed about one real file, tried on it."""

import time
import traceback
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Literal, NamedTuple

import twinform
from tests.corpus.files import CorpusFile
from tests.corpus.ir_difference import first_difference as ir_difference
from tests.oracles.xml_trees import first_difference, is_well_formed
from twinform.compiler import Checked
from twinform.compiler.audit import audit
from twinform.compiler.emitting import emit
from twinform.compiler.memory.document import forget
from twinform.diagnostics import Diagnostic, Notes
from twinform.ir import Document, Format, Include, Model
from twinform.passes.legalise.candidates import candidates, name_once_expanded
from twinform.passes.legalise.sdf_versions.comparison import comparable
from twinform.passes.legalise.to_urdf.select_model import SelectModel

SDF_VERSION = "1.9"
"""What URDF is converted to: the newest version that libsdformat 12 reads."""

MOST_ROBOTS = 3
"""So many models of a world are converted."""
_LIGHT = "model://sun"
"""An include that is no model, in nearly every world of Gazebo Classic."""


@dataclass(frozen=True, slots=True)
class Examined:
    """What the compiler makes of a file. The rules are those of the errors that stopped it, each once.

    `without_robot` says that there is no model in it, so nothing to convert to URDF.
    `unaccounted` are elements and attributes of it that an audit of the conversions does not find again.
    `difference` is the first place where the file and its own text from the compiler differ, `home` whether every
    conversion leads back to the model that it began with, and `astray` where the first one does not. `faults` are
    broken promises: tracebacks, and refusals that name no line.
    """

    name: str
    well_formed: bool
    accepted: bool = False
    refused_by: tuple[str, ...] = ()
    converted: bool = False
    without_robot: bool = False
    not_converted_by: tuple[str, ...] = ()
    identical: bool = False
    difference: str = ""
    unaccounted: tuple[str, ...] = ()
    home: bool = False
    astray: str = ""
    faults: tuple[str, ...] = ()
    seconds: float = 0.0


@cache
def examined(files: tuple[CorpusFile, ...]) -> tuple[Examined, ...]:
    """All claims tried on some files; the tests that share a process share the work."""
    return tuple(examine(file) for file in files)


def examine(file: CorpusFile) -> Examined:
    """Check a file, convert it to the other format, and write it in its own; no exception comes out of it."""
    path, data = file.path, file.path.read_bytes()
    found = Examined(file.name, well_formed=is_well_formed(data))
    start = time.perf_counter()
    checked = _checked(path)
    if isinstance(checked, str):
        found = replace(found, faults=(checked,))
    elif checked.document is None or not checked.accepted:
        faults = without_line(checked.diagnostics)
        found = replace(found, refused_by=rules_of(checked.diagnostics), faults=faults)
    else:
        found = _converted(file, checked.document, replace(found, accepted=True))
        found = _written_again(path, data, checked.document, found)
    return replace(found, seconds=time.perf_counter() - start)


def _checked(path: Path) -> Checked | str:
    try:
        return twinform.check(path)
    except Exception as error:  # noqa: BLE001 - every exception is a fault to report
        return fault(error)


def _converted(file: CorpusFile, document: Document, found: Examined) -> Examined:
    among = robots(document)
    try:
        if document.format is Format.SDF and not among:
            return replace(found, without_robot=True)
        ways = list(_ways(file, document, among))
    except twinform.CompileError as error:
        faults = (*found.faults, *without_line(error.diagnostics))
        return replace(found, not_converted_by=rules_of(error.diagnostics), faults=faults)
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        return replace(found, faults=(*found.faults, fault(error)))
    astray = next((_short(way.astray) for way in ways if way.astray), "")
    lost = tuple(part for way in ways for part in way.unaccounted)
    return replace(found, converted=True, home=not astray, astray=astray, unaccounted=lost)


class _Way(NamedTuple):
    """A conversion: the first difference to the source on its way back, and what an audit of it does not find."""

    astray: str
    unaccounted: tuple[str, ...]


def _ways(file: CorpusFile, document: Document, among: list[str | None]) -> Iterator[_Way]:
    """Convert each robot, count its parts, and go back."""
    if document.format is Format.URDF:
        there = twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION)
        yield _Way(_way_home(document, there.text, "urdf"), _lost(there))
        return
    for robot in among:
        there = twinform.convert(file.path, to="urdf", model=robot, paths=file.paths)
        yield _Way(_way_home(_chosen(file, document, robot), there.text, "sdf"), _lost(there))


def _lost(made: twinform.Conversion) -> tuple[str, ...]:
    assert made.source is not None
    parts = audit(made.source, made.text, made.ledger).unaccounted
    return tuple(f"line {part.location.line}: {part.location.path}: {part.says}" for part in parts)


def _chosen(file: CorpusFile, document: Document, robot: str | None) -> Document:
    """What has to come back: the document, or of one with several models the text of the one that was chosen."""
    if robot is None:
        return document
    notes = Notes()
    alone = SelectModel(model=robot).run(document, notes)
    if notes.has_errors:  # it is an include
        whole = twinform.check(file.path, expand_includes=True, paths=file.paths).document or document
        alone = SelectModel(model=name_once_expanded(document, whole, robot)).run(whole, Notes())
    return twinform.loads(emit(alone, Notes()))


def _way_home(source: Document, there: str, language: Literal["urdf", "sdf"]) -> str:
    try:
        back = twinform.convert(there.encode(), to=language)
    except twinform.CompileError as error:
        return f"refused on the way back: {error}"
    return ir_difference(comparable(source), comparable(forget(back.document))) or ""


def robots(document: Document) -> list[str | None]:
    """The models to convert: of a file with several the first few by name; includes only where there are no others."""
    among = list(candidates(document))
    written = [one for one in among if isinstance(one.model, Model)]
    included = [one for one in among if isinstance(one.model, Include) and one.model.uri != _LIGHT]
    if len(among) == 1:
        return [None] if written or included else []
    return [one.full_name for one in (written or included)[:MOST_ROBOTS]]


def _written_again(path: Path, data: bytes, document: Document, found: Examined) -> Examined:
    """The identity: the file in its own format and version, compared by a judge that knows nothing of the compiler."""
    try:
        text = twinform.convert(path, to="urdf" if document.format is Format.URDF else "sdf").text
        difference = first_difference(data, text.encode())
    except twinform.CompileError as error:
        return replace(found, difference=f"not written: {_short(str(error))}")
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        return replace(found, faults=(*found.faults, fault(error)))
    return replace(found, identical=difference is None, difference=_short(difference or ""))


def rules_of(diagnostics: Iterable[Diagnostic]) -> tuple[str, ...]:
    """The rules of the errors, each once, in order."""
    return tuple(dict.fromkeys(diagnostic.rule.name for diagnostic in diagnostics if diagnostic.is_error))


def without_line(diagnostics: Iterable[Diagnostic]) -> tuple[str, ...]:
    """A broken promise where none of the errors has a line."""
    errors = [diagnostic for diagnostic in diagnostics if diagnostic.is_error]
    if any(error.location.line > 0 for error in errors):
        return ()
    messages = "; ".join(f"{error.rule.name}: {_short(error.message)}" for error in errors)
    return (f"refused without a line: {messages or 'no error is reported'}",)


def fault(error: Exception) -> str:
    """A broken promise: an exception, and where it was raised."""
    where = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {_short(str(error))} ({Path(where.filename).name}:{where.lineno})"


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 200 else f"{line[:199]}~"
