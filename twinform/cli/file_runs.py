"""Work on the files of a command, in processes where there are many, and with results of earlier runs.

Results come in the order of the files, whoever has made them. What comes from standard input is worked on in this
process, and nothing of it is kept.
"""

import os
from collections.abc import Callable, Generator, Sequence
from contextlib import closing, contextmanager
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self, TypedDict, TypeVar

import click

from twinform.cli.command import Unusable
from twinform.cli.flags import group

if TYPE_CHECKING:
    from twinform.compiler.result_cache import Observed, Observer, ResultCache

VARIABLE = "TWINFORM_CACHE_DIR"
"""The environment variable that names the folder for results of earlier runs, or is `off`."""
_MUCH = 1.5
"""Seconds of work that are worth starting processes: each takes 0.6 until it is as fast as this one."""
_SECONDS = 600.0
"""The longest work on one file, in a process."""


class RunOptions(TypedDict):
    """How the files of a command are worked on."""

    jobs: int | None
    no_cache: bool
    cache_dir: Path | None


run_options = group(
    "run",
    RunOptions,
    click.option(
        "--jobs",
        type=click.IntRange(min=1),
        metavar="N",
        help="How many files at a time; by default one for each processor where there is more than a second of work.",
    ),
    click.option("--no-cache", is_flag=True, help="Use no results of earlier runs, and keep none."),
    click.option(
        "--cache-dir",
        type=click.Path(path_type=Path, file_okay=False),
        metavar="DIR",
        help="Where results of folders are kept; by default in your cache folder.",
    ),
)
"""Gives a command `--jobs`, `--no-cache` and `--cache-dir`, as `run`."""


class FileResult(Protocol):
    """The result of work on a file, which may come from another process or an earlier run."""

    def to_json(self) -> Any:
        """Return the result as JSON."""
        ...

    @classmethod
    def from_json(cls, row: Any, /) -> Self:
        """Make a result of what `to_json` has returned."""
        ...

    @classmethod
    def failed(cls, path: str, why: str, /) -> Self:
        """Make the result for a file whose work has ended its process."""
        ...


Result = TypeVar("Result", bound=FileResult)
Made_co = TypeVar("Made_co", bound=FileResult, covariant=True)


class FileWork(Protocol[Made_co]):
    """Work on one file, wherever it is done: a dataclass, whose fields are the options that the result depends on."""

    @property
    def name(self) -> str:
        """The path of the file."""
        ...

    @property
    def is_kept(self) -> bool:
        """Whether the result depends on nothing but files, options and our code."""
        ...

    @property
    def seconds(self) -> float:
        """How long the work takes, more or less."""
        ...

    def do(self) -> Made_co:
        """Do the work.

        Raises:
            click.ClickException: the command ends.
        """
        ...


