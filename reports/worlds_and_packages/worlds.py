"""Is a world the same once it was taken apart and put together again?"""

import re
import shutil
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.corpus.files import CORPUS, Kind
from testbed.drawn_models import drawn
from testbed.markdown import listing, subsection, table
from testbed.output_files import OUT, SDF_VERSION, kept
from testbed.worlds import Loaded, Outcome, Together, judge
from twinform.compiler.workers import Failure
from twinform.ir import Box, Cylinder, Sphere
from twinform.testing import strategies

KNOWN = Known.beside(__file__)
GENERATED = 150
_SECONDS = 240
_DENORMAL = re.compile(r"-?[0-9.]+e-3[0-9][0-9]")
"""Numbers that libsdformat 12 refuses as out of range."""
_ABOUT = f"""\
Every SDF file of the corpus that has a model, and {2 * GENERATED} generated worlds with nested, static and displaced
models, loose links and joints of every type, are split with `--split`, and put together again with
`--expand-includes`. *The same* are those of which `twinform diff` finds no difference in any model, and in which
frames, joints, lights and plugins of the world are what and where they were. libsdformat 12, which places, lumps and
leaves out as Gazebo does, then reads the source and the split world: *loads, the same* means that every model has the
same links with mass, in the same places of the world and with the same inertias, joints, limits, sensors and plugins,
and that all shapes are where they were. Names of links that it lumps do not count.

*Not comparable* are files with includes inside their models whose files are not in the corpus."""


class Target(StrEnum):
    """What the models of a world become."""

    URDF = "URDF where Gazebo reads it as the same robot"
    SDF = "SDF (`--to sdf`)"


@dataclass(frozen=True, slots=True)
class Job:
    """One world, taken apart into models of one format."""

    name: str
    path: Path
    folders: tuple[Path, ...]
    target: Target

    @property
    def origin(self) -> str:
        """Where the world is from."""
        return "corpus" if self.path.is_relative_to(CORPUS) else "generated"

    def judged(self) -> Outcome | None:
        """What becomes of it."""
        folder = OUT / "worlds" / self.target.name.lower() / self.name.replace("/", "_")
        found = judge(self.name, self.path, self.folders, folder, "urdf" if self.target is Target.URDF else "sdf")
        shutil.rmtree(folder, ignore_errors=True)
        return found


def measure(sample: Sample) -> Findings:
    """Take apart, put together, and compare."""
    worlds = [*sample.of(_generated(sample.seed))]
    jobs = [
        *(Job(file.name, file.path, file.paths, target) for file in sample.models(Kind.SDF) for target in Target),
        *(Job(path.stem, path, (), target) for path in worlds for target in Target),
    ]
    outcomes = list(_outcomes(sample, jobs))
    reasons = {one.name: KNOWN.why("different", one.name) for _, one in outcomes if one.fault}
    faults = [one for _, one in outcomes if one.fault and not reasons[one.name]]
    return Findings(
        list(_sections(outcomes, reasons)),
        _totals(outcomes),
        [f"{one.name}: {one.together}, {one.loaded}: {one.cause}" for one in faults],
    )


def _generated(seed: int) -> Iterator[Path]:
    """Worlds that Hypothesis makes up, always the same ones: with nested models, and with shapes of URDF alone."""
    for kind, strategy in (
        ("varied", strategies.worlds(version=SDF_VERSION, nested=True, anchored=True)),
        ("plain", strategies.worlds(version=SDF_VERSION, anchored=True, shapes=(Box, Cylinder, Sphere))),
    ):
        for number, text in enumerate(drawn(strategy, GENERATED, seed)):
            yield kept(OUT / "worlds" / f"{kind}_{number}.world", _DENORMAL.sub("0", text))


def _outcomes(sample: Sample, jobs: list[Job]) -> Iterator[tuple[Job, Outcome]]:
    found_by_job = sample.run(Job.judged, jobs, seconds=_SECONDS)
    for job, found in sorted(found_by_job, key=lambda pair: (pair[0].target, pair[0].name)):
        if isinstance(found, Failure):
            yield job, Outcome(job.name, Together.CRASH, cause=found.cause)
        elif found is not None:
            yield job, found


def _sections(outcomes: list[tuple[Job, Outcome]], reasons: dict[str, str]) -> Iterator[str]:
    yield _totals(outcomes)
    urdf = [one for job, one in outcomes if job.target is Target.URDF]
    yield (
        f"Of {sum(one.urdf + one.sdf for one in urdf)} models {sum(one.urdf for one in urdf)} become URDF, and "
        f"{sum(one.sdf for one in urdf)} stay SDF, for these reasons:"
    )
    why = Counter(sorted(reason for one in urdf for reason in one.reasons))
    yield table(["why", "models"], why.most_common())
    rows = [(one.name, one.loaded, one.cause, reasons[one.name] or "**not known**") for _, one in outcomes if one.fault]
    yield subsection("Not the same", table(["world", "libsdformat 12", "first difference", "why"], rows))
    refused = Counter(one.cause for _, one in outcomes if one.together is Together.REFUSED)
    yield subsection("Refused, by rule", listing(["rules", "worlds"], sorted(refused.items())))


def _totals(outcomes: list[tuple[Job, Outcome]]) -> str:
    groups = dict.fromkeys((job.target, job.origin) for job, _ in outcomes)
    rows: list[tuple[object, ...]] = []
    for target, origin in groups:
        found = [one for job, one in outcomes if (job.target, job.origin) == (target, origin)]
        together = Counter(one.together for one in found)
        loaded = Counter(one.loaded for one in found)
        counts = (*(together[each] for each in Together), *(loaded[each] for each in Loaded))
        rows.append((target, origin, len(found), *counts))
    return table(["models become", "worlds from", "worlds", *Together, *Loaded], rows)


SECTION = Section("worlds", _ABOUT, measure, known=KNOWN)
