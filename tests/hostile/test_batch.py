"""Folders of models in which not everything is a file: no model is opened by the process that waits for the others."""

import json
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from testbed import robots

_WATCHED = """
import json, os, sys
seen = []
def hook(event, arguments):
    if event == "open" and not isinstance(arguments[0], int):
        seen.append(os.path.realpath(os.fsdecode(arguments[0])))
sys.addaudithook(hook)
from twinform.cli import main
try:
    main(sys.argv[1:])
finally:
    print(json.dumps(seen))
"""
_PATIENCE = 100
"""Seconds after which the run surely hangs."""


@pytest.fixture
def here(tmp_path: Path) -> Path:
    (tmp_path / ".git").mkdir()
    (tmp_path / "src").mkdir()
    (tmp_path / "src/good.urdf").write_text(robots.urdf(2))
    return tmp_path


def _batch(here: Path, *words: str) -> tuple[int, dict[str, dict[str, str]], list[str]]:
    """The exit code, what the report has of each model, and what the process itself has opened."""
    command = [sys.executable, "-c", _WATCHED, "batch", "convert", "src", "out", "--to", "sdf", "--jobs", "1", *words]
    done = subprocess.run(
        [*command, "--report", "report.json"], cwd=here, capture_output=True, text=True, timeout=_PATIENCE, check=False
    )
    assert "Traceback" not in done.stderr, done.stderr
    models = map(json.loads, (here / "report.json").read_text().splitlines())
    return done.returncode, {each["source"]: each for each in models}, json.loads(done.stdout)


def test_what_is_no_file_is_named_and_never_waited_for(here: Path) -> None:
    src = here / "src"
    os.mkfifo(src / "robot.urdf")
    (src / "zero.sdf").symlink_to("/dev/zero")
    (src / "gone.sdf").symlink_to("nowhere")
    (src / "round.sdf").symlink_to("round.sdf")
    (src / "folder.urdf").mkdir()
    (src / "link.urdf").symlink_to("folder.urdf")
    (src / "huge.urdf").write_text(robots.urdf(2) + " " * (65 * 2**20))
    with socket.socket(socket.AF_UNIX) as listening:
        old = Path.cwd()
        os.chdir(src)  # the path of a socket must be short
        listening.bind("socket.world")
        os.chdir(old)
        code, found, opened = _batch(here)
    assert code == 2
    assert {name: (each["outcome"], each["message"].partition(": ")[2]) for name, each in found.items()} == {
        "good.urdf": ("converted", ""),
        "robot.urdf": ("unreadable", "it is a pipe and no file"),
        "zero.sdf": ("unreadable", "it leads to '/dev/zero', outside of the folders of models and packages"),
        "socket.world": ("unreadable", "it is a socket and no file"),
        "gone.sdf": ("unreadable", "No such file or directory"),
        "round.sdf": ("unreadable", "Too many levels of symbolic links"),
        "huge.urdf": ("unreadable", "the file has more than 67,108,864 bytes"),
    }
    assert [each for each in opened if Path(each).is_relative_to(src)] == []


def test_no_model_is_opened_by_the_process_that_waits_also_where_all_is_known(here: Path) -> None:
    _batch(here)
    code, found, opened = _batch(here)
    assert (code, found["good.urdf"]["outcome"]) == (0, "converted")
    assert [each for each in opened if Path(each).is_relative_to(here / "src")] == []


def test_a_result_is_never_written_into_a_pipe_or_over_a_model(here: Path) -> None:
    (here / "out").mkdir()
    models = {name: here / "src" / f"{name}.urdf" for name in ("pipe", "hard", "soft", "one", "two")}
    for each in models.values():
        each.write_text(robots.urdf(2))
    os.mkfifo(here / "out/pipe.sdf")
    (here / "out/hard.sdf").hardlink_to(models["hard"])
    (here / "out/soft.sdf").symlink_to(models["hard"])
    (here / "out/one.sdf").symlink_to("two.sdf")
    code, found, _ = _batch(here)
    assert (code, found["good.urdf"]["outcome"]) == (2, "converted")
    reasons = {name: found[f"{name}.urdf"]["message"].split()[-5:] for name in models}
    assert {name: " ".join(words) for name, words in reasons.items()} == {
        "pipe": "is a pipe or device",
        "hard": "leads to the model hard.urdf",
        "soft": "leads to the model hard.urdf",
        "one": "to where another result goes",
        "two": "to where another result goes",
    }
    assert {each.read_text() for each in models.values()} == {robots.urdf(2)}
    assert sorted(each.name for each in (here / "out").glob("*.sdf") if each.is_file() and not each.is_symlink()) == [
        "good.sdf",
        "hard.sdf",
    ]


@pytest.mark.parametrize("report", ["src/good.urdf", "out/good.sdf", "link.json"])
def test_a_report_is_not_written_over_a_model_or_a_result(report: str, here: Path) -> None:
    before = (here / "src/good.urdf").read_text()
    (here / "link.json").symlink_to("src/good.urdf")
    command = [
        sys.executable,
        "-c",
        "from twinform.cli import main; main()",
        "batch",
        "convert",
        "src",
        "out",
        "--to",
        "sdf",
    ]
    done = subprocess.run([*command, "--report", report], cwd=here, capture_output=True, text=True, check=False)
    assert (done.returncode, (here / "out").exists()) == (2, False)
    assert "would be written over" in done.stderr
    assert (here / "src/good.urdf").read_text() == before


def test_a_manifest_of_somebody_else_removes_nothing_outside(here: Path) -> None:
    """The record of an earlier run decides which result goes when its model is wrong; it is a file like any other."""
    _batch(here)
    (here / "secret").write_text("secret")
    manifest = here / "out/.twinform-batch/manifest.jsonl"
    record = json.loads(manifest.read_text())
    digest = "2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b"  # of "secret"
    status = (here / "secret").stat()
    for output in ("../secret", str(here / "secret")):
        result = [output, "read", status.st_size, status.st_mtime_ns, digest]
        manifest.write_text(json.dumps({**record, "results": [result]}) + "\n")
        (here / "src/good.urdf").write_text("<robot/>")
        _batch(here)
        assert (here / "secret").read_text() == "secret"
