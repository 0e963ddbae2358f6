"""Runs a batch from the command line: where it runs, the progress and findings that are printed, and how it ends."""

import sys
import time
from collections.abc import Callable, Generator
from concurrent.futures import BrokenExecutor
from contextlib import ExitStack, contextmanager
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import NoReturn, TypedDict

import click

from twinform.cli.command import INTERRUPTED, UNUSABLE
from twinform.cli.flags import group
from twinform.cli.printing import print_document, print_line
from twinform.compiler.batch import (
    Batch,
    BusyError,
    FolderError,
    ModelRecord,
    Summary,
    UnfitWorkerError,
    batch,
)
from twinform.compiler.workers import Runner, process_runner
from twinform.signals import raised_signals
from twinform.storage.writing import refuse_way_out

_EVERY = 30.0
"""Seconds between lines of progress where there is no terminal: a short run prints none."""


class RunOptions(TypedDict):
    """Options of how a batch is run."""

    jobs: int | None
    timeout: float
    scheduler: str | None
    report: Path | None
    quiet: bool


_OPTIONS = (
    click.option(
        "--jobs", type=click.IntRange(min=1), metavar="N", help="How many at a time; else one for each processor."
    ),
    click.option(
        "--timeout",
        type=click.FloatRange(min=0, min_open=True),
        metavar="SECONDS",
        default=60.0,
        show_default=True,
        help="The time limit for one model.",
    ),
    click.option(
        "--scheduler", metavar="ADDRESS", help="Run on the workers of this scheduler of Dask, such as tcp://host:8786."
    ),
    click.option(
        "--report",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="A line of JSON for each model, written as it goes; - is standard output.",
    ),
    click.option("-q", "--quiet", is_flag=True, help="Print no progress."),
)


run_options = group("run", RunOptions, *_OPTIONS)
"""Adds the options of how a batch is run to a command."""


def run_and_end(ctx: click.Context, asked: Batch, options: RunOptions) -> NoReturn:
    """Run a batch to its end, or to the first Ctrl-C; the summary is printed, and the report complete, either way."""
    summary, problem = Summary(), ""
    try:
        with raised_signals():
            _run(asked, options, summary)
        code = summary.exit_code
    except KeyboardInterrupt:
        problem, code = "interrupted; run it again, and it goes on from here", INTERRUPTED
    except (FolderError, BusyError) as error:
        raise click.UsageError(str(error)) from error
    except BrokenPipeError:
        raise  # who reads the report has read enough
    except OSError as error:
        problem, code = f"cannot write {error.filename or asked.dest}: {error.strerror or error}", UNUSABLE
    except UnfitWorkerError as error:
        problem, code = f"a worker does not fit, and the run ends here: {error}", UNUSABLE
    except (BrokenExecutor, RuntimeError) as error:
        problem, code = f"the work cannot be done there: {str(error).strip().rpartition(chr(10))[2]}", UNUSABLE
    except SystemExit:
        print_line(str(summary), err=True)
        raise
    if problem:
        print_line(f"Error: {problem}", err=True)
    print_line(str(summary), err=True)
    ctx.exit(code)


def _run(asked: Batch, options: RunOptions, summary: Summary) -> None:
    with ExitStack() as stack:
        results = stack.enter_context(batch(asked, _make_runner(options)))
        report = stack.enter_context(_open_report(options["report"]))
        shown = stack.enter_context(progress(len(asked.chosen), quiet=options["quiet"]))
        for result in results:
            summary.add(result.record.outcome, known=result.known)
            if report is not None:
                report(result.report_line())
            if not result.record.outcome.is_good:
                _print_failure(result.record)
            shown.step(known=result.known)


def _print_failure(record: ModelRecord) -> None:
    """Name a model that has no result on stderr, and the reason, as soon as it is known."""
    kept = "; the result of an earlier run stays" if record.kept else ""
    print_line(f"{record.source}: {record.outcome}: {record.message}{kept}", err=True)


@contextmanager
def _open_report(path: Path | None) -> Generator[Callable[[str], object] | None]:
    """Yield a function that writes a line of the report, at once; folders that are missing are made."""
    if path is None:
        yield None
    elif str(path) == "-":
        yield print_document
    else:
        refuse_way_out(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("w", encoding="ascii", newline="\n", buffering=1) as file:
            yield file.write


def _make_runner(options: RunOptions) -> Runner:
    if options["scheduler"] is None:
        return process_runner(options["jobs"], options["timeout"])
    from twinform.compiler.batch.dask_runner import dask_runner  # noqa: PLC0415 - few have more than one machine

    try:
        return dask_runner(options["scheduler"], tell=partial(print_line, err=True))
    except ImportError as error:
        from twinform.installation import install_command  # noqa: PLC0415 - see above

        raise click.UsageError(f"--scheduler needs Dask ({error}); run: {install_command('dask')}") from error


class _Progress:
    """Counts models, and shows how far the run is; `known` ones take no time and do not count for the rate."""

    def __init__(self, total: int, show: Callable[[int, str], object]) -> None:
        self.total, self.show, self.done, self.worked = total, show, 0, 0
        self.start = time.monotonic()

    def step(self, *, known: bool) -> None:
        """Count one more model."""
        self.done += 1
        self.worked += not known
        rate = self.worked / max(time.monotonic() - self.start, 1e-9)
        self.show(self.done, status(self.done, self.total, rate))


@contextmanager
def progress(total: int, *, quiet: bool) -> Generator[_Progress]:
    """Show progress on stderr: a bar on a terminal, a line now and then elsewhere, or nothing."""
    if quiet or not total:
        yield _Progress(total, lambda _done, _text: None)
    elif not sys.stderr.isatty() or find_spec("rich") is None:
        yield _Progress(total, _print_now_and_then())
    else:
        from rich.console import Console  # noqa: PLC0415 - scripts do without
        from rich.progress import BarColumn, Progress, TextColumn  # noqa: PLC0415 - scripts do without

        columns = (BarColumn(), TextColumn("{task.description}", markup=False))
        with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
            task = bar.add_task("", total=total)
            yield _Progress(total, lambda done, text: bar.update(task, completed=done, description=text))


def _print_now_and_then() -> Callable[[int, str], None]:
    printed = time.monotonic()

    def show(_done: int, text: str) -> None:
        nonlocal printed
        if time.monotonic() - printed >= _EVERY:
            printed = time.monotonic()
            print_line(text, err=True)

    return show


def status(done: int, total: int, rate: float) -> str:
    """Return how far a run is, how fast it goes, and how long the rest takes."""
    text = f"{done:,} of {total:,} models, {rate:.3g} a second"
    return f"{text}, {_format_time((total - done) / rate)} left" if rate > 0 and done < total else text


def _format_time(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
