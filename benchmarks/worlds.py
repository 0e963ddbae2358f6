"""Worlds taken apart and put together again: `make worlds` writes docs/reference/worlds.md."""

import argparse
import re
import shutil
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from benchmarks.markdown import table, write
from benchmarks.world_judging import Loaded, Outcome, Together, judge
from tests.corpus.files import CORPUS, MISSING, ROOT, Kind, models
from twinform.compiler.emitting import emit
from twinform.diagnostics import Notes
from twinform.ir import Box, Cylinder, Document, Sphere
from twinform.testing import strategies
from twinform.testing.workers import Failure, run

PAGE = ROOT / "docs" / "reference" / "worlds.md"
KNOWN = Path(__file__).with_name("worlds_known.toml")
OUT = ROOT / "out" / "worlds"
GENERATED = 150
SEED = 1
VERSION = "1.9"
"""The newest version of SDF that libsdformat 12 reads."""
_SECONDS = 240
_DENORMAL = re.compile(r"-?[0-9.]+e-3[0-9][0-9]")
"""Numbers that libsdformat 12 refuses as out of range."""
INTRODUCTION = f"""# Worlds taken apart

Made by `make worlds`.

Every SDF file of the corpus that has a model, and {2 * GENERATED} generated worlds with nested, static and displaced
models, loose links and joints of every type, are split with `--split`, and put together again with
`--expand-includes`. *The same* are those of which `twinform diff` finds no difference in any model, and in which
frames, joints, lights and plugins of the world are what and where they were. libsdformat 12, which places, lumps and
leaves out as Gazebo does, then reads the source and the split world: *loads, the same* means that every model has the
same links with mass, in the same places of the world and with the same inertias, joints, limits, sensors and plugins,
and that all shapes are where they were. Names of links that it lumps do not count.

*Not comparable* are files with includes inside their models whose files are not in the corpus."""


class Way(StrEnum):
    """What the models of a world become."""

    URDF = "URDF where Gazebo reads it as the same robot"
    SDF = "SDF (`--to sdf`)"


@dataclass(frozen=True, slots=True)
class Job:
    """One world, taken apart in one way."""

    name: str
    path: Path
    folders: tuple[Path, ...]
    way: Way

    @property
    def origin(self) -> str:
        """Where the world is from."""
        return "corpus" if self.path.is_relative_to(CORPUS) else "generated"

    def judged(self) -> Outcome | None:
        """What becomes of it."""
        folder = OUT / self.way.name.lower() / self.name.replace("/", "_")
        found = judge(self.name, self.path, self.folders, folder, "urdf" if self.way is Way.URDF else "sdf")
        shutil.rmtree(folder, ignore_errors=True)
        return found


def main(arguments: list[str] | None = None) -> int:
    """Take apart, put together, report, and fail where a world is not the same."""
    parser = argparse.ArgumentParser(prog="benchmarks.worlds", description=__doc__)
    parser.add_argument("--every", type=int, default=1, help="one of so many worlds; the page is for all of them")
    every = parser.parse_args(arguments).every
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 1
    worlds = [*_corpus(), *_generated()][::every]
    outcomes = list(_outcomes([Job(*world, way) for world in worlds for way in Way]))
    known: dict[str, str] = tomllib.loads(KNOWN.read_text(encoding="utf-8"))["different"]
    print(_totals(outcomes))
    if every == 1:
        write(PAGE, INTRODUCTION, *_sections(outcomes, known))
        print(f"written to {PAGE.relative_to(ROOT)}")
    faults = [one for _, one in outcomes if one.fault and one.name not in known]
    print(*(f"{one.name}: {one.together}, {one.loaded}: {one.cause}" for one in faults), sep="\n", file=sys.stderr)
    return 1 if faults else 0


def _corpus() -> Iterator[tuple[str, Path, tuple[Path, ...]]]:
    for file in models():
        if file.kind is Kind.SDF:
            yield file.name, file.path, file.paths


def _generated() -> Iterator[tuple[str, Path, tuple[Path, ...]]]:
    """Worlds that Hypothesis makes up, always the same ones: with nested models, and with shapes of URDF alone."""
    OUT.mkdir(parents=True, exist_ok=True)
    for kind, strategy in (
        ("varied", strategies.worlds(version=VERSION, nested=True, anchored=True)),
        ("plain", strategies.worlds(version=VERSION, anchored=True, shapes=(Box, Cylinder, Sphere))),
    ):
        texts: list[str] = []
        _drawn(strategy, texts)
        for number, text in enumerate(texts):
            path = OUT / f"{kind}_{number}.world"
            path.write_text(text, encoding="utf-8")
            yield path.stem, path, ()


def _drawn(strategy: st.SearchStrategy[Document], texts: list[str]) -> None:
    @seed(SEED)
    @settings(
        max_examples=GENERATED,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=(HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much),
        deadline=None,
    )
    @given(strategy)
    def collect(world: Document) -> None:
        texts.append(_DENORMAL.sub("0", emit(world, Notes())))

    collect()


def _outcomes(jobs: list[Job]) -> Iterator[tuple[Job, Outcome]]:
    for job, found in sorted(run(Job.judged, jobs, seconds=_SECONDS), key=lambda pair: (pair[0].way, pair[0].name)):
        if isinstance(found, Failure):
            yield job, Outcome(job.name, Together.CRASH, cause=found.cause)
        elif found is not None:
            yield job, found


def _sections(outcomes: list[tuple[Job, Outcome]], known: dict[str, str]) -> Iterator[str]:
    yield _totals(outcomes)
    urdf = [one for job, one in outcomes if job.way is Way.URDF]
    yield (
        f"Of {sum(one.urdf + one.sdf for one in urdf)} models {sum(one.urdf for one in urdf)} become URDF, and "
        f"{sum(one.sdf for one in urdf)} stay SDF, for these reasons:"
    )
    reasons = Counter(sorted(reason for one in urdf for reason in one.reasons))
    yield table(["why", "models"], reasons.most_common())
    rows = [(one.name, one.loaded, one.cause, known.get(one.name, "**not known**")) for _, one in outcomes if one.fault]
    yield "## Not the same\n\n" + (table(["world", "libsdformat 12", "first difference", "why"], rows) or "None.")
    refused = Counter(one.cause for _, one in outcomes if one.together is Together.REFUSED)
    yield "## Refused, by rule\n\n" + (table(["rules", "worlds"], sorted(refused.items())) if refused else "None.")


def _totals(outcomes: list[tuple[Job, Outcome]]) -> str:
    groups = dict.fromkeys((job.way, job.origin) for job, _ in outcomes)
    rows: list[tuple[object, ...]] = []
    for way, origin in groups:
        found = [one for job, one in outcomes if (job.way, job.origin) == (way, origin)]
        together = Counter(one.together for one in found)
        loaded = Counter(one.loaded for one in found)
        counts = (*(together[each] for each in Together), *(loaded[each] for each in Loaded))
        rows.append((way, origin, len(found), *counts))
    return table(["models become", "worlds from", "worlds", *Together, *Loaded], rows)


if __name__ == "__main__":
    sys.exit(main())
