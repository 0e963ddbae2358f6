"""Real models in other versions of SDF, and back."""

import csv
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

import twinform
from reports.harness.known import Known
from reports.harness.pages import listing, section, table
from reports.harness.report import UNEXPLAINED, Findings, Report
from reports.harness.sample import Sample, is_good
from reports.versions.judging import Comparison, judge
from tests.corpus.examine import rules_of
from tests.corpus.files import CORPUS, SHARED, CorpusFile, Kind, corpus_files
from tests.corpus.versions import NEWEST, Trip, there_and_back, upgraded_difference
from twinform.compiler.workers import Failure
from twinform.testing import oracles

PAIRS = SHARED / "reference" / "pairs.csv"
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


@dataclass(frozen=True, slots=True)
class Pair:
    """One model at two versions of SDF, and the first difference when the older one is converted to the newer's."""

    older: str
    newer: str
    refused_by: tuple[str, ...] = ()
    difference: str = ""

    @property
    def first(self) -> str:
        """The first difference, or the rules by which one of the two is refused."""
        return ", ".join(self.refused_by) or self.difference


def measure(sample: Sample) -> Findings:
    """Travel and compare."""
    trips, failures = sample.lists(_travel, sample.models(Kind.SDF), seconds=_SECONDS)
    trips.sort(key=lambda trip: (VERSIONS.index(trip.version), trip.name))
    pairs = list(_pairs())[:: sample.every]
    refused = {
        trip.name: KNOWN.why("refused", trip.name) for trip in trips if not trip.arrived and trip.version == SHOWN
    }
    differing = {pair.newer: KNOWN.why("pairs", pair.newer) for pair in pairs if pair.first}
    lost = [f"{one.name} {one.version}: {one.difference}" for one in trips if one.difference and not one.accounted]
    unexplained = [f"{name}: not explained" for name, why in (*differing.items(), *refused.items()) if not why]
    return Findings(
        [*_trip_sections(trips, failures, refused), _pair_section(pairs, differing), _drake_section(sample)],
        f"{_by_version(trips)}\n{_pair_totals(pairs)}",
        [*lost, *failures, *unexplained],
    )


def _travel(file: CorpusFile) -> list[Trip]:
    found = [there_and_back(file.path, file.name, version) for version in VERSIONS]
    return [trip for trip in found if trip is not None]


def _pairs() -> Iterable[Pair]:
    with PAIRS.open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["kind"] == "sdf-version"]
    for row in rows:
        try:
            difference = upgraded_difference(CORPUS / row["a"], CORPUS / row["b"]) or ""
        except twinform.CompileError as error:
            yield Pair(row["a"], row["b"], refused_by=rules_of(error.diagnostics))
        else:
            yield Pair(row["a"], row["b"], difference=difference)


def _trip_sections(trips: list[Trip], failures: list[str], why: dict[str, str]) -> Iterable[str]:
    yield section(f"{NEWEST}, an older version, and {NEWEST} again", _by_version(trips))
    refused = [trip for trip in trips if not trip.arrived]
    yield section("Refused during the conversion, by rule", _refusals(refused))
    shown = [
        (one.name, ", ".join(one.refused_by), why[one.name] or UNEXPLAINED) for one in refused if one.version == SHOWN
    ]
    yield f"The files that do not go to {SHOWN}:\n\n" + table(["file", "rules", "why"], shown) if shown else ""
    different = [(trip.name, trip.version, trip.difference) for trip in trips if trip.difference]
    yield section("Not equal", listing(["file", "version", "first difference"], different))
    yield section("Broken promises", "\n".join(failures) or "None.")


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


def _pair_section(pairs: list[Pair], why: dict[str, str]) -> str:
    """The differences are those of the files: two versions of a model are seldom the same model."""
    about = f"The older file converted to the version of the newer one, and the newer one. {_pair_totals(pairs)}"
    rows = [(pair.newer, f"`{pair.first}`", why[pair.newer] or UNEXPLAINED) for pair in pairs if pair.first]
    columns = ["newer file", "first difference (the older, the newer)", "cause"]
    return section("One model at two versions", about, table(columns, rows))


def _pair_totals(pairs: list[Pair]) -> str:
    refused = sum(bool(pair.refused_by) for pair in pairs)
    different = sum(bool(pair.difference) for pair in pairs)
    return f"{len(pairs)} pairs: {len(pairs) - refused - different} equal, {different} different, {refused} refused."


def _drake_section(sample: Sample) -> str:
    title = "Compared by Drake"
    if not oracles.available("drake"):
        return section(title, "Drake was not there.")
    found: list[Comparison] = []
    for file, result in sample.run(judge, sample.of(_shown_to_drake()), seconds=_SECONDS):
        found += [Comparison(file.name, "the file", "not read by Drake")] if isinstance(result, Failure) else result
    counts = Counter((one.subject, one.verdict) for one in found)
    rows = [(*key, count) for key, count in sorted(counts.items())]
    odd = [(one.name, one.subject, one.cause) for one in sorted(found, key=lambda one: one.name) if one.cause]
    tables = (
        table(["given to Drake", "verdict", "files"], rows)
        + "\n"
        + listing(["file", "given to Drake", "why"], odd, empty="")
    )
    return section(title, _DRAKE, tables)


def _shown_to_drake() -> list[CorpusFile]:
    return [file for file in corpus_files() if file.kind is Kind.SDF and is_good(file)][::_EVERY]


REPORT = Report("versions", "Versions of SDF", _ABOUT, measure, known=KNOWN)
