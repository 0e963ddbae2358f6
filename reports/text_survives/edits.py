"""Is what stands in a file what counts? Edits and passes on converted files."""

import json
import shutil
from collections.abc import Iterable, Iterator

from hypothesis.strategies import SearchStrategy

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.text_survives.edit_jobs import OUT, Job, Tried, corpus_jobs, work
from reports.text_survives.edits_page import ABOUT, drake_judged, sections, summary
from testbed.corpus.files import ROOT
from testbed.drawn_models import drawn
from testbed.edits.edited_file import Language
from testbed.output_files import kept
from twinform.ir import Document
from twinform.testing import strategies

_SECONDS = 300
_EDITS = {True: 24, False: 9}
"""Edits for a URDF file, and for an SDF file."""
_MODELS, _EDITS_OF_MODELS = 300, 8


def measure(sample: Sample) -> Findings:
    """Edit, convert, and compare."""
    jobs = sample.of([*corpus_jobs(sample.seed, _EDITS), *generated(sample)])
    return measured(sample, jobs)


def measured(sample: Sample, jobs: list[Job]) -> Findings:
    """What became of the edits of these models."""
    for folder in ("faults", "drake"):
        shutil.rmtree(OUT / folder, ignore_errors=True)
    done, failures = sample.lists(work, sorted(jobs, key=lambda job: -job.path.stat().st_size), seconds=_SECONDS)
    done.sort(key=lambda each: each.name)
    drake = drake_judged(done, sample)
    tried = [one for each in done for one in each.tried]
    faults = [one for one in tried if one.verdict.is_fault]
    _list(faults)
    return Findings(
        [part.replace(f"{ROOT}/", "") for part in sections(done, tried, failures, drake, sample.seed)],
        summary(done, failures, drake),
        [*failures, *drake.faults, *(f"{one.kind}: {one.verdict.outcome}: {one.replay}" for one in faults)],
    )


def generated(
    sample: Sample, edited: Language | None = None, models: int = _MODELS, count: int = _EDITS_OF_MODELS
) -> Iterator[Job]:
    """Models that Hypothesis makes up, to be edited in a language, or else in the other of URDF and SDF."""
    robots: dict[Language, SearchStrategy[Document]] = {
        "urdf": strategies.robots(max_links=6),
        "sdf": strategies.sdf_models(max_links=6),
    }
    for suffix, strategy in robots.items():
        for index, text in enumerate(drawn(strategy, models, sample.seed)):
            path = kept(OUT / "generated" / f"{sample.seed}_{index}.{suffix}", text)
            name = path.relative_to(OUT).as_posix()
            yield Job(name, path, (), suffix, edited or ("sdf" if suffix == "urdf" else "urdf"), sample.seed, count)


def _list(faults: Iterable[Tried]) -> None:
    rows = ([one.folder, one.kind, one.verdict.outcome, one.replay, *one.verdict.differences] for one in faults)
    kept(OUT / "faults.jsonl", "".join(f"{json.dumps(row)}\n" for row in rows))


SECTION = Section("edits", ABOUT, measure)
