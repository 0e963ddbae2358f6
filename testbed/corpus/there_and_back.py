"""A real file taken to the other format and back, each robot of it."""

from collections.abc import Iterator
from dataclasses import dataclass

import twinform
from testbed.corpus.files import CorpusFile
from twinform.ir import Document, Format, Include, Model
from twinform.passes.shared.candidates import candidates
from twinform.testing.properties import Mismatch, RoundTrip

SDF_VERSION = "1.9"
"""What URDF is converted to: the newest version that libsdformat 12 reads."""
MOST_ROBOTS = 3
"""So many models of a world are converted."""
_LIGHT = "model://sun"
"""An include that is no model, in nearly every world of Gazebo Classic."""


@dataclass(frozen=True, slots=True)
class There:
    """A robot that has become another format; `name` is that of the model where there are several."""

    name: str | None
    trip: RoundTrip
    conversion: twinform.Conversion

    def mismatches(self, text: str | None = None) -> Iterator[Mismatch]:
        """What is not as it was once it has come back; `text` is what has become of it there."""
        try:
            yield from self.trip.mismatches(self.trip.back(text or self.conversion.text))
        except twinform.CompileError as error:
            first = next(each for each in error.diagnostics if each.is_error)
            yield Mismatch(f"refused: {first.rule.name}", first.location.path, first.message)


def taken_there(file: CorpusFile, document: Document) -> Iterator[There]:
    """Every robot of a file, converted.

    Raises:
        CompileError: it cannot be.
    """
    for robot in robots(document):
        if document.format is Format.URDF:
            conversion = twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION)
        else:
            conversion = twinform.convert(file.path, to="urdf", model=robot, paths=file.paths)
        yield There(robot, RoundTrip.of(file.path, document, model=robot, paths=file.paths), conversion)


def robots(document: Document) -> list[str | None]:
    """The models to convert: of a file with several the first few by name; includes only where there are no others."""
    among = list(candidates(document))
    written = [one for one in among if isinstance(one.model, Model)]
    included = [one for one in among if isinstance(one.model, Include) and one.model.uri != _LIGHT]
    if len(among) == 1:
        return [None] if written or included else []
    return [one.full_name for one in (written or included)[:MOST_ROBOTS]]
