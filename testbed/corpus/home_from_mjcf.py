"""A real file that became MJCF, with or without the third language on the way, and then its own language again."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import twinform
from testbed.corpus.examine import fault, first_error, rules_of
from testbed.corpus.files import CorpusFile
from testbed.corpus.there_and_back import MOST_ROBOTS
from testbed.edits.edited_file import Language
from twinform.compiler.audit import audit
from twinform.ir import Document, Format
from twinform.passes.includes.expand import has_includes
from twinform.passes.shared.candidates import candidates
from twinform.testing.properties import Mismatch, RoundTrip

_XACRO = b"$("
Way = tuple[Language, ...]


@dataclass(frozen=True, slots=True)
class Home:
    """What became of a file, or of one robot of a world with includes, that was converted to the languages of a way.

    `refused_by` are the rules of the errors that one of them cannot be written for, and `lost` is what did not come
    back, or is not accounted for.
    """

    name: str
    way: Way
    refused_by: tuple[str, ...] = ()
    lost: tuple[Mismatch, ...] = field(default=())


def come_home(file: CorpusFile) -> list[Home]:
    """Convert all that a file holds to MJCF and back; no exception comes out of it.

    A file with includes comes back without them, so of that each of the first robots is a text of its own. What is one
    model, and neither world nor include, goes through all three languages, too.
    """
    checked = twinform.check(file.path, paths=file.paths)
    document = checked.document
    if document is None or not checked.accepted:
        return []
    if has_includes(document):
        names = [each.full_name for each in candidates(document)]
        return [_home(file, document, name, ("mjcf",)) for name in names[:MOST_ROBOTS]]
    third: Language = "sdf" if document.format is Format.URDF else "urdf"
    is_robot = len(document.models) == 1 and not (document.worlds or document.lights)
    ways: tuple[Way, ...] = (("mjcf",), (third, "mjcf"), ("mjcf", third)) if is_robot else (("mjcf",),)
    return [_home(file, document, None, way) for way in ways]


def _home(file: CorpusFile, document: Document, robot: str | None, way: Way) -> Home:
    name = " ".join(filter(None, (file.name, robot)))
    try:
        there = twinform.convert(file.path, to=way[0], model=robot, paths=file.paths)
        lost = tuple(_unaccounted(there))
        for language in way[1:]:
            there = twinform.convert(there.text.encode(), to=language)
    except twinform.CompileError as error:
        return Home(name, way, refused_by=rules_of(error.diagnostics))
    return Home(name, way, lost=(*lost, *_lost(_trip(file, document, robot), there.text)))


def _unaccounted(there: twinform.Conversion) -> Iterator[Mismatch]:
    """What an audit finds neither in the result nor in the ledger."""
    assert there.source is not None
    for part in audit(there.source, there.text, there.ledger).unaccounted:
        yield Mismatch("unaccounted", part.location.path, f"line {part.location.line}: {part.text}")


def _trip(file: CorpusFile, document: Document, robot: str | None) -> RoundTrip:
    if robot is not None:
        return RoundTrip.of(file.path, document, model=robot, paths=file.paths)
    text = file.path.read_bytes()
    if _XACRO in text:  # it comes back expanded
        text = twinform.convert(file.path, to="urdf", paths=file.paths).text.encode()
    return RoundTrip.of_whole(text, document)


def _lost(trip: RoundTrip, there: str) -> Iterator[Mismatch]:
    try:
        yield from trip.mismatches(trip.back(there))
    except twinform.CompileError as error:
        yield Mismatch("refused", "", first_error(error.diagnostics))
    except Exception as error:  # noqa: BLE001 - every other exception is a fault to report
        yield Mismatch("crash", "", fault(error))
