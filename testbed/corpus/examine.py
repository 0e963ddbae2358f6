"""All that is claimed about one real file, tried on it."""

import time
import traceback
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import twinform
from testbed.corpus.files import CorpusFile
from testbed.corpus.there_and_back import robots, taken_there
from testbed.oracles.xml_trees import first_difference
from twinform.compiler import LoadResult
from twinform.compiler.audit import audit
from twinform.diagnostics import Diagnostic
from twinform.ir import Document, Format
from twinform.testing.properties import Mismatch


@dataclass(frozen=True, slots=True)
class Examined:
    """What the compiler makes of a file. The rules are those of the errors that stopped it, each once.

    `without_robot` means that there is no model in it, so nothing to convert to URDF.
    `unaccounted` are elements and attributes of it that an audit of the conversions does not find again.
    `difference` is the first place where the file and its own text from the compiler differ, `there_and_back` whether
    every robot that was converted comes back as it was, and `mismatches` what of them does not. `faults` are broken
    promises: tracebacks, and refusals that name no line.
    """

    name: str
    accepted: bool = False
    refused_by: tuple[str, ...] = ()
    converted: bool = False
    without_robot: bool = False
    not_converted_by: tuple[str, ...] = ()
    identical: bool = False
    difference: str = ""
    unaccounted: tuple[str, ...] = ()
    there_and_back: bool = False
    mismatches: tuple[Mismatch, ...] = ()
    faults: tuple[str, ...] = ()
    seconds: float = 0.0


@cache
def examined(files: tuple[CorpusFile, ...]) -> tuple[Examined, ...]:
    """All claims tried on some files; the tests that share a process share the work."""
    return tuple(examine(file) for file in files)


def examine(file: CorpusFile) -> Examined:
    """Check a file, convert it to the other format, and write it in its own; no exception comes out of it."""
    path, data = file.path, file.path.read_bytes()
    found = Examined(file.name)
    start = time.perf_counter()
    loaded = _checked(path)
    if isinstance(loaded, str):
        found = replace(found, faults=(loaded,))
    elif loaded.document is None or not loaded.accepted:
        faults = without_line(loaded.diagnostics)
        found = replace(found, refused_by=rules_of(loaded.diagnostics), faults=faults)
    else:
        found = _converted(file, loaded.document, replace(found, accepted=True))
        found = _written_again(path, data, loaded.document, found)
    return replace(found, seconds=time.perf_counter() - start)


def _checked(path: Path) -> LoadResult | str:
    try:
        return twinform.check(path)
    except Exception as error:  # noqa: BLE001 - every exception is a fault to report
        return fault(error)


def _converted(file: CorpusFile, document: Document, found: Examined) -> Examined:
    try:
        if not robots(document):
            return replace(found, without_robot=True)
        there = list(taken_there(file, document))
        mismatches = tuple(each for one in there for each in one.mismatches())
    except twinform.CompileError as error:
        faults = (*found.faults, *without_line(error.diagnostics))
        return replace(found, not_converted_by=rules_of(error.diagnostics), faults=faults)
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        return replace(found, faults=(*found.faults, fault(error)))
    lost = tuple(part for one in there for part in _list_unaccounted(one.conversion))
    return replace(found, converted=True, there_and_back=not mismatches, mismatches=mismatches, unaccounted=lost)


def _list_unaccounted(conversion: twinform.Conversion) -> tuple[str, ...]:
    assert conversion.source is not None
    parts = audit(conversion.source, conversion.text, conversion.ledger).unaccounted
    return tuple(f"line {part.location.line}: {part.location.path}: {part.text}" for part in parts)


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


def first_error(diagnostics: Iterable[Diagnostic]) -> str:
    """The first of the errors: its rule, and its message."""
    first = next(each for each in diagnostics if each.is_error)
    return f"{first.rule.name}: {first.message}"


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
