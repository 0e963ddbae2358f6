"""`--watch`: work on files again when they, or files that they are made from such as includes and macros, change."""

import os
import stat
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import field
from typing import NamedTuple, Protocol, TypeVar

import click

from twinform.cli.command import INTERRUPTED, Unusable
from twinform.cli.inputs import InputSource, format_of_suffix
from twinform.cli.printing import print_line
from twinform.compiler.observing import Observation, observed
from twinform.dataclass import dataclass
from twinform.diagnostics.wording import plural

# How long to wait for the system to report a change before looking, since not every file system reports changes.
_MILLISECONDS = 1000
_MOST_WAITS = 5
"""The number of waits before new models are looked for in all folders."""


class Round(Protocol):
    """Collects the results of one round."""

    def end(self) -> object:
        """Report the results."""
        ...


AnyRound = TypeVar("AnyRound", bound=Round)


class _Status(NamedTuple):
    """The status of a file, which changes with its content."""

    time: int
    size: int
    number: int

    @classmethod
    def of(cls, status: os.stat_result | None) -> "_Status | None":
        return cls(status.st_mtime_ns, status.st_size, status.st_ino) if status else None


@dataclass(slots=True)
class _Watched:
    """The files that were read or looked for while working on each input, and their status then."""

    files: dict[str, Mapping[str, _Status | None]] = field(default_factory=dict[str, Mapping[str, "_Status | None"]])

    def note(self, name: str, seen: Observation) -> None:
        whole = seen.merged()
        every = {**whole.looked_at, **whole.read}
        # The time of a folder changes with every file in it, such as an editor's swap file.
        files = {path: status for path, status in every.items() if status is None or not stat.S_ISDIR(status.st_mode)}
        self.files[name] = {path: _Status.of(status) for path, status in files.items()}

    def is_stale(self, name: str) -> bool:
        """Whether an input is new, or a file that it was made from has changed."""
        known = self.files.get(name)
        return known is None or any(_status_of(path) != status for path, status in known.items())

    def folders(self, names: Iterable[str]) -> set[str]:
        """Return the folders of all files that inputs are made from, and the current one."""
        files = (path for name in names for path in self.files.get(name, ()))
        return {os.getcwd(), *map(os.path.dirname, files)}  # noqa: PTH109 - many strings


def watch_models(
    find: Callable[[], Sequence[InputSource]],
    new_round: Callable[[], AnyRound],
    work: Callable[[InputSource, AnyRound], None],
) -> int:
    """Work on all models, and again on those that change, until Ctrl-C; return the exit code.

    Raises:
        Unusable: watchfiles is not installed.
    """
    _require_watchfiles()
    watched = _Watched()
    try:
        while True:
            sources = _find_models(find)
            stale = [source for source in sources if watched.is_stale(source.name)]
            if stale:
                _work_on(stale, new_round(), work, watched)
                print_line(f"watching {plural(len(sources), 'file')}; Ctrl-C ends", err=True)
            _wait([source.name for source in sources], watched)
    except KeyboardInterrupt:
        return INTERRUPTED


def _find_models(find: Callable[[], Sequence[InputSource]]) -> Sequence[InputSource]:
    try:
        return find()
    except click.UsageError:
        return ()  # all models are gone; they may come back


def _work_on(
    sources: Sequence[InputSource], round_: AnyRound, work: Callable[[InputSource, AnyRound], None], watched: _Watched
) -> None:
    for source in sources:
        with observed() as seen:
            work(source, round_)
        watched.note(source.name, seen)
    round_.end()


def _require_watchfiles() -> None:
    try:
        import watchfiles  # noqa: F401, PLC0415 # pyright: ignore[reportUnusedImport] - an extra
    except ImportError as error:
        from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

        raise Unusable(f"--watch needs watchfiles; run: {install_command('watch')}") from error


def _wait(names: Sequence[str], watched: _Watched) -> None:
    """Wait until a file of an input has changed, or until it is time to look for new models."""
    import watchfiles  # noqa: PLC0415 - an extra

    folders = sorted(folder for folder in watched.folders(names) if os.path.isdir(folder))  # noqa: PTH112 - many strings
    waits = 0
    try:
        for changes in watchfiles.watch(
            # Not recursive: a workspace of ROS has a hundred thousand files, and inotify needs a watch
            # for each folder.
            *folders,
            watch_filter=None,
            recursive=False,
            rust_timeout=_MILLISECONDS,
            yield_on_timeout=True,
        ):
            waits += 1
            is_new = any(format_of_suffix(path) for _, path in changes)
            if is_new or waits == _MOST_WAITS or any(watched.is_stale(name) for name in names):
                return
    except FileNotFoundError:
        time.sleep(_MILLISECONDS / 1000)  # a folder was deleted meanwhile


def _status_of(path: str) -> _Status | None:
    try:
        return _Status.of(os.stat(path))  # noqa: PTH116 - many strings
    except OSError:
        return None
