"""What is lost or out of date after batches are killed, their disks fill up or go away, and versions are mixed?"""

import os
import random
import subprocess
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import ProcessPoolExecutor
from contextlib import chdir, contextmanager, suppress
from functools import partial
from multiprocessing import get_context
from tempfile import TemporaryDirectory

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.batches.campaign import Campaign, Tally, play
from testbed.batches.clusters import cluster, kill_cluster_workers, kill_scheduler, mix_versions
from testbed.markdown import subsection, table

_MODELS = 400
_SPACE = "16m"
_ABOUT = """\
Models of four kinds (URDF, xacro with a file that it includes, worlds that include a model, that model) are converted;
then, again and again, some of them change, a run begins, and something fails. Every file keeps its size and its
modification time when it changes, as in a reproducible archive. Some of the changes are errors. After each event every
result that was there before is looked for: it must be there with the bytes that it had, or with those that its model
makes now, unless the model has an error now. After every twentieth event and at the end, a run that nothing happens to
must leave exactly what all models make now, which is worked out without any record of an earlier run."""


def measure(sample: Sample) -> Findings:
    """Let all of it happen: three campaigns at a time, two of processes of this machine and one of a cluster."""
    tally = Tally()
    parts = [(_local, sample.seed), (_local, sample.seed + 1), (_on_cluster, sample.seed + 2)]
    with ProcessPoolExecutor(len(parts), get_context("spawn")) as pool:
        for future in [pool.submit(_part, *part, sample.every) for part in parts]:
            tally.add(future.result())
    faults = [*tally.lost, *tally.stale]
    return Findings(list(_sections(tally, max(20, _MODELS // sample.every))), _summary(tally), faults)


def _part(events: "Callable[[Campaign, int, bool], None]", seed: int, every: int) -> Tally:
    """A campaign of its own, in a folder of its own."""
    with TemporaryDirectory() as place, chdir(place), _small_disk() as is_small:
        campaign = Campaign(count=max(20, _MODELS // every), chance=random.Random(seed))
        campaign.prepare()
        events(campaign, every, is_small)
    return campaign.tally


def _local(campaign: Campaign, every: int, is_small: bool) -> None:
    """Events of runs in processes of this machine, in any order."""
    lose = campaign.lose
    kinds: list[tuple[Callable[[], None], int]] = [
        (partial(campaign.kill_runs, 3), 12),
        (partial(campaign.kill_workers, 5), 5),
        (campaign.interrupt_run, 2),
        (partial(lose, campaign.out, "the folder of the results goes away"), 3),
        (partial(lose, campaign.sources.folder, "the folder of the models goes away"), 3),
        (campaign.turn_clock, 3),
        (campaign.hurry, 2),
        *([(campaign.fill_disk, 3)] if is_small else []),
    ]
    _play(campaign, kinds, every)


def _on_cluster(campaign: Campaign, every: int, is_small: bool) -> None:
    """Events of runs on a cluster, in any order."""
    with cluster(2) as made:
        kinds: list[tuple[Callable[[], None], int]] = [
            (partial(kill_cluster_workers, campaign, made, 6), 7),
            (partial(kill_scheduler, campaign, made), 6),
            (partial(mix_versions, campaign, made), 4),
        ]
        _play(campaign, kinds, every)


def _play(campaign: Campaign, kinds: Iterable[tuple[Callable[[], None], int]], every: int) -> None:
    events = [event for event, times in kinds for _ in range(max(1, times // every))]
    campaign.chance.shuffle(events)
    play(campaign, events)


@contextmanager
def _small_disk() -> Generator[bool]:
    """A small file system in the folder `disk`, where the caller may have one."""
    os.mkdir("disk")  # noqa: PTH102 - of the current folder
    try:
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={_SPACE}", "tmpfs", "disk"], check=False)
    except FileNotFoundError:
        yield False
        return
    try:
        yield done.returncode == 0
    finally:
        if done.returncode == 0:
            with suppress(OSError):
                subprocess.run(["umount", "--lazy", "disk"], check=False)


def _sections(tally: Tally, models: int) -> Generator[str]:
    rows, killed = sorted(tally.events.items()), sum(tally.kills[each] for each in _KILLED)
    text = f"""
Three campaigns of {models} models, {tally.events.total()} events, {killed} processes killed.
{tally.earlier:,} times a result of an earlier run was looked for afterwards: **{len(tally.lost)} lost,
{len(tally.stale)} out of date**, whole runs included.
"""
    yield subsection("Found", text, table(("event", "times"), rows))
    yield subsection("Killed", table(("what", "how many"), sorted(tally.kills.items())))


_KILLED = ("runs", "workers", "workers of Dask", "schedulers")


def _summary(tally: Tally) -> str:
    return f"{tally.events.total()} events, {len(tally.lost)} results lost, {len(tally.stale)} out of date"


SECTION = Section("batch_losses", _ABOUT, measure, needs=())
