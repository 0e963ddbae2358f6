"""How far a batch is: one line that moves on a terminal, a line now and then elsewhere, or nothing."""

import sys
import time
from collections.abc import Generator
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING, Protocol

from twinform.cli.printing import print_line

if TYPE_CHECKING:
    from rich.progress import Progress as RichProgress

# Seconds between lines where there is no terminal: a short run prints none.
_EVERY = 30.0


class Progress(Protocol):
    """Counts models."""

    def step(self, *, known: bool) -> None:
        """One more is done; `known` ones take no time, and do not count for the rate."""
        ...


class _Quiet:
    def step(self, *, known: bool) -> None:
        """Print nothing."""


class _Lines:
    """Says now and then how far it is."""

    def __init__(self, total: int) -> None:
        self.total, self.done, self.worked = total, 0, 0
        self.start = self.printed = time.monotonic()

    def step(self, *, known: bool) -> None:
        self.done += 1
        self.worked += not known
        now = time.monotonic()
        if now - self.printed >= _EVERY:
            self.printed = now
            print_line(status(self.done, self.total, self.worked / (now - self.start)), err=True)


def status(done: int, total: int, rate: float) -> str:
    """How far it is, how fast it goes, and how long the rest takes."""
    text = f"{done:,} of {total:,} models, {rate:.3g} a second"
    return f"{text}, {_clock((total - done) / rate)} left" if rate > 0 and done < total else text


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


class _Bar:
    """A bar of rich, which moves."""

    def __init__(self, bar: "RichProgress", total: int) -> None:
        self.bar, self.total, self.done, self.worked = bar, total, 0, 0
        self.start = time.monotonic()
        self.task = bar.add_task("", total=total)

    def step(self, *, known: bool) -> None:
        self.done += 1
        self.worked += not known
        rate = self.worked / max(time.monotonic() - self.start, 1e-9)
        self.bar.update(self.task, completed=self.done, description=status(self.done, self.total, rate))


@contextmanager
def progress(total: int, *, quiet: bool) -> Generator[Progress]:
    """Show the progress on stderr, as far as that can be done there."""
    if quiet or not total:
        yield _Quiet()
    elif not sys.stderr.isatty() or find_spec("rich") is None:
        yield _Lines(total)
    else:
        from rich.console import Console  # noqa: PLC0415 - scripts do without
        from rich.progress import BarColumn, TextColumn  # noqa: PLC0415 - scripts do without
        from rich.progress import Progress as RichProgress  # noqa: PLC0415 - scripts do without

        columns = (BarColumn(), TextColumn("{task.description}", markup=False))
        with RichProgress(*columns, console=Console(stderr=True), transient=True) as bar:
            yield _Bar(bar, total)
