"""One robot that falls and is driven in two engines; runs in a worker process, since each of them may end it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

from lxml import etree

import twinform
from testbed import output_files
from testbed.corpus.files import CorpusFile, Kind
from testbed.mjcf.driven import CannotBeDrivenError, Driven, Setup, driven, prepared, without_constraints
from testbed.output_files import SDF_VERSION

_OUT = output_files.OUT / "mjcf_motion"
_MOST_JOINTS = 40
_SHARE = 1 / 3
_BY_DIRECTION = re.compile(rb"<(slip[12]|fdir1)>")


class Place(StrEnum):
    """Where a robot is let go."""

    AIR = "in the air"
    GROUND = "on the ground"


BOUNDS = {Place.AIR: 0.001, Place.GROUND: 0.005}
"""How far apart the ends of a link may be, in m."""


@dataclass(frozen=True, slots=True)
class Moved:
    """A robot in a place, and how it moved; or why it did not, or why the two ends are apart."""

    name: str
    place: Place
    driven: Driven | None = None
    cause: str = ""
    reason: str = ""

    @property
    def is_within(self) -> bool:
        """Whether the two ends are within the bound."""
        return self.driven is not None and self.driven.apart <= BOUNDS[self.place]


def drive(file: CorpusFile) -> list[Moved]:
    """Drive a robot in both places. A world, or a robot that cannot be converted, is passed over."""
    data = file.path.read_bytes()
    if (file.kind is Kind.SDF and b"<world" in data) or data.count(b"<joint") > _MOST_JOINTS or b"<joint" not in data:
        return []
    try:
        sdf = _sdf(file)
        return [_moved(file, sdf, place) for place in Place]
    except (twinform.CompileError, UnicodeDecodeError, etree.XMLSyntaxError):
        return []


def _sdf(file: CorpusFile) -> str:
    if file.kind is Kind.URDF:
        return twinform.convert(file.path, to="sdf", sdf_version=SDF_VERSION, paths=file.paths).text
    return file.path.read_text(encoding="utf-8")


def _moved(file: CorpusFile, sdf: str, place: Place) -> Moved:
    try:
        setup = prepared(sdf, _OUT / f"{file.name}.sdf", file.paths, on_ground=place is Place.GROUND)
        found = Moved(file.name, place, driven(setup))
        return found if found.is_within else replace(found, reason=_reason(found, setup, file))
    except CannotBeDrivenError as error:
        return Moved(file.name, place, cause=str(error))
    except ValueError as error:
        return Moved(file.name, place, cause=f"MuJoCo: {str(error).partition(chr(10))[0]}")


def _reason(found: Moved, setup: Setup, file: CorpusFile) -> str:
    """Why the ends are apart, as far as an experiment tells."""
    ends = found.driven
    if ends is None or _depends_on_details(ends):
        return "" if ends is None else "contacts" if ends.soft else "steps of time"
    constraints = ", ".join(_constraints(ends, setup))
    if constraints:
        free = driven(without_constraints(setup, file.paths))
        if free.apart <= BOUNDS[found.place] or _depends_on_details(free):
            return constraints
    return ""


def _depends_on_details(ends: Driven) -> bool:
    """Whether steps of time, or how stiff contacts are, change the end within one engine as much as another engine."""
    return max(ends.dart, ends.mujoco, ends.soft) > ends.apart * _SHARE


def _constraints(ends: Driven, setup: Setup) -> Iterator[str]:
    """What a robot has that is taken away for the second run."""
    if ends.reaches_limit:
        yield "a limit"
    if "<equality>" in setup.mjcf:
        yield "mimics and loops"
    if "frictionloss=" in setup.mjcf:
        yield "friction of joints"
    if "gravcomp=" in setup.mjcf:
        yield "links without gravity"
    if setup.ground is not None and _BY_DIRECTION.search(setup.sdf.read_bytes()):
        yield "friction by direction"
