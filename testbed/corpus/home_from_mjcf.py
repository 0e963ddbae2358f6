"""A real file that became MJCF and then its own language again."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import twinform
from testbed.corpus.examine import fault, first_error, rules_of
from testbed.corpus.files import CorpusFile
from testbed.corpus.there_and_back import MOST_ROBOTS
from twinform.compiler.audit import audit
from twinform.ir import Document
from twinform.passes.includes.expand import has_includes
from twinform.passes.shared.candidates import candidates
from twinform.testing.properties import Mismatch, RoundTrip

_XACRO = b"$("


@dataclass(frozen=True, slots=True)
class Home:
    """What became of a file, or of one robot of a world with includes.

    `refused_by` are the rules of the errors that MJCF cannot be written for, and `lost` is what did not come back, or
    is not accounted for.
    """

    name: str
    refused_by: tuple[str, ...] = ()
    lost: tuple[Mismatch, ...] = field(default=())


def come_home(file: CorpusFile) -> list[Home]:
    """Convert all that a file holds to MJCF and back; no exception comes out of it.

    A file with includes comes back without them, so of that each of the first robots is a text of its own.
    """
    checked = twinform.check(file.path, paths=file.paths)
    document = checked.document
    if document is None or not checked.accepted:
        return []
    if not has_includes(document):
        return [_home(file, document, None)]
    names = [each.full_name for each in candidates(document)]
    return [_home(file, document, name) for name in names[:MOST_ROBOTS]]


def _home(file: CorpusFile, document: Document, robot: str | None) -> Home:
    name = " ".join(filter(None, (file.name, robot)))
    try:
        there = twinform.convert(file.path, to="mjcf", model=robot, paths=file.paths)
    except twinform.CompileError as error:
        return Home(name, refused_by=rules_of(error.diagnostics))
    return Home(name, lost=(*_unaccounted(there), *_lost(_trip(file, document, robot), there.text)))


def _unaccounted(there: twinform.Conversion) -> Iterator[Mismatch]:
    """What an audit finds neither in the MJCF nor in the ledger."""
    assert there.source is not None
    for part in audit(there.source, there.text, there.ledger).unaccounted:
        yield Mismatch("unaccounted", part.location.path, f"line {part.location.line}: {part.text}")


def _trip(file: CorpusFile, document: Document, robot: str | None) -> RoundTrip:
    if robot is not None:
        return RoundTrip.of(file.path, document, model=robot, paths=file.paths)
    text = file.path.read_bytes()
    if _XACRO in text:  # it comes back expanded
        text = twinform.convert(file.path, to="urdf", paths=file.paths).text.encode()
    return RoundTrip(text, document.format, document.version)


def _lost(trip: RoundTrip, there: str) -> Iterator[Mismatch]:
    try:
        yield from trip.mismatches(trip.back(there))
    except twinform.CompileError as error:
        yield Mismatch("refused", "", first_error(error.diagnostics))
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        yield Mismatch("crash", "", fault(error))
