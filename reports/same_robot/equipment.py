"""Does Gazebo find surfaces, materials, sensors, plugins and flags of SDF in our URDF, and of URDF in our SDF?

It reads a robot in SDF, and the URDF that we make of it, which it turns into SDF as Gazebo does, or the other way
around: its own descriptions of both are compared.
"""

from collections import Counter
from collections.abc import Iterator

from reports.harness.known import Known
from reports.harness.needs import corpus, libsdformat
from reports.harness.sample import Sample, is_good
from reports.harness.section import Findings, Section
from testbed.corpus.files import CorpusFile, Kind
from testbed.corpus.there_and_back import SDF_VERSION
from testbed.equipment.differences import CUT_OFF
from testbed.equipment.judging import Outcome, Verdict, judge
from testbed.markdown import subsection, table

KNOWN = Known.beside(__file__)
_SECONDS = 600
_ABOUT = f"""\
Every robot of every SDF file of the corpus that libsdformat 12 takes without an error (of a file with several models
the first three) is converted to URDF, and every URDF to SDF {SDF_VERSION}. libsdformat 12 reads both, and turns the
URDF into SDF as Gazebo does, `<gazebo>` tags and all; a link that it lumps there is the one that it becomes a part of.
Each shape has to be there again, at the same place and with the same values: friction, contact, material, laser_retro
and so on; whatever its name is. A sensor has to be there again with its name, type, parent and content, at
the same place (robot at its zero position; tolerance {CUT_OFF:g}, as libsdformat writes six digits of a pose where it
lumps links), and a contact sensor with the names of its collisions there; a plugin with its content, in the same kind
of element; flags of the model and its links with their values. Numbers are compared as numbers, what is a default is
what is not written, the order of elements does not count, nor do carriers of our own namespace.

*As the conversion says* is a robot all of whose differences are in parts that the ledger lists; on the way to SDF, a
finding such as `unreached-shape` may say it too: the SDF has what stands in the URDF, and Gazebo makes something else
of that. Colors have to differ as `gazebo-material` says, by the factor of 0.8."""


def measure(sample: Sample) -> Findings:
    """Convert, read, and compare."""
    sections, faults = list[str](), list[str]()
    for way, kind in (("from SDF to URDF", Kind.SDF), ("from URDF to SDF", Kind.URDF)):
        files = [file for file in sample.models(kind) if is_good(file)]
        found, failures = sample.lists(_judged, files, seconds=_SECONDS)
        outcomes = sorted((one for one in found if one.parts or one.found), key=lambda one: one.name)
        reasons = {one.name: reason(one) for one in outcomes if one.verdict in _FAULTS}
        bad = [one for one in outcomes if one.verdict in _FAULTS and not reasons[one.name]]
        faults += [*failures, *(f"{one.name}: {one.verdict}: {one.cause}" for one in bad)]
        sections += _sections(way, outcomes, reasons)
    return Findings(sections, sections[0], faults)


def reason(one: Outcome) -> str:
    """Why all of what the conversion does not say is right; empty where that is not known of a part of it."""
    whys = [KNOWN.why("known", one.name, cause=cause) for cause in map(str, one.silent or (one.cause,))]
    return "; ".join(dict.fromkeys(whys)) if all(whys) else ""


_FAULTS = frozenset({Verdict.DIFFERENT, Verdict.RESULT})


def _judged(file: CorpusFile) -> list[Outcome]:
    return list(judge(file))


def _sections(way: str, outcomes: list[Outcome], reasons: dict[str, str]) -> Iterator[str]:
    groups = {verdict: [one for one in outcomes if one.verdict is verdict] for verdict in Verdict}
    rows = [_row(verdict, found) for verdict, found in groups.items() if found]
    yield subsection(f"Robots {way}", table(["verdict", "robots", "parts", "differences", "not said"], rows))
    yield subsection(f"What differs {way}", table(["what", "said", "not said"], _kinds(outcomes)))
    others = [one for one in outcomes if one.verdict not in {Verdict.SAME, Verdict.SAID}]
    if others:
        why = ((one.name, one.verdict, reasons.get(one.name) or one.cause) for one in others)
        yield subsection(f"What is not the same {way}, and why", table(["robot", "verdict", "why"], why))


def _row(verdict: Verdict, found: list[Outcome]) -> tuple[object, ...]:
    differences = sum(len(each.found) for each in found), sum(len(each.silent) for each in found)
    return (verdict, len(found), sum(each.parts for each in found), *differences)


def _kinds(outcomes: list[Outcome]) -> Iterator[tuple[object, ...]]:
    every = Counter(f"{each.kind}: {each.path or 'there or not'}" for one in outcomes for each in one.found)
    silent = Counter(f"{each.kind}: {each.path or 'there or not'}" for one in outcomes for each in one.silent)
    for kind, number in every.most_common():
        yield kind, number - silent[kind], silent[kind]


SECTION = Section("equipment", _ABOUT, measure, (corpus, libsdformat), KNOWN)
