"""Batches on executors of the caller's, with limits of time."""

import time
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path

import pytest

from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch import Batch, Convert, ModelRecord, Outcome, batch, of_folder
from twinform.compiler.batch.task import BatchJob, Done, LateError, Task, time_limit

_TEXT = '<robot name="r"><link name="a"/></robot>'


@dataclass(frozen=True, slots=True)
class _Sleep:
    """Never comes to an end."""

    def work(self, task: Task, content: bytes) -> Done:
        while True:
            time.sleep(0.01)


class _Unsendable(_Sleep):
    def __reduce__(self) -> str:
        raise TypeError("cannot be sent")


def _batch(folder: Path, job: BatchJob | None = None) -> Batch:
    source = folder / "src"
    source.mkdir(exist_ok=True)
    for name in ("a", "b", "c"):
        (source / f"{name}.urdf").write_text(_TEXT)
    job = job or Convert(to=ConversionRequest(to="sdf"))
    return Batch(source=source, entries=of_folder(source), job=job, load_options=LoadOptions(), dest=folder / "out")


def _run(asked: Batch, executor: Executor | None = None) -> list[ModelRecord]:
    with batch(asked, executor) as results:
        return sorted((result.record for result in results), key=lambda record: record.source)


@pytest.mark.slow
def test_threads_make_the_same_results_as_processes(tmp_path: Path) -> None:
    asked = _batch(tmp_path)
    with ThreadPoolExecutor(2) as executor:
        records = _run(asked, executor)
    assert [record.outcome for record in records] == [Outcome.CONVERTED] * 3
    with ProcessPoolExecutor(1, get_context("spawn")) as executor:
        _run(replace(asked, dest=tmp_path / "other"), executor)
    for name in ("a.sdf", "b.sdf", "c.sdf"):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "other" / name).read_bytes()


def test_a_job_in_a_thread_ends_when_its_time_is_over(tmp_path: Path) -> None:
    with ThreadPoolExecutor(3) as executor:
        records = _run(replace(_batch(tmp_path, _Sleep()), seconds=0.2), executor)
    assert [(record.outcome, record.message) for record in records] == [(Outcome.LATE, "did not come to an end")] * 3


def test_work_that_cannot_be_sent_is_said(tmp_path: Path) -> None:
    with (
        pytest.raises(RuntimeError, match="cannot be sent"),
        ProcessPoolExecutor(1, get_context("spawn")) as executor,
    ):
        _run(_batch(tmp_path, _Unsendable()), executor)


def test_another_version_of_the_compiler_does_not_work_along() -> None:
    from twinform.compiler.batch.entries import ModelEntry  # noqa: PLC0415 - only here
    from twinform.compiler.batch.task import work  # noqa: PLC0415 - only here

    task = Task(entry=ModelEntry("a", "a"), job=_Sleep(), root="", load_options=LoadOptions(), version="0.0.0")
    assert "and 0.0.0 asks for the work" in work(task).message


def test_a_limit_of_time_ends_with_its_work() -> None:
    with time_limit(0.05):
        pass
    time.sleep(0.1)
    with pytest.raises(LateError), time_limit(0.05):
        _never_end()


def _never_end() -> None:
    while True:
        time.sleep(0.01)
