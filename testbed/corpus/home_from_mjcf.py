"""A real file that became MJCF and then its own language again."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import twinform
from testbed.corpus.examine import fault, first_error, rules_of
from testbed.corpus.files import CorpusFile
from testbed.corpus.there_and_back import robots
from twinform.ir import Document
from twinform.passes.includes.expand import has_includes
from twinform.testing.properties import Mismatch, RoundTrip


@dataclass(frozen=True, slots=True)
class Home:
    """What became of a file, or of one robot of a world with includes.

    `refused_by` are the rules of the errors that MJCF cannot be written for, and `lost` is what did not come back.
    """

    name: str
    refused_by: tuple[str, ...] = ()
    lost: tuple[Mismatch, ...] = field(default=())


def come_home(file: CorpusFile) -> list[Home]:
    """Convert all that a file holds to MJCF and back; no exception comes out of it.

    A file with includes comes back without them, so of that each robot is a text of its own.
    """
    checked = twinform.check(file.path, paths=file.paths)
    document = checked.document
    if document is None or not checked.accepted:
        return []
    wanted = robots(document) if has_includes(document) else [None]
    return [_home(file, document, robot) for robot in wanted]


def _home(file: CorpusFile, document: Document, robot: str | None) -> Home:
    name = " ".join(filter(None, (file.name, robot)))
    try:
        there = twinform.convert(file.path, to="mjcf", model=robot, paths=file.paths)
    except twinform.CompileError as error:
        return Home(name, refused_by=rules_of(error.diagnostics))
    return Home(name, lost=tuple(_lost(file, document, robot, there.text)))


def _lost(file: CorpusFile, document: Document, robot: str | None, there: str) -> Iterator[Mismatch]:
    trip = RoundTrip(file.path.read_bytes(), document.format, document.version)
    if has_includes(document):
        trip = RoundTrip.of(file.path, document, model=robot, paths=file.paths)
    try:
        yield from trip.mismatches(trip.back(there))
    except twinform.CompileError as error:
        yield Mismatch("refused", "", first_error(error.diagnostics))
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        yield Mismatch("crash", "", fault(error))
