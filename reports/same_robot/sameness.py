"""Is every conversion the same robot, by `twinform diff`?"""

import re
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

import twinform
from reports.harness.known import Known
from reports.harness.sample import Sample, is_good
from reports.harness.section import Findings, Section
from testbed.corpus.examine import rules_of
from testbed.corpus.files import CorpusFile, Kind
from testbed.corpus.there_and_back import robots
from testbed.markdown import frequent, listing, subsection, table, without_names
from testbed.oracles.sdf_printing import available, printed
from twinform.compiler.audit import audit
from twinform.compiler.compare.comparison import Difference
from twinform.compiler.workers import Failure

KNOWN = Known.beside(__file__)
CUT_OFF = 1e-5
"""The tolerance for what libsdformat prints, which keeps six digits of some numbers."""
MOST_SHOWN = 40
_SECONDS = 600
_NAME = re.compile(r"@name='([^']*)'")
_ABOUT = f"""\
Only the seconds differ from run to run.

Every robot of the corpus that is accepted and converted is compared with what it became, by `twinform diff` with its
tolerance of 1e-9 (of a file with several models the first three, one by one). The last line is about what libsdformat
12 makes of URDF files that it takes itself, compared with a tolerance of {CUT_OFF:g}. It lumps all fixed joints, which
is no difference; what differs is what that conversion changes. *With notes* are those of the same ones that express
something in another way.

Without carriers something may be lost, and then the ledger has to list it. *As in the ledger* are results in which
every single difference lies in a part of the source that the ledger lists as approximated or dropped, or is a part
that was synthesized for one of these; and in all of them the audit counts no element or attribute that is neither in
the result nor in the ledger."""


class Direction(StrEnum):
    """What is compared with its source."""

    TO_SDF = "URDF -> SDF"
    TO_URDF = "SDF -> URDF"
    BARE_TO_SDF = "URDF -> SDF, no carriers"
    BARE_TO_URDF = "SDF -> URDF, no carriers"
    LUMPED = "URDF -> SDF by libsdformat 12"


class Verdict(StrEnum):
    """What became of one conversion."""

    SAME = "same"
    LEDGER = "as in the ledger"
    COLORS = "same but for materials"
    DIFFERENT = "different"
    REFUSED = "not converted"
    CRASH = "crash"


@dataclass(frozen=True, slots=True)
class Outcome:
    """A conversion and its verdict; `kinds` are the aspects that differ, without the names in them."""

    name: str
    direction: Direction
    verdict: Verdict
    cause: str = ""
    kinds: tuple[str, ...] = ()
    notes: int = 0
    seconds: float = 0.0


def measure(sample: Sample) -> Findings:
    """Convert and compare."""
    outcomes = sorted(_outcomes(sample), key=lambda one: (one.direction, one.name))
    known = {one.name: KNOWN.why("different", one.name) for one in outcomes if _is_fault(one)}
    faults = [f"{one.name}: {one.verdict}: {one.cause}" for one in outcomes if _is_fault(one) and not known[one.name]]
    totals = _totals(outcomes)
    rows = [(one.name, one.cause, known[one.name] or "not known") for one in outcomes if _is_fault(one)]
    another = listing(["file", "first difference", "why"], rows)
    sections = [
        totals,
        subsection("Conversions that are another robot", another),
        subsection("What libsdformat 12 changes, by aspect", _by_kind(outcomes)),
    ]
    return Findings(sections, totals, faults)


def judge(file: CorpusFile) -> tuple[Outcome, ...]:
    """Convert every robot of a file and compare each with its source; no exception comes out of it."""
    checked = twinform.check(file.path, paths=file.paths)
    if checked.document is None or not checked.accepted:
        return ()
    is_urdf = file.kind is Kind.URDF
    direction, bare = (
        (Direction.TO_SDF, Direction.BARE_TO_SDF) if is_urdf else (Direction.TO_URDF, Direction.BARE_TO_URDF)
    )
    among = robots(checked.document)
    found = [_judged(file, direction, robot) for robot in among] + [_judged(file, bare, robot) for robot in among]
    if is_urdf and available() and is_good(file):
        found += _lumped(file)
    return tuple(found)


def _judged(file: CorpusFile, direction: Direction, robot: str | None) -> Outcome:
    name = f"{file.name} {robot or ''}".strip()
    bare = direction in {Direction.BARE_TO_SDF, Direction.BARE_TO_URDF}
    target: Literal["sdf", "urdf"] = "sdf" if direction in {Direction.TO_SDF, Direction.BARE_TO_SDF} else "urdf"
    try:
        conversion = twinform.convert(file.path, to=target, model=robot, carriers=not bare, paths=file.paths)
    except twinform.CompileError as error:
        return Outcome(name, direction, Verdict.REFUSED, ", ".join(rules_of(error.diagnostics)))
    try:
        return (
            _accounted(file, name, direction, conversion, robot)
            if bare
            else _compared(file, name, direction, conversion.text, robot)
        )
    except Exception as error:  # noqa: BLE001 - every exception is a fault to report
        return Outcome(name, direction, Verdict.CRASH, f"{type(error).__name__}: {error}")


