"""Does every SDF file survive older versions, and is it the same robot to Drake?"""

from collections import Counter
from collections.abc import Iterable
from itertools import groupby

from reports.harness.known import Known
from reports.harness.sample import Sample, is_good
from reports.harness.section import UNEXPLAINED, Findings, Section
from reports.same_robot.version_verdicts import Comparison, judge
from testbed.corpus.files import CorpusFile, Kind, corpus_files
from testbed.corpus.versions import NEWEST, Trip, there_and_back
from testbed.markdown import listing, subsection, table
from twinform.compiler.workers import Failure
from twinform.testing import oracles

KNOWN = Known.beside(__file__)
VERSIONS = ("1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11")
SHOWN = "1.6"
_SECONDS = 120
_EVERY = 3
"""Drake is shown one of so many."""
_ABOUT = f"""\
Every SDF file of the corpus that is accepted goes to {NEWEST}, from there down to an older version, and up again; each
step is written and read again, and the two documents of {NEWEST} have to be equal in the IR. What the older version
cannot express travels in carriers, so nothing should be missing; a difference without an entry in a ledger is *lost*.
*Stale* are files whose carriers were not trusted although nobody edited them, *unclean* those with parts in the older
version that it does not have."""
_DRAKE = """One in three of the models that libsdformat takes: the file as it is, and what it becomes by way of
the newest version. A part of another tool, such as `<drake:joint>`, may name a frame that an older version does not
have."""


def measure(sample: Sample) -> Findings:
    """Travel and compare."""
    trips, failures = sample.lists(_travel, sample.models(Kind.SDF), seconds=_SECONDS)
    trips.sort(key=lambda trip: (VERSIONS.index(trip.version), trip.name))
    refused = {
        trip.name: KNOWN.why("refused", trip.name) for trip in trips if not trip.arrived and trip.version == SHOWN
    }
    lost = [f"{one.name} {one.version}: {one.difference}" for one in trips if one.difference and not one.accounted]
    unexplained = [f"{name}: not explained" for name, why in refused.items() if not why]
    return Findings(
        [*_trip_sections(trips, failures, refused), _drake_section(sample)],
        _by_version(trips),
        [*lost, *failures, *unexplained],
    )


def _travel(file: CorpusFile) -> list[Trip]:
    found = [there_and_back(file, version) for version in VERSIONS]
    return [trip for trip in found if trip is not None]


def _trip_sections(trips: list[Trip], failures: list[str], why: dict[str, str]) -> Iterable[str]:
    yield subsection(f"{NEWEST}, an older version, and {NEWEST} again", _by_version(trips))
    refused = [trip for trip in trips if not trip.arrived]
    yield subsection("Refused during the conversion, by rule", _refusals(refused))
    shown = [
        (one.name, ", ".join(one.refused_by), why[one.name] or UNEXPLAINED) for one in refused if one.version == SHOWN
    ]
    yield f"The files that do not go to {SHOWN}:\n\n" + table(["file", "rules", "why"], shown) if shown else ""
    different = [(trip.name, trip.version, trip.difference) for trip in trips if trip.difference]
    yield subsection("Not equal", listing(["file", "version", "first difference"], different))
    yield subsection("Broken promises", "\n".join(failures) or "None.")


def _by_version(trips: list[Trip]) -> str:
    rows = [_row(version, list(group)) for version, group in groupby(trips, key=lambda trip: trip.version)]
    return table(["version", "files", "refused", "equal", "different, in a ledger", "lost", "stale", "unclean"], rows)


def _row(version: str, trips: list[Trip]) -> tuple[object, ...]:
    different = [trip for trip in trips if trip.difference]
    return (
        version,
        len(trips),
        sum(not trip.arrived for trip in trips),
        sum(trip.arrived and not trip.difference for trip in trips),
        sum(trip.accounted for trip in different),
        sum(not trip.accounted for trip in different),
        sum(trip.stale for trip in trips),
        sum(bool(trip.unclean) for trip in trips),
    )


def _refusals(refused: list[Trip]) -> str:
    counts = Counter((trip.version, rule) for trip in refused for rule in trip.refused_by)
    ordered = sorted(counts.items(), key=lambda item: (VERSIONS.index(item[0][0]), -item[1], item[0][1]))
    return listing(["version", "rule", "files"], [(*key, count) for key, count in ordered])


def _drake_section(sample: Sample) -> str:
    title = "Compared by Drake"
    if not oracles.available("drake"):
        return subsection(title, "Drake was not there.")
    found: list[Comparison] = []
    for file, result in sample.run(judge, sample.of(_shown_to_drake()), seconds=_SECONDS):
        found += [Comparison(file.name, "the file", "not read by Drake")] if isinstance(result, Failure) else result
    counts = Counter((one.subject, one.verdict) for one in found)
    rows = [(*key, count) for key, count in sorted(counts.items())]
    odd = [(one.name, one.subject, one.cause) for one in sorted(found, key=lambda one: one.name) if one.cause]
    why = listing(["file", "given to Drake", "why"], odd, empty="")
    return subsection(title, _DRAKE, table(["given to Drake", "verdict", "files"], rows), why)


def _shown_to_drake() -> list[CorpusFile]:
    return [file for file in corpus_files() if file.kind is Kind.SDF and is_good(file)][::_EVERY]


SECTION = Section("versions", _ABOUT, measure, known=KNOWN)
