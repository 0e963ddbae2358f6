"""Real models in other versions of SDF: `make versions`. Writes docs/reference/versions.md."""

import csv
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from pathlib import Path

import twinform
from benchmarks.markdown import table, write
from benchmarks.version_judging import Comparison, judge, sample
from tests.corpus.examine import rules_of
from tests.corpus.files import CORPUS, MISSING, ROOT, SHARED, CorpusFile, Kind, models
from tests.corpus.versions import NEWEST, Trip, there_and_back, upgraded_difference
from twinform.testing import oracles
from twinform.testing.workers import Failure, run

PAGE = ROOT / "docs" / "reference" / "versions.md"
PAIRS = SHARED / "reference" / "pairs.csv"
KNOWN = Path(__file__).with_name("versions_known.toml")
VERSIONS = ("1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11")
SHOWN = "1.6"
_SECONDS = 120
_UNEXPLAINED = "**unexplained**"
INTRODUCTION = f"""# Versions of SDF

Made by `make versions`.

Every SDF file of the corpus that is accepted goes to {NEWEST}, from there down to an older version, and up again; each
step is written and read again, and the two documents of {NEWEST} have to be equal in the IR. What the older version
cannot say travels in carriers, so nothing should be missing; a difference without an entry in a ledger is *lost*.
*Stale* are files whose carriers were not trusted although nobody edited them, *unclean* those with parts in the older
version that it does not have."""
_DRAKE = """One in three of the models that libsdformat takes: the file as it is, and what it becomes on the way over
the newest version. A part of another tool, such as `<drake:joint>`, may name a frame that an older version does not
have.

"""


@dataclass(frozen=True, slots=True)
class Pair:
    """One model at two versions of SDF, and the first difference when the older one is said in the newer's."""

    older: str
    newer: str
    refused_by: tuple[str, ...] = ()
    difference: str = ""


def main() -> int:
    """Travel, compare, report, and fail where something is lost without a word."""
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 1
    start = time.perf_counter()
    trips, failures = _trips()
    pairs = list(_pairs())
    write(PAGE, INTRODUCTION, *_trip_sections(trips, failures), _pair_section(pairs), _drake_section())
    print(_by_version(trips), _pair_totals(pairs), f"{time.perf_counter() - start:.0f} s", sep="\n")
    lost = [
        f"{trip.name} {trip.version}: {trip.difference}" for trip in trips if trip.difference and not trip.accounted
    ]
    unexplained = [f"{name}: not explained" for name in _unexplained(trips, pairs)]
    print(*lost, *failures, *unexplained, sep="\n", file=sys.stderr)
    return 1 if lost or failures or unexplained else 0


@cache
def _known() -> dict[str, dict[str, str]]:
    """The causes of differences and refusals, by file."""
    return tomllib.loads(KNOWN.read_text(encoding="utf-8"))


def _unexplained(trips: list[Trip], pairs: list[Pair]) -> Iterable[str]:
    differing = [pair.newer for pair in pairs if pair.difference or pair.refused_by]
    yield from (name for name in differing if name not in _known()["pairs"])
    refused = [trip.name for trip in trips if not trip.arrived and trip.version == SHOWN]
    yield from (name for name in refused if name not in _known()["refused"])


def _trips() -> tuple[list[Trip], list[str]]:
    files = [file for file in models() if file.kind is Kind.SDF]
    trips: list[Trip] = []
    failures: list[str] = []
    for file, result in run(_travel, files, seconds=_SECONDS):
        if isinstance(result, Failure):
            failures.append(f"{file.name}: {result.cause}")
        else:
            trips += result
    return sorted(trips, key=lambda trip: (VERSIONS.index(trip.version), trip.name)), failures


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


def _trip_sections(trips: list[Trip], failures: list[str]) -> Iterable[str]:
    yield f"## {NEWEST}, an older version, and {NEWEST} again\n\n" + _by_version(trips)
    refused = [trip for trip in trips if not trip.arrived]
    yield "## Refused on the way, by rule\n\n" + _refusals(refused)
    why = _known()["refused"]
    shown = [
        (trip.name, ", ".join(trip.refused_by), why.get(trip.name, _UNEXPLAINED))
        for trip in refused
        if trip.version == SHOWN
    ]
    yield f"The files that do not go to {SHOWN}:\n\n" + table(["file", "rules", "why"], shown) if shown else ""
    different = [(trip.name, trip.version, trip.difference) for trip in trips if trip.difference]
    yield "## Not equal\n\n" + (table(["file", "version", "first difference"], different) if different else "None.")
    yield "## Broken promises\n\n" + ("\n".join(failures) or "None.")


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
    return table(["version", "rule", "files"], [(*key, count) for key, count in ordered]) if counts else "None."


def _pair_section(pairs: list[Pair]) -> str:
    """The differences are those of the files: two versions of a model are seldom the same model."""
    head = "## One model at two versions\n\nThe older file said in the version of the newer one, and the newer one."
    why = _known()["pairs"]
    different = [(pair.newer, ", ".join(pair.refused_by) or pair.difference) for pair in pairs]
    rows = [(newer, first, why.get(newer, _UNEXPLAINED)) for newer, first in different if first]
    columns = ["newer file", "first difference (the older, the newer)", "cause"]
    return f"{head} {_pair_totals(pairs)}\n\n" + table(columns, rows)


def _pair_totals(pairs: list[Pair]) -> str:
    refused = sum(bool(pair.refused_by) for pair in pairs)
    different = sum(bool(pair.difference) for pair in pairs)
    return f"{len(pairs)} pairs: {len(pairs) - refused - different} equal, {different} different, {refused} refused."


def _drake_section() -> str:
    head = "## In the eyes of Drake\n\n"
    if not oracles.available("drake"):
        return head + "Drake was not there."
    found: list[Comparison] = []
    for file, result in run(judge, sample(), seconds=_SECONDS):
        found += [Comparison(file.name, "the file", "not read by Drake")] if isinstance(result, Failure) else result
    counts = Counter((one.way, one.verdict) for one in found)
    rows = [(*key, count) for key, count in sorted(counts.items())]
    odd = [(one.name, one.way, one.cause) for one in sorted(found, key=lambda one: one.name) if one.cause]
    return head + _DRAKE + table(["way", "verdict", "files"], rows) + "\n" + _listed(odd)


def _listed(odd: list[tuple[str, str, str]]) -> str:
    return table(["file", "way", "why"], odd) if odd else ""


if __name__ == "__main__":
    sys.exit(main())