class FileRun:
    """A run over files, in so many processes, with results of earlier runs if there are any to be had."""

    def __init__(self, jobs: int | None = None, results: "ResultCache | None" = None) -> None:
        self._jobs, self._results = jobs, results

    def remember(self, key: object, make: Callable[[], list[str]]) -> list[str]:
        """Return what `make` returns, as it is or from an earlier run in which it read the same files."""
        if self._results is None:
            return make()
        name = _digest(key)
        known = self._results.get(name, list[str])
        if known is not None:
            return known
        made, seen = self._results.observer.observe(make)
        if seen is not None:
            self._results.put(name, made, seen)
        return made

    @contextmanager
    def on(self, kind: type[Result], tasks: Sequence[FileWork[Result]]) -> Generator[Generator[Result]]:
        """Return the result of each task, in their order.

        Raises:
            click.ClickException: work ends the command.
        """
        known = [self._known(kind, task) for task in tasks]
        todo = [task for task, result in zip(tasks, known, strict=True) if result is None]
        is_much = sum(task.seconds for task in todo) >= _MUCH
        count = min(len(todo), self._jobs or (_processors() if is_much else 1))
        made = self._in_processes(kind, todo, count) if count > 1 else map(self._do_here, todo)
        with closing(next(made) if each is None else each for each in known) as results:
            yield results

    def end(self) -> None:
        """Keep the results."""
        if self._results is not None:
            self._results.save()

    def _known(self, kind: type[Result], task: FileWork[Result]) -> Result | None:
        if self._results is None or not task.is_kept:
            return None
        return self._results.get(_digest(task), kind.from_json)

    def _keep(self, task: FileWork[Result], row: object, seen: "Observed | None") -> None:
        if self._results is not None and seen is not None and task.is_kept:
            self._results.put(_digest(task), row, seen)

    def _do_here(self, task: FileWork[Result]) -> Result:
        if self._results is None:
            return task.do()
        made, seen = self._results.observer.observe(task.do)
        self._keep(task, made.to_json(), seen)
        return made

    def _in_processes(self, kind: type[Result], tasks: Sequence[FileWork[Result]], count: int) -> Generator[Result]:
        from twinform.compiler.workers import Failure, process_runner, run_on  # noqa: PLC0415 - most runs need no more

        # The tasks are sent once, all together: what they know of folders is in each, and would be most of what is
        # sent (820 kB a task and 317 MB in all, for 386 files, where 0.9 MB do).
        runner = process_runner(count, _SECONDS, common=tasks)
        work = partial(_do_apart, is_observed=self._results is not None)
        done: dict[int, _Done | Failure] = {}
        with closing(run_on(runner, work, range(len(tasks)))) as results:
            for number, task in enumerate(tasks):
                while number not in done:
                    other, found = next(results)
                    done[other] = found
                made = done.pop(number)
                if isinstance(made, click.ClickException):
                    raise made
                if isinstance(made, Failure):
                    yield kind.failed(task.name, made.cause)
                else:
                    self._keep(task, *made)
                    yield kind.from_json(made[0])


_Done = tuple[Any, "Observed | None"] | click.ClickException
"""The JSON of a result and what it depends on, or why the command ends."""


def _do_apart(number: int, *, is_observed: bool) -> "_Done":
    """Do one of the tasks that this process was given."""
    from twinform.compiler.workers import common_of_jobs  # noqa: PLC0415 - most runs need no processes

    task: FileWork[FileResult] = common_of_jobs()[number]
    try:
        if not is_observed:
            return task.do().to_json(), None
        made, seen = _observer().observe(task.do)
        return made.to_json(), seen
    except click.ClickException as error:
        return error


@cache
def _observer() -> "Observer":
    from twinform.compiler.result_cache import Observer  # noqa: PLC0415 - only runs that keep results need it

    return Observer()


def _processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _digest(task: object) -> str:
    import json  # noqa: PLC0415 - only runs with kept results

    from twinform.compiler.dependencies import describe_options  # noqa: PLC0415 - as above
    from twinform.compiler.observing import digest  # noqa: PLC0415 - as above

    return digest(json.dumps([type(task).__name__, describe_options(task)]).encode())


def cache_folder(named: Path | None) -> Path | None:
    """Return the folder for results of earlier runs: the one that is named, that of the variable, or the usual one."""
    from twinform.storage.user_cache import user_cache  # noqa: PLC0415 - as above

    chosen = os.environ.get(VARIABLE, "")
    return named or (None if chosen == "off" else Path(chosen) if chosen else user_cache("results"))


def open_file_run(command: str, words: Sequence[str], options: RunOptions) -> FileRun:
    """Return a run of a command; a file that is named alone is worked on anew each time.

    Raises:
        Unusable: others may write into the folder for results that was named.
    """
    named = options["cache_dir"]
    is_single = len(words) == 1 and not (os.path.isdir(words[0]) or set("*?[") & set(words[0]))  # noqa: PTH112 - any name
    place = None if is_single or "-" in words or options["no_cache"] else cache_folder(named)
    if place is None:
        return FileRun(options["jobs"])
    from twinform.compiler.dependencies import installation  # noqa: PLC0415 - as above
    from twinform.compiler.result_cache import ResultCache  # noqa: PLC0415 - as above
    from twinform.storage.user_cache import open_own_folder  # noqa: PLC0415 - as above

    folder = open_own_folder(place)
    if named and folder is None:
        raise Unusable(f"{named} cannot have results of earlier runs: it is no folder that you alone may write into")
    return FileRun(options["jobs"], ResultCache.of(folder, installation(), os.getcwd(), command))  # noqa: PTH109 - a text
