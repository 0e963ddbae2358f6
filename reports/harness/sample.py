"""What the command line chooses: which models, how they are drawn, and in how many processes they are judged."""

import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby, zip_longest
from pathlib import Path
from typing import Protocol, TypeVar

from testbed.corpus.files import CorpusFile, Kind, corpus_files, models
from twinform.compiler.workers import Failure
from twinform.compiler.workers import run as run_in_processes


class Named(Protocol):
    """A thing with a name."""

    @property
    def name(self) -> str:
        """The name."""
        ...


Item = TypeVar("Item", bound=Named)
Outcome = TypeVar("Outcome", bound=Named)
Job = TypeVar("Job")
Result = TypeVar("Result")


@dataclass(frozen=True, slots=True)
class Sample:
    """All that there is, or a part of it: one of `every`, names that contain one of `files`, another `seed`."""

    every: int = 1
    files: tuple[str, ...] = ()
    seed: int = 1
    jobs: int | None = None
    inputs: tuple[str, ...] = ()

    def of(self, items: Iterable[Item]) -> list[Item]:
        """The chosen ones."""
        named = [each for each in items if not self.files or any(part in each.name for part in self.files)]
        return named[:: self.every]

    def models(self, *kinds: Kind) -> list[CorpusFile]:
        """The chosen URDF and SDF files of the corpus, and files that lie elsewhere where their paths are given."""
        found = [*self._elsewhere(), *self.of(models())]
        return [file for file in found if not kinds or file.kind in kinds]

    def run(
        self, task: Callable[[Job], Result], jobs: Iterable[Job], *, seconds: float = 60
    ) -> Iterator[tuple[Job, Result | Failure]]:
        """Do the jobs in processes, in any order; on a terminal, print how many are done."""
        every = list(jobs)
        for number, pair in enumerate(run_in_processes(task, every, seconds=seconds, processes=self.jobs), start=1):
            if sys.stderr.isatty():
                print(f"\r{number} of {len(every)}", end="\n" if number == len(every) else "", file=sys.stderr)
            yield pair

    def outcomes(
        self,
        task: Callable[[Job], Outcome | None],
        jobs: Iterable[Job],
        failed: Callable[[Job, str], Outcome],
        *,
        seconds: float = 60,
    ) -> list[Outcome]:
        """What came of the jobs, by name; `failed` gives it for those that never came back, None is left out."""
        answers = self.run(task, jobs, seconds=seconds)
        found = (failed(job, each.cause) if isinstance(each, Failure) else each for job, each in answers)
        return sorted((each for each in found if each is not None), key=lambda each: each.name)

    def lists(
        self, task: Callable[[Item], list[Result]], jobs: Iterable[Item], *, seconds: float = 60
    ) -> tuple[list[Result], list[str]]:
        """All that came of the jobs, and those that never came back, with their causes."""
        found, failures = list[Result](), list[str]()
        for job, answer in self.run(task, jobs, seconds=seconds):
            if isinstance(answer, Failure):
                failures.append(f"{job.name}: {answer.cause}")
            else:
                found += answer
        return found, sorted(failures)

    def _elsewhere(self) -> Iterator[CorpusFile]:
        for path in (Path(part).resolve() for part in self.files if Path(part).is_file()):
            yield CorpusFile(str(path), Kind.URDF if path.suffix == ".urdf" else Kind.SDF, {})


def is_good(file: CorpusFile) -> bool:
    """Whether libsdformat 12 takes a file without an error."""
    return file.row.get("libsdformat12") == "ok"


def judged_files() -> list[CorpusFile]:
    """Every URDF, and every SDF model that libsdformat 12 takes without an error."""
    urdf = [file for file in corpus_files() if file.kind is Kind.URDF]
    sdf = [file for file in corpus_files() if file.kind is Kind.SDF and file.row.get("format") == "sdf"]
    return urdf + [file for file in sdf if is_good(file)]


def in_turn(items: Iterable[Item]) -> list[Item]:
    """One item of each repository in turn, for items that are sorted by name."""
    repositories = [list(group) for _, group in groupby(items, key=lambda each: each.name.partition("/")[0])]
    return [one for turn in zip_longest(*repositories) for one in turn if one is not None]
