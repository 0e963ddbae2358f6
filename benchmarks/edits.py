"""Is what stands in a file what counts? Edits and passes on converted files: `make edits`.

Writes docs/reference/edits.md. `python -m benchmarks.edits --replay '...'` tries one line of it again.
"""

import argparse
import json
import shutil
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from benchmarks import edit_models
from benchmarks.edit_jobs import OUT, Done, Job, Tried, again, converted, corpus_jobs, job_named, work
from benchmarks.edit_report import drake_judged, is_fault, page, summary
from tests.corpus.files import CORPUS, MISSING, ROOT
from twinform.testing.workers import Failure, run

PAGE = ROOT / "docs" / "reference" / "edits.md"
_SECONDS = 300
_EDITS = {True: 24, False: 9}
"""Edits for a URDF file, and for an SDF file."""
_MODELS, _EDITS_OF_MODELS = 300, 8


def main(arguments: list[str] | None = None) -> int:
    """Edit, convert, compare, report, and fail where an edit does not win."""
    options = _options(arguments)
    if options.replay:
        return _replay(options.replay)
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 1
    start = time.perf_counter()
    for folder in ("faults", "drake"):
        shutil.rmtree(OUT / folder, ignore_errors=True)
    done, failures = _all_done(_jobs(options), options.processes)
    drake = drake_judged(done, options.processes)
    tried = [one for each in done for one in each.tried]
    print(summary(done, failures, drake), f"{time.perf_counter() - start:.0f} s", sep="\n")
    if not (options.only or options.limit):
        page(PAGE, done, failures, drake, options.seed)
        print(f"written to {PAGE.relative_to(ROOT)}")
    _list(tried)
    return 1 if failures or drake.faults or any(map(is_fault, tried)) else 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.edits", description=__doc__)
    parser.add_argument("--limit", type=int, help="stop after about so many edits, spread over all files")
    parser.add_argument("--seed", type=int, default=1, help="other edits for another number")
    parser.add_argument("--only", action="append", default=[], help="files whose name has this in it")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--replay", help="a line of the page: one edit of one file again")
    return parser.parse_args(arguments)


def _jobs(options: argparse.Namespace) -> list[Job]:
    jobs = [*corpus_jobs(options.seed, _EDITS), *_generated(options)]
    jobs = [job for job in jobs if not options.only or any(part in job.name for part in options.only)]
    total = sum(job.edits for job in jobs)
    if options.limit and total > options.limit:
        jobs = jobs[:: max(1, round(total / options.limit))]
    return sorted(jobs, key=lambda job: -job.path.stat().st_size)


def _generated(options: argparse.Namespace) -> Iterator[Job]:
    count = _MODELS if not options.limit else max(2, options.limit // 100)
    for path in edit_models.written(OUT / "generated", count, options.seed):
        name = path.relative_to(OUT).as_posix()
        yield Job(name, path, (), path.suffix == ".urdf", options.seed, _EDITS_OF_MODELS)


def _all_done(jobs: list[Job], processes: int) -> tuple[list[Done], list[str]]:
    done: list[Done] = []
    failures: list[str] = []
    for job, result in run(work, jobs, seconds=_SECONDS, processes=processes):
        if isinstance(result, Failure):
            failures.append(f"{job.name}: {result.cause}")
        else:
            done += result
    return sorted(done, key=lambda each: each.name), sorted(failures)


def _list(tried: Iterable[Tried]) -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    faults = [one for one in tried if is_fault(one)]
    lines = [
        json.dumps([one.folder, one.kind, one.verdict.outcome, one.replay, *one.verdict.differences]) for one in faults
    ]
    (OUT / "faults.jsonl").write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")


def _replay(text: str) -> int:
    name, robot, version, what = json.loads(text)
    model = converted(job_named(name), robot, version)
    if isinstance(model, str):
        print(model, file=sys.stderr)
        return 1
    edited, tried = again(model, what)
    place = Path(OUT / "replay")
    place.mkdir(parents=True, exist_ok=True)
    here, there = ("sdf", "urdf") if model.job.is_urdf else ("urdf", "sdf")
    (place / f"before.{here}").write_bytes(model.before.text)
    (place / f"edited.{here}").write_bytes(edited)
    (place / f"result.{there}").write_text(tried.verdict.result or "", encoding="utf-8")
    print(tried.verdict.outcome, *tried.verdict.differences, *tried.verdict.rules, place, sep="\n")
    return 1 if is_fault(tried) else 0


if __name__ == "__main__":
    sys.exit(main())
