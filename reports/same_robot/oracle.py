"""Is it the same robot to Drake and other engines, libsdformat and urdfdom?"""

import shutil
from collections import Counter
from collections.abc import Iterable, Mapping

from reports.harness.let_go import WANTED, Motion, motion, motions
from reports.harness.needs import corpus, drake
from reports.harness.sample import Sample, in_turn, judged_files
from reports.harness.section import Findings, Section
from reports.same_robot.drake_verdicts import OUT, Direction, Outcome, Verdict, directions, judge, post_mortem
from reports.same_robot.oracle_page import (
    ABOUT,
    KNOWN,
    agreement_part,
    counts,
    explained,
    motion_part,
    parts,
    why_moved,
)
from reports.same_robot.other_engines import Agreement, Answer, agreements
from testbed.corpus.files import CORPUS, CorpusFile
from twinform.compiler.workers import Failure

_LET_GO = (Direction.TO_SDF_11, Direction.TO_URDF)
"""The conversions whose results Drake lets go."""
_JOINTS = 2
"""So many joints make a motion interesting."""
_ALIKE = frozenset({Verdict.FRAMES, Verdict.INERTIAL})
LEAST = {Direction.TO_SDF_9: 150, Direction.TO_URDF: 60}
"""So many corpus files must come out as the same robot."""


def measure(sample: Sample) -> Findings:
    """Convert and judge."""
    shutil.rmtree(OUT, ignore_errors=True)
    outcomes = sorted(_outcomes(sample), key=lambda outcome: (outcome.direction, outcome.name))
    known = _known("different", (one.name for one in outcomes if one.verdict is Verdict.DIFFERENT))
    agreed = agreements(sample, outcomes)
    moved = [each for way in _LET_GO for each in motions(sample, _move, _candidates(outcomes, way))]
    more = agreement_part(agreed), motion_part(moved)
    few = _too_few(outcomes, moved) if sample.every == 1 and not sample.files else []
    broken = [f"{one.done}: {one.name}: {one.cause}" for one in moved if one.is_fault and not why_moved(one)]
    faults = [*few, *_disagreements(agreed), *broken, *_changed(outcomes, known)]
    return Findings(parts(outcomes, known, more), counts(outcomes), faults)


def _outcomes(sample: Sample) -> Iterable[Outcome]:
    died: list[CorpusFile] = []
    for file, result in sample.run(judge, sample.of(judged_files())):
        if isinstance(result, Failure):
            died.append(file)
        else:
            yield from result
    for file, result in sample.run(post_mortem, died):
        if isinstance(result, Failure):
            yield from (
                Outcome(file.name, direction, Verdict.SOURCE, "Drake ends the process")
                for direction in directions(file)
            )
        else:
            yield from result


def _candidates(outcomes: Iterable[Outcome], way: Direction) -> list[Outcome]:
    """One robot of each repository in turn, with joints enough to be interesting."""
    fit = [one for one in outcomes if one.direction is way and one.verdict in _ALIKE and one.joints >= _JOINTS]
    return in_turn(sorted(fit, key=lambda one: one.name))


def _move(one: Outcome) -> Motion:
    assert one.output is not None
    return motion(one.direction, one.name, one.joints, CORPUS / one.name, one.output)


def _known(table: str, names: Iterable[str]) -> dict[str, str]:
    """The reasons, by file, for which a result is knowingly another robot."""
    return {name: why for name in names if (why := KNOWN.why(table, name))}


def _disagreements(agreed: list[Agreement]) -> list[str]:
    """What engines report that nobody has explained."""
    doubted = (one for one in agreed if one.answer in {Answer.DIFFERENT, Answer.RESULT} and not explained(one))
    return [f"{one.question.engine}: {one.question.name}: {one.answer}: {one.cause}" for one in doubted]


def _too_few(outcomes: list[Outcome], moved: list[Motion]) -> list[str]:
    """The ways on which too few are the same, or move alike."""
    same = Counter(one.direction for one in outcomes if one.verdict in _ALIKE)
    alike = Counter(one.done for one in moved if one.verdict)
    few = [f"{way}: only {same[way]} the same, not {least}" for way, least in LEAST.items() if same[way] < least]
    still = (way for way in _LET_GO if alike[way] < WANTED)
    return [*few, *(f"{way}: only {alike[way]} robots move alike, not {WANTED}" for way in still)]


def _changed(outcomes: list[Outcome], known: Mapping[str, str]) -> list[str]:
    """Robots that are others, for no known reason."""
    different = (one for one in outcomes if one.verdict is Verdict.DIFFERENT and one.name not in known)
    return [f"{one.direction}: {one.name}: {one.verdict}: {one.cause}" for one in different]


SECTION = Section("oracle", ABOUT, measure, (corpus, drake), KNOWN)