def _accounted(
    file: CorpusFile, name: str, direction: Direction, conversion: twinform.Conversion, robot: str | None
) -> Outcome:
    """Whether the ledger has every difference, and the audit nothing that is not accounted for."""
    assert conversion.source is not None
    start = time.perf_counter()
    found = twinform.diff(file.path, conversion.text.encode(), model=robot, carriers=True, paths=file.paths)
    seconds = time.perf_counter() - start
    listed = [without_names(entry.location.path) for entry in conversion.ledger.entries]
    names = [name for entry in conversion.ledger.entries for name in _NAME.findall(entry.location.path)]
    names.append(conversion.document.models[0].name)  # of a model without links: URDF has to have one
    unlisted = [each for each in found.differences if not _is_listed(each, listed, names)]
    if any(each.group == "joint" and each not in unlisted for each in found.differences):
        unlisted = [each for each in unlisted if each.group != "kinematics"]  # other joints move links to other places
    silent = [each.message.replace(found.a, "source").replace(found.b, "result") for each in unlisted]
    silent += [
        f"{part.location.path}: {part.text}"
        for part in audit(conversion.source, conversion.text, conversion.ledger).unaccounted
    ]
    verdict = Verdict.DIFFERENT if silent else Verdict.SAME if found.same else Verdict.LEDGER
    return Outcome(name, direction, verdict, next(iter(silent), ""), notes=len(found.notes), seconds=seconds)


def _is_listed(found: Difference, listed: list[str], names: list[str]) -> bool:
    """Whether a difference is at a path of the ledger, or in a part that was synthesized for one of its names."""
    if not found.a.location.line:
        called = (found.name, found.name.rpartition("::")[2])
        return any(one.startswith(name) for one in called for name in names)
    here = without_names(found.a.location.path)
    return any(one.startswith(here) or here.startswith(one) for one in listed)


def _lumped(file: CorpusFile) -> Iterator[Outcome]:
    text = printed(file.path)
    if text is None:
        return
    try:
        yield _compared(file, file.name, Direction.LUMPED, text, None, CUT_OFF)
    except twinform.CompileError as error:  # it prints prefixes that it does not declare
        yield Outcome(file.name, Direction.LUMPED, Verdict.REFUSED, ", ".join(rules_of(error.diagnostics)))


def _compared(
    file: CorpusFile, name: str, direction: Direction, text: str, robot: str | None, tolerance: float = 1e-9
) -> Outcome:
    start = time.perf_counter()
    found = twinform.diff(file.path, text.encode(), model=robot, tolerance=tolerance, carriers=True, paths=file.paths)
    seconds = time.perf_counter() - start
    kinds = tuple(dict.fromkeys(f"{each.group}: {_aspect(each.aspect)}" for each in found.differences))
    if found.same:
        return Outcome(name, direction, Verdict.SAME, notes=len(found.notes), seconds=seconds)
    verdict = Verdict.COLORS if all("/material" in kind for kind in kinds) else Verdict.DIFFERENT
    cause = found.differences[0].message.replace(found.a, "source").replace(found.b, "result")
    return Outcome(name, direction, verdict, cause, kinds, len(found.notes), seconds)


def _aspect(path: str) -> str:
    """A path without the names in it, so that equal causes read the same."""
    if not path:
        return "there or not"
    kind, quote, rest = path.partition(" '")
    end = rest.rpartition("'")[2]
    return f"{kind}{end or ' there or not'}" if quote else path


def _outcomes(sample: Sample) -> Iterable[Outcome]:
    for file, found in sample.run(judge, sample.models(), seconds=_SECONDS):
        if isinstance(found, Failure):
            direction = Direction.TO_SDF if file.kind is Kind.URDF else Direction.TO_URDF
            yield Outcome(file.name, direction, Verdict.CRASH, found.cause)
        else:
            yield from found


def _is_fault(outcome: Outcome) -> bool:
    ours = outcome.direction is not Direction.LUMPED
    return ours and outcome.verdict in {Verdict.DIFFERENT, Verdict.COLORS, Verdict.CRASH}


def _totals(outcomes: list[Outcome]) -> str:
    rows = [_row(direction, [one for one in outcomes if one.direction is direction]) for direction in Direction]
    return table(["conversion", "robots", *Verdict, "same, with notes", "seconds to compare"], rows)


def _row(direction: Direction, found: list[Outcome]) -> tuple[object, ...]:
    counts = Counter(one.verdict for one in found)
    noted = sum(1 for one in found if one.verdict is Verdict.SAME and one.notes)
    seconds = f"{sum(one.seconds for one in found):.1f}"
    return (direction, len(found), *(counts[verdict] for verdict in Verdict), noted, seconds)


def _by_kind(outcomes: list[Outcome]) -> str:
    found = frequent((kind, one.name) for one in outcomes if one.direction is Direction.LUMPED for kind in one.kinds)
    return listing(["what", "files", "for example"], found, empty="libsdformat 12 is not here.", most=MOST_SHOWN)


SECTION = Section("sameness", _ABOUT, measure, known=KNOWN)
