"""The same robot after every conversion, in the eyes of others."""

import shutil
from collections import Counter
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from reports.harness.needs import corpus, drake
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample, is_good, judged_files
from reports.oracle.agreeing import Agreement, Answer, agreements
from reports.oracle.judging import OUT, Direction, Outcome, Verdict, directions, judge, post_mortem, rewrite
from reports.oracle.moving import DIRECTIONS, WANTED, Motion, motions
from reports.oracle.others import KNOWN, agreement_section, explained, motion_section
from reports.oracle.page import ABOUT, Reader, counts, sections
from tests.corpus.files import CorpusFile, Kind, corpus_files
from tests.oracles import urdfdom
from twinform.compiler.workers import Failure
from twinform.testing.oracles import libsdformat

LEAST = {Direction.TO_SDF_9: 150, Direction.TO_URDF: 60}
"""So many corpus files must come out as the same robot."""


def measure(sample: Sample) -> Findings:
    """Convert and judge."""
    shutil.rmtree(OUT, ignore_errors=True)
    outcomes = sorted(_outcomes(sample), key=lambda outcome: (outcome.direction, outcome.name))
    readers = _readers(sample, outcomes)
    known = _known("different", (one.name for one in outcomes if one.verdict is Verdict.DIFFERENT))
    agreed, moved = agreements(sample, outcomes), motions(sample, outcomes)
    known_motions = _known("motion", (one.outcome.name for one in moved if one.verdict is not None and not one.verdict))
    more = agreement_section(agreed), motion_section(moved, known_motions)
    few = _too_few(outcomes, moved) if sample.every == 1 and not sample.files else []
    faults = [*few, *_disagreements(agreed), *_broken(moved, known_motions), *_changed(outcomes, readers, known)]
    return Findings(sections(outcomes, readers, known, more), counts(outcomes), faults)


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


def _readers(sample: Sample, outcomes: list[Outcome]) -> tuple[Reader, ...]:
    """What the two reference parsers report about the results; nothing of a parser that is not installed."""
    good = {file.name: file for file in sample.of(corpus_files()) if is_good(file)}
    rewritten = _rewritten(sample, good)
    outputs = [(one, one.output.resolve()) for one in outcomes if one.output]
    from_urdf = {path: one.name for one, path in outputs if one.direction is Direction.TO_SDF_9 and one.name in good}
    to_urdf = {path: one.name for one, path in outputs if one.direction is Direction.TO_URDF}
    return (
        Reader("libsdformat 12", "SDF 1.9 from URDF files that it takes itself", _by_libsdformat(from_urdf)),
        Reader("libsdformat 12", "SDF files that it takes itself, written again", _by_libsdformat(rewritten)),
        Reader("check_urdf", "URDF from SDF", _by_urdfdom(to_urdf)),
    )


def _rewritten(sample: Sample, good: Mapping[str, CorpusFile]) -> dict[Path, str]:
    # what an include names is found from the place of the file, which is not where the result lies
    files = [file for file in good.values() if file.kind is Kind.SDF and not file.row["uses_include"]]
    return {path.resolve(): file.name for file, path in sample.run(rewrite, files) if isinstance(path, Path)}


def _by_libsdformat(outputs: Mapping[Path, str]) -> dict[str, str] | None:
    if not libsdformat.available():
        return None
    halves = [list(outputs)[start::2] for start in (0, 1)]
    with ThreadPoolExecutor(2) as pool:  # it is another process that works
        verdicts = {path: verdict for half in pool.map(libsdformat.judge, halves) for path, verdict in half.items()}
    return {name: "; ".join(verdicts[path].errors) for path, name in outputs.items()}


def _by_urdfdom(outputs: Mapping[Path, str]) -> dict[str, str] | None:
    if not urdfdom.available():
        return None
    return {name: "; ".join(urdfdom.complaints(path)) for path, name in outputs.items()}


def _known(table: str, names: Iterable[str]) -> dict[str, str]:
    """The reasons, by file, for which a result is knowingly another robot."""
    return {name: why for name in names if (why := KNOWN.why(table, name))}


def _disagreements(agreed: list[Agreement]) -> list[str]:
    """What engines report that nobody has explained."""
    doubted = (one for one in agreed if one.answer in {Answer.DIFFERENT, Answer.RESULT} and not explained(one))
    return [f"{one.question.engine}: {one.question.name}: {one.answer}: {one.cause}" for one in doubted]


def _broken(moved: list[Motion], known: Mapping[str, str]) -> list[str]:
    """Robots that move otherwise, for a reason that nobody knows."""
    other = [one for one in moved if one.verdict is not None and not one.verdict and one.outcome.name not in known]
    return [f"{one.outcome.direction}: {one.outcome.name}: {one.verdict}" for one in other]


def _too_few(outcomes: list[Outcome], moved: list[Motion]) -> list[str]:
    """The ways on which too few are the same, or move alike."""
    same = Counter(one.direction for one in outcomes if one.verdict in {Verdict.FRAMES, Verdict.INERTIAL})
    alike = Counter(one.outcome.direction for one in moved if one.verdict)
    return [
        *(
            f"{direction}: only {same[direction]} the same, not {least}"
            for direction, least in LEAST.items()
            if same[direction] < least
        ),
        *(
            f"{direction}: only {alike[direction]} robots move alike, not {WANTED}"
            for direction in DIRECTIONS
            if alike[direction] < WANTED
        ),
    ]


def _changed(outcomes: list[Outcome], readers: tuple[Reader, ...], known: Mapping[str, str]) -> list[str]:
    """Robots that are others, and results that a reference parser has errors for, for no known reason."""
    different = [one for one in outcomes if one.verdict is Verdict.DIFFERENT and one.name not in known]
    return [
        *(f"{one.direction}: {one.name}: {one.verdict}: {one.cause}" for one in different),
        *(f"{reader.name}: {name}: {errors}" for reader in readers for name, errors in reader.complaints.items()),
    ]


REPORT = Report("oracle", "The same robot, in the eyes of others", ABOUT, measure, (corpus, drake), KNOWN)
