"""Jobs on meshes in another process, and the cache of what comes of them."""

import errno
import importlib
import io
import os
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

from twinform.passes.mesh_jobs.child import do_job
from twinform.passes.mesh_jobs.child_process import MeshProcess
from twinform.passes.mesh_jobs.job import BadMessageError, MeshJob, MeshResult, Options
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError, content_of
from twinform.passes.meshes.mesh_pass import VARIABLE, ResultsCache

pytestmark = pytest.mark.slow

trimesh: Any = importlib.import_module("trimesh")
BOX: bytes = trimesh.creation.box((1, 2, 3)).export(file_type="stl")
OPTIONS: Options = {
    "submesh": None, "center": False, "gltf_up": "z", "max_error": None, "max_relative_error": 0.05, "scale": [1, 1, 1],
    "how": ["primitive", "hull"], "shapes": ["box"], "triangles": None, "parts": 4, "stem": "x", "to": "stl",
}  # fmt: skip


def job(content: bytes = BOX, kind: str = "stl", name: str = "simplify", **options: float | str | None) -> MeshJob:
    return MeshJob(name, {**OPTIONS, **options}, kind, content)


def test_jobs_and_results_are_the_same_after_the_way_there_and_back() -> None:
    sent = MeshJob("convert", OPTIONS, "obj", b"v 0 0 0", {"a.mtl": b"\0\xff"})
    assert MeshJob.read(io.BytesIO(sent.to_bytes())) == sent
    result = MeshResult({"error": 0.5}, {".obj": b"\0"}, None, "")
    assert MeshResult.read(io.BytesIO(result.to_bytes())) == result
    with pytest.raises(BadMessageError):
        MeshResult.read(io.BytesIO(result.to_bytes()[:-1]))


def test_a_box_is_a_box_and_nothing_else() -> None:
    facts = do_job(job()).facts
    assert (facts["kind"], facts["sizes"], facts["error"]) == ("box", [1.0, 2.0, 3.0], 0.0)


@pytest.mark.parametrize(
    ("content", "kind", "why"),
    [
        (b"", "stl", ""),
        (b"\0" * 80 + b"\xff\xff\xff\xff" + b"\0" * 50, "stl", ""),
        (b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "obj", "flat"),
        (b"v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", "obj", "no finite numbers"),
        (b"v 0 0 0\nf 1 1 1\n", "obj", "no area"),
        (b"ply\nformat ascii 1.0\nelement vertex 999999999999\nproperty float x\nend_header\n", "ply", ""),
        (b"<!DOCTYPE a SYSTEM 'file:///etc/passwd'><COLLADA/>", "dae", "document type"),
        ("<!DOCTYPE a><COLLADA/>".encode("utf-16"), "dae", "UTF-8"),
        (b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "/etc/passwd", "byteLength": 9}]}', "gltf", ""),
        (b"glTF\x02\0\0\0\xff\xff\xff\xff", "glb", ""),
    ],
)
def test_a_hostile_mesh_is_trouble_and_no_more(content: bytes, kind: str, why: str) -> None:
    result = do_job(job(content, kind))
    assert result.trouble == "unreadable"
    assert result.message
    assert why in result.message


def test_scales_that_leave_nothing_are_trouble() -> None:
    result = do_job(MeshJob("simplify", {**OPTIONS, "scale": [1, 0, 1]}, "stl", BOX))
    assert result.trouble == "unreadable"
    assert "scale" in result.message


def test_a_machine_that_refuses_another_thread_is_trouble(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: object) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Timer, "start", refuse)
    process = MeshProcess()
    try:
        assert "cannot be started (can't start new thread)" in process.do(job()).message
    finally:
        process.end()


