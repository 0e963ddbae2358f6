"""The page about the judgments."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.harness.pages import first, grouped, listing, section, table
from reports.oracle.judging import Direction, Outcome, Verdict
from twinform.testing.oracles.comparison import TOLERANCE

ABOUT = f"""\
Every URDF file of the corpus is converted to SDF, and every SDF model that libsdformat 12 takes without an error to
URDF. Drake reads source and result, and at five joint positions the poses of links, centers of mass, inertias, the mass
matrix and gravity torques are compared, with a tolerance of {TOLERANCE:g} (of the largest number of the kind, where
that is more than one). Joint limits and damping must be equal, and only massless links may come and go.

* *same (frames)*: all of that is equal.
* *same (inertial)*: all but the poses of link frames, which a conversion to URDF moves onto the joints, or a massless
  link became a frame, which Drake does not list among the links.
* *source not readable*: Drake refuses the source, so there is nothing to compare with."""

_GROUPS = (
    (Verdict.DIFFERENT, "Different"),
    (Verdict.RESULT, "Results that Drake cannot read"),
    (Verdict.CRASH, "Crashes"),
    (Verdict.REFUSED, "Not converted"),
    (Verdict.SOURCE, "Sources that Drake cannot read"),
)
_IN_FULL = frozenset({Verdict.DIFFERENT, Verdict.RESULT, Verdict.CRASH})


@dataclass(frozen=True, slots=True)
class Reader:
    """What a reference parser reports about results: errors by file, empty where it has none; None without it."""

    name: str
    reads: str
    verdicts: Mapping[str, str] | None

    @property
    def complaints(self) -> dict[str, str]:
        """The files that it has errors for."""
        return {file: errors for file, errors in (self.verdicts or {}).items() if errors}


def sections(
    outcomes: list[Outcome], readers: Sequence[Reader], known: Mapping[str, str], more: Sequence[str]
) -> list[str]:
    """The page, with the sections `more` before the lists of exceptions."""
    groups = (section(title, _group(outcomes, verdict, known)) for verdict, title in _GROUPS)
    return [section("Counts", counts(outcomes)), _readers(readers), *more, *groups]


def counts(outcomes: list[Outcome]) -> str:
    """How many conversions met each verdict."""
    found = Counter((one.direction, one.verdict) for one in outcomes)
    rows = [
        (
            direction,
            sum(found[direction, verdict] for verdict in Verdict),
            *(found[direction, verdict] for verdict in Verdict),
        )
        for direction in Direction
    ]
    return table(["conversion", "files", *Verdict], rows)


def _readers(readers: Sequence[Reader]) -> str:
    counted = [(reader.name, reader.reads, *_tally(reader)) for reader in readers]
    bad = [(reader.name, file, text[:160]) for reader in readers for file, text in reader.complaints.items()]
    parts = [table(["parser", "reads", "results", "without an error"], counted)]
    parts += [table(["parser", "file", "errors"], bad)] if bad else []
    return section("The reference parsers", "\n".join(parts))


def _tally(reader: Reader) -> tuple[object, object]:
    if reader.verdicts is None:
        return ("not installed", "")
    return (len(reader.verdicts), len(reader.verdicts) - len(reader.complaints))


def _group(outcomes: list[Outcome], verdict: Verdict, known: Mapping[str, str]) -> str:
    met = ((one.name, _cause(one), one.direction) for one in outcomes if one.verdict is verdict)
    conversions = grouped(((name, cause), direction) for name, cause, direction in met)
    reasons = {name: f" ({known[name]})" if name in known else "" for name, _ in conversions}
    groups = grouped(((", ".join(those), cause + reasons[name]), name) for (name, cause), those in conversions.items())
    ordered = sorted(groups.items(), key=lambda item: (item[0][0], -len(item[1]), item[0][1]))
    rows = ((*key, len(names), first(names, None if verdict in _IN_FULL else 3)) for key, names in ordered)
    return listing(["conversion", "cause", "files", "which"], rows)


def _cause(one: Outcome) -> str:
    return one.cause.partition(":")[0] if one.verdict is Verdict.REFUSED else one.cause
