"""Runs that are killed, and what the next run makes of it."""

import os
import random
import signal
import subprocess
from pathlib import Path

import pytest

from twinform.compiler.batch.manifest import Manifest, read_records, record_line
from twinform.compiler.batch.record import ModelRecord, Outcome
from twinform.compiler.dependencies import Dependency, DependencyKind

from .conftest import SUMMARY, converting, finish, records, results, wait_for

_TIMES = 10


@pytest.mark.deep
def test_killed_at_ten_random_moments_and_resumed_the_results_are_the_same_bytes(here: Path) -> None:
    assert finish(converting(out="whole")) == SUMMARY
    moments = sorted(random.Random(16).sample(range(1, 99), _TIMES))
    for moment in moments:
        process = subprocess.Popen(converting("--jobs", "2"), stderr=subprocess.DEVNULL, start_new_session=True)
        wait_for(lambda moment=moment, process=process: records() >= moment or process.poll() is not None)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    known = records()
    assert 0 < known < 100
    last = finish(converting("--jobs", "2"))
    assert last.startswith(f"{SUMMARY} (")
    assert int(last.rpartition("(")[2].split()[0]) >= moments[-1]
    assert results() == results("whole")
    assert finish(converting()) == f"{SUMMARY} (100 known from before)"


@pytest.mark.deep
def test_workers_that_are_killed_are_replaced(here: Path) -> None:
    assert finish(converting(out="whole")) == SUMMARY
    process = subprocess.Popen(converting("--jobs", "2"), stderr=subprocess.PIPE, text=True)
    for moment in (5, 30, 60):
        wait_for(lambda moment=moment: records() >= moment or process.poll() is not None)
        for child in _workers(process.pid)[:1]:
            os.kill(child, signal.SIGKILL)
    _, stderr = process.communicate(timeout=600)
    summary = stderr.splitlines()[-1]
    crashed = stderr.count(": crashed: the process died")
    assert summary.startswith("100 models: ")
    assert crashed <= 3
    assert finish(converting()).startswith(f"{SUMMARY} ({100 - crashed} known")
    assert results() == results("whole")


def _workers(parent: int) -> list[int]:
    """The processes of a pool: all children but the one that looks after shared things."""
    found: list[int] = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            status, command = (folder / "stat").read_text(), (folder / "cmdline").read_bytes()
        except OSError:
            continue
        if int(status.rpartition(")")[2].split()[1]) == parent and b"spawn_main" in command:
            found.append(int(folder.name))
    return found


def test_a_manifest_that_was_cut_anywhere_keeps_the_whole_lines_and_takes_more(tmp_path: Path) -> None:
    dependency = Dependency("a.urdf", DependencyKind.READ, 3, 5, "x")
    names = ("a", "b\udcff", "ö")
    written = [
        ModelRecord(source=name, request="r", outcome=Outcome.REFUSED, dependencies=(dependency,)) for name in names
    ]
    whole = b"".join(map(record_line, written))
    path = tmp_path / ".twinform-batch/manifest.jsonl"
    path.parent.mkdir()
    for cut in range(len(whole) + 1):
        path.write_bytes(whole[:cut])
        lines = whole[:cut].count(b"\n")
        with Manifest(tmp_path).open() as manifest:
            assert len(manifest) == lines
            manifest.add(written[2])
        found = list(read_records(path))
        assert (found[:lines], found[-1]) == (written[:lines], written[2])


def test_a_manifest_is_written_anew_where_most_of_it_is_old(tmp_path: Path) -> None:
    record = ModelRecord(source="a", request="r", outcome=Outcome.REFUSED)
    with Manifest(tmp_path).open() as manifest:
        for _ in range(10):
            manifest.add(record)
    with Manifest(tmp_path).open() as manifest:
        assert manifest.get("a") == record
    assert (tmp_path / ".twinform-batch/manifest.jsonl").read_bytes().count(b"\n") == 1