def test_a_process_that_runs_out_of_time_or_memory_takes_only_its_job_along() -> None:
    process = MeshProcess(seconds=0.01)
    try:
        assert "0.01 seconds" in process.do(job()).message
        process.seconds = 600.0
        assert process.do(job()).facts["kind"] == "box"
    finally:
        process.end()
    process = MeshProcess(memory=2**25)
    try:
        many = trimesh.creation.icosphere(6).export(file_type="stl")  # more than what is free of the memory that it has
        assert process.do(job(many)).trouble is not None
    finally:
        process.end()


def test_results_are_kept_by_all_that_they_depend_on(tmp_path: Path) -> None:
    cache, result = ResultsCache(tmp_path / "a"), MeshResult({"error": 1.0}, {".obj": b"v"})
    assert cache.get(job()) is None
    cache.put(job(), result)
    assert cache.get(job()) == result
    assert cache.get(job(max_error=0.1)) is None
    assert cache.get(job(BOX + b"\0")) is None
    cache.put(job(kind="ply"), MeshResult({}, trouble="unreadable", message="no"))
    assert cache.get(job(kind="ply")) is None


def test_a_damaged_result_is_none(tmp_path: Path) -> None:
    cache = ResultsCache(tmp_path)
    cache.put(job(), MeshResult({"error": 1.0}))
    (file,) = tmp_path.iterdir()
    file.write_bytes(file.read_bytes()[:-1] + b"?")
    assert cache.get(job()) is None
    file.write_bytes(b"")
    assert cache.get(job()) is None


def test_nothing_is_kept_where_the_versions_cannot_be_read(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def fail(name: str) -> str:
        raise OSError(errno.EIO, os.strerror(errno.EIO), name)

    monkeypatch.setattr("twinform.passes.meshes.mesh_pass.version", fail)
    cache = ResultsCache(tmp_path)
    cache.put(job(), MeshResult({"error": 1.0}))
    assert cache.get(job()) is None
    assert [*tmp_path.iterdir()] == []


def test_runs_side_by_side_do_each_other_no_harm(tmp_path: Path) -> None:
    cache, result = ResultsCache(tmp_path), MeshResult({"error": 1.0}, {".obj": b"v" * 100_000})
    seen: list[MeshResult | None] = []

    def work() -> None:
        for _ in range(20):
            cache.put(job(), result)
            seen.append(cache.get(job()))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(each == result for each in seen)
    assert len(list(tmp_path.iterdir())) == 1


def test_the_cache_is_where_the_variables_say(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv(VARIABLE, "off")
    assert ResultsCache.usual().folder is None
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    assert ResultsCache.usual().folder == tmp_path
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert ResultsCache.usual().folder == tmp_path / "twinform" / "meshes"


def test_a_folder_that_cannot_be_written_to_is_no_reason_to_fail(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    ResultsCache(tmp_path / "file" / "below").put(job(), MeshResult({}))


def test_what_stops_a_reader_is_said_as_that() -> None:
    found = do_job(job(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n", "obj"))
    assert found.message.startswith("its reader stops at it (IndexError: ")
    assert do_job(job(b"", "stl")).message == "it has no triangles"


def test_a_pointer_of_git_lfs_is_no_mesh(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    path.write_bytes(b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n")
    with pytest.raises(RefusedMeshError, match="not the file itself: run `git lfs pull`"):
        content_of(path)


def test_the_process_ends_with_the_one_that_asks_also_in_the_middle_of_a_job() -> None:
    busy = (
        "from twinform.passes.mesh_jobs import child\nchild.done = lambda job: [0 for _ in iter(int, 1)]\nchild.main()"
    )
    command = [sys.executable, "-c", busy, str(2**32)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdin is not None
        process.stdin.write(job().to_bytes())
        process.stdin.close()
        assert process.wait() == 1


def test_a_process_that_cannot_be_started_is_a_word_about_the_mesh(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.EAGAIN, os.strerror(errno.EAGAIN))

    monkeypatch.setattr(subprocess, "Popen", full)
    found = MeshProcess().do(job())
    assert (found.trouble, "cannot be started (Resource temporarily unavailable)" in found.message) == (
        "unreadable",
        True,
    )
