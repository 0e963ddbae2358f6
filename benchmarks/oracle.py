"""The same robot after every conversion, in the eyes of others: `make oracle`. Writes docs/reference/oracle.md."""

import shutil
import sys
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatchcase
from pathlib import Path

from benchmarks.agreeing import Agreement, Answer, agreements
from benchmarks.agreement_report import KNOWN, agreement_section, explained, motion_section, reasons
from benchmarks.judging import OUT, Direction, Outcome, Verdict, directions, judge, post_mortem, rewrite
from benchmarks.moving import WANTED, WAYS, Motion, motions
from benchmarks.oracle_report import Reader, report
from tests.corpus.files import CORPUS, MISSING, ROOT, CorpusFile, Kind, corpus_files
from tests.oracles import known, urdfdom
from twinform.testing import oracles
from twinform.testing.oracles import libsdformat
from twinform.testing.workers import Failure, run

PAGE = ROOT / "docs" / "reference" / "oracle.md"
LEAST = {Direction.TO_SDF_9: 150, Direction.TO_URDF: 60}
"""So many corpus files must come out as the same robot."""


def main() -> int:
    """Convert, judge, report, and fail where a robot changed."""
    if not CORPUS.is_dir():
        return _fail(MISSING)
    if not oracles.available("drake"):
        return _fail("Drake is not here: pip install '.[oracles]'")
    shutil.rmtree(OUT, ignore_errors=True)
    outcomes = sorted(_outcomes(), key=lambda outcome: (outcome.direction, outcome.name))
    readers = _readers(outcomes)
    known = _known("different", (one.name for one in outcomes if one.verdict is Verdict.DIFFERENT))
    agreed, moved = agreements(outcomes), motions(outcomes)
    known_motions = _known("motion", (one.outcome.name for one in moved if one.verdict is not None and not one.verdict))
    report(PAGE, outcomes, readers, known, (agreement_section(agreed), motion_section(moved, known_motions)))
    failures = [*_disagreements(agreed), *_astray(moved, known_motions)]
    return _conclude(outcomes, readers, known, failures)


def judged_files() -> list[CorpusFile]:
    """Every URDF, and every SDF model that libsdformat 12 takes without an error."""
    urdf = [file for file in corpus_files() if file.kind is Kind.URDF]
    sdf = [file for file in corpus_files() if file.kind is Kind.SDF and _is_good_model(file)]
    return urdf + sdf


def _is_good_model(file: CorpusFile) -> bool:
    return file.row.get("format") == "sdf" and file.row.get("libsdformat12") == "ok"


def _outcomes() -> Iterable[Outcome]:
    died: list[CorpusFile] = []
    for file, result in run(judge, judged_files()):
        if isinstance(result, Failure):
            died.append(file)
        else:
            yield from result
    for file, result in run(post_mortem, died):
        if isinstance(result, Failure):
            yield from (Outcome(file.name, way, Verdict.SOURCE, "Drake ends the process") for way in directions(file))
        else:
            yield from result


def _readers(outcomes: list[Outcome]) -> tuple[Reader, ...]:
    """What the two reference parsers say of the results; nothing of a parser that is not installed."""
    good = {file.name: file for file in corpus_files() if file.row.get("libsdformat12") == "ok"}
    outputs = [(one, one.output.resolve()) for one in outcomes if one.output]
    from_urdf = {path: one.name for one, path in outputs if one.direction is Direction.TO_SDF_9 and one.name in good}
    to_urdf = {path: one.name for one, path in outputs if one.direction is Direction.TO_URDF}
    return (
        Reader(
            "libsdformat 12",
            "SDF 1.9 from URDF files that it takes itself",
            _by_libsdformat(from_urdf),
            known.LIBSDFORMAT,
        ),
        Reader(
            "libsdformat 12", "SDF files that it takes itself, written again", _by_libsdformat(_rewritten(good)), {}
        ),
        Reader("check_urdf", "URDF from SDF", _by_urdfdom(to_urdf), {}),
    )


def _rewritten(good: Mapping[str, CorpusFile]) -> dict[Path, str]:
    # what an include names is found from the place of the file, which is not where the result lies
    files = [file for file in good.values() if file.kind is Kind.SDF and not file.row["uses_include"]]
    return {path.resolve(): file.name for file, path in run(rewrite, files) if isinstance(path, Path)}


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
    reasons: dict[str, str] = tomllib.loads(KNOWN.read_text(encoding="utf-8"))[table]
    return {name: why for name in names for glob, why in reasons.items() if fnmatchcase(name, glob)}


def _disagreements(agreed: list[Agreement]) -> list[str]:
    """What engines say that nobody has explained."""
    known = reasons()
    doubted = (one for one in agreed if one.answer in {Answer.DIFFERENT, Answer.RESULT} and not explained(one, known))
    return [f"{one.question.engine}: {one.question.name}: {one.answer}: {one.cause}" for one in doubted]


def _astray(moved: list[Motion], known: Mapping[str, str]) -> list[str]:
    """Robots that move otherwise, for a reason that nobody knows, and ways on which too few move alike."""
    alike = Counter(one.outcome.direction for one in moved if one.verdict)
    few = [f"{way}: only {alike[way]} robots move alike, not {WANTED}" for way in WAYS if alike[way] < WANTED]
    other = [one for one in moved if one.verdict is not None and not one.verdict and one.outcome.name not in known]
    return few + [f"{one.outcome.direction}: {one.outcome.name}: {one.verdict}" for one in other]


def _conclude(outcomes: list[Outcome], readers: tuple[Reader, ...], known: dict[str, str], failures: list[str]) -> int:
    same = Counter(one.direction for one in outcomes if one.verdict in {Verdict.FRAMES, Verdict.INERTIAL})
    counts = Counter(f"{one.direction}: {one.verdict}" for one in outcomes)
    print(*(f"{count:5} {what}" for what, count in sorted(counts.items())), sep="\n")
    print(f"written to {PAGE.relative_to(ROOT)}; the results are in {OUT.relative_to(ROOT)}")
    failures += [f"{way}: only {same[way]} the same, not {least}" for way, least in LEAST.items() if same[way] < least]
    failures += [
        f"{one.direction}: {one.name}: {one.verdict}: {one.cause}"
        for one in outcomes
        if one.verdict is Verdict.DIFFERENT and one.name not in known
    ]
    failures += [
        f"{reader.name}: {name}: {errors}"
        for reader in readers
        for name, errors in reader.complaints.items()
        if name not in reader.known
    ]
    print(*failures, sep="\n", file=sys.stderr)
    return 1 if failures else 0


def _fail(message: str) -> int:
    print(message, file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
