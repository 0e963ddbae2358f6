"""Runs of a batch: what is known again, what they read from, and how they end."""

import io
import json
import os
import subprocess
import sys
import tarfile
import time
import zipfile
from pathlib import Path

import pytest

from twinform.cli.batch_run import status

from .conftest import GOOD, WRONG, Run

pytestmark = pytest.mark.slow

CONVERT = ("batch", "convert", "src", "out", "--to", "sdf", "--jobs", "1")
INCLUDING = """\
<sdf version="1.11"><world name="w">
  <include><uri>model://crate</uri></include>
</world></sdf>
"""
CRATE = '<sdf version="1.11"><model name="crate"><link name="base"/></model></sdf>'
CONFIG = '<model><name>crate</name><sdf version="1.11">model.sdf</sdf></model>'
XACRO = """\
<robot name="x" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="parts.xacro"/>
  <xacro:arg name="link" default="base"/>
  <link name="$(arg link)"/>
  <link name="$(optenv SIDE left)"/>
  <joint name="j" type="fixed"><parent link="$(arg link)"/><child link="$(optenv SIDE left)"/></joint>
</robot>
"""
PARTS = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><material name="red"/></robot>'


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A current folder with models of several files in `src`, all of them old."""
    monkeypatch.chdir(tmp_path)
    files = {
        "one.urdf": GOOD,
        "wrong.urdf": WRONG,
        "house.world": INCLUDING,
        "crate/model.sdf": CRATE,
        "crate/model.config": CONFIG,
        "x.urdf.xacro": XACRO,
        "parts.xacro": PARTS,
        ".git/config": "",
    }
    for name, text in files.items():
        put(tmp_path / "src" / name, text)
    return tmp_path


def put(path: Path, text: str, *, age: float = 100) -> None:
    """Write a file as if that had been some seconds ago."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    then = time.time() - age
    os.utime(path, (then, then))


def last(run: Run, *words: str) -> str:
    return run(*words).stderr.splitlines()[-1]


def written(folder: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path(folder).glob("[!.]*.*")}


def test_nothing_is_started_where_nothing_has_changed(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert last(run, *CONVERT, "--expand-includes") == "5 models: 4 converted, 1 refused"

    def refuse(*_: object) -> None:
        raise AssertionError("a process is started")

    monkeypatch.setattr("twinform.compiler.workers.ProcessPool", refuse)
    assert last(run, *CONVERT, "--expand-includes") == "5 models: 4 converted, 1 refused (5 known from before)"


@pytest.mark.parametrize(
    ("name", "text", "again"),
    [
        ("crate/model.sdf", CRATE.replace("base", "foot"), 2),
        ("crate/model.config", CONFIG.replace("crate", "box"), 1),
        ("parts.xacro", PARTS.replace("red", "blue"), 1),
        ("wrong.urdf", GOOD, 1),
        ("notes.txt", "nobody reads this", 0),
    ],
)
def test_what_a_model_was_made_from_is_looked_at(name: str, text: str, again: int, run: Run, here: Path) -> None:
    run(*CONVERT, "--expand-includes")
    put(here / "src" / name, text, age=50)
    known = f" ({5 - again} known from before)"
    assert last(run, *CONVERT, "--expand-includes").endswith(known)
    assert last(run, *CONVERT, "--expand-includes").endswith("(5 known from before)")


def test_what_was_looked_for_in_vain_is_looked_for_again(run: Run, here: Path) -> None:
    for name in ("model.sdf", "model.config"):
        (here / "src/crate" / name).unlink()
    (here / "src/crate").rmdir()
    assert last(run, *CONVERT, "--expand-includes") == "4 models: 2 converted, 2 refused"
    assert last(run, *CONVERT, "--expand-includes").endswith("2 refused (4 known from before)")
    put(here / "src/crate/model.sdf", CRATE)
    put(here / "src/crate/model.config", CONFIG)
    assert last(run, *CONVERT, "--expand-includes") == "5 models: 4 converted, 1 refused (3 known from before)"


def test_variables_that_a_model_asks_for_count(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asking = (*CONVERT, "--env", "SIDE")
    run(*asking)
    monkeypatch.setenv("SIDE", "right")
    assert last(run, *asking).endswith("(4 known from before)")
    assert '"right"' in Path("out/x.sdf").read_text()
    monkeypatch.setenv("ELSE", "nobody asks")
    assert last(run, *asking).endswith("(5 known from before)")


def test_a_file_that_is_only_newer_is_compared_by_its_content(run: Run, here: Path) -> None:
    run(*CONVERT)
    then = time.time() - 50
    os.utime(here / "src/one.urdf", (then, then))
    assert last(run, *CONVERT).endswith("(5 known from before)")


def test_a_file_as_young_as_its_record_is_compared_by_its_content(run: Run, here: Path) -> None:
    """A change within one step of the clock of a file system leaves neither size nor time behind."""
    path = here / "src/one.urdf"
    put(path, GOOD, age=-60)  # of a file server whose clock is ahead
    run(*CONVERT)
    status = path.stat()
    path.write_text(GOOD.replace("base", "foot"))
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert path.stat().st_size == status.st_size
    assert last(run, *CONVERT).endswith("(4 known from before)")
    assert "foot" in Path("out/one.sdf").read_text()


def test_names_come_from_a_list(run: Run, here: Path) -> None:
    names = f"one.urdf\n./one.urdf\n{here}/src/crate/model.sdf\n\n"
    Path("names").write_text(names)
    assert last(run, *CONVERT, "--names", "names") == "2 models: 2 converted"
    done = run("batch", "check", "-", "--jobs", "1", text=b"src/one.urdf\0src/wrong.urdf\0")
    assert done.stderr.endswith("2 models: 1 accepted, 1 refused\n")
    assert "../src is not" not in done.stderr
    Path("names").write_text("../elsewhere.urdf")
    assert run(*CONVERT, "--names", "names").exit_code == 2
    assert run("batch", "check", "-", text="").stderr == "0 models\n"


@pytest.mark.parametrize("kind", ["models.tar.gz", "models.zip"])
def test_an_archive_is_a_folder(kind: str, run: Run, here: Path) -> None:
    pack(here / kind, here / "src")
    words = ("batch", "convert", kind, "out", "--to", "sdf", "--expand-includes", "--jobs", "1")
    first = run(*words)
    assert first.stderr.endswith("5 models: 4 converted, 1 refused\n")
    assert f"wrong.urdf: refused: {kind}/wrong.urdf:3: " in first.stderr
    assert last(run, *words) == "5 models: 4 converted, 1 refused (5 known from before)"


def pack(path: Path, folder: Path) -> None:
    """An archive of a folder."""
    if path.suffix == ".zip":
        with zipfile.ZipFile(path, "w") as archive:
            for each in folder.rglob("*"):
                archive.write(each, each.relative_to(folder))
    else:
        with tarfile.open(path, "w:gz") as archive:
            archive.add(folder, ".")


def test_shards_share_the_models_and_are_merged(run: Run, here: Path) -> None:
    run("batch", "convert", "src", "whole", "--to", "sdf", "--jobs", "1")
    counts = [int(last(run, *CONVERT, "--shard", f"{number}/3").split()[0]) for number in (1, 2, 3)]
    assert sum(counts) == 5
    assert run("batch", "merge", "out").stderr == "5 models in out\n"
    assert sorted(path.name for path in Path("out/.twinform-batch").glob("manifest*")) == ["manifest.jsonl"]
    assert last(run, *CONVERT).endswith("(5 known from before)")
    assert written("whole") == written("out")
    for wrong in ("0/3", "4/3", "3", "a/b"):
        assert run(*CONVERT, "--shard", wrong).exit_code == 2


def test_results_of_other_folders_are_taken_over(run: Run, here: Path) -> None:
    for number in ("1", "2"):
        run("batch", "convert", "src", f"out{number}", "--to", "sdf", "--jobs", "1", "--shard", f"{number}/2")
    assert run("batch", "merge", "out", "out1", "out2").stderr == "5 models in out\n"
    assert last(run, *CONVERT).endswith("(5 known from before)")
    assert run("batch", "merge", "out", "src").exit_code == 2


def test_arguments_come_from_a_table(run: Run, here: Path) -> None:
    Path("table.csv").write_text("model,name,link\nx.urdf.xacro,left.urdf,l\nx.urdf.xacro,right.urdf,r\n")
    assert last(run, *CONVERT, "--arguments", "table.csv") == "6 models: 5 converted, 1 refused"
    assert '<link name="l">' in Path("out/left.sdf").read_text()
    assert '<link name="r">' in Path("out/right.sdf").read_text()
    Path("table.csv").write_text("model,name,link\nx.urdf.xacro,left.urdf,l\nx.urdf.xacro,right.urdf,other\n")
    assert last(run, *CONVERT, "--arguments", "table.csv").endswith("(5 known from before)")
    assert '<link name="other">' in Path("out/right.sdf").read_text()
    Path("table.jsonl").write_text(json.dumps({"model": "x.urdf.xacro", "link": "j"}))
    run(*CONVERT, "--arguments", "table.jsonl")
    assert '<link name="j">' in Path("out/x.sdf").read_text()


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("model,link\nnone.urdf,l\n", "table.csv:2: no model is called 'none.urdf'"),
        ("model,link\nx.urdf.xacro,l\nx.urdf.xacro,r\n", "table.csv:3: the name 'x.urdf.xacro' is taken"),
        ("model,name\nx.urdf.xacro,../up\n", "table.csv:2: the name '../up' is taken or no path"),
        ("model,name\nx.urdf.xacro,one.urdf\n", "table.csv:2: the name 'one.urdf' is taken"),
        ("link\nl\n", "table.csv:2: there is nothing in the column 'model'"),
    ],
)
def test_a_table_that_says_nothing_is_refused(table: str, message: str, run: Run, here: Path) -> None:
    Path("table.csv").write_text(table)
    done = run(*CONVERT, "--arguments", "table.csv")
    assert (done.exit_code, message in done.stderr) == (2, True)


def test_worlds_are_split_as_convert_does(run: Run, here: Path) -> None:
    world = '<sdf version="1.11"><world name="w"><model name="box"><link name="base"/></model></world></sdf>'
    put(here / "src/yard.world", world)
    run(*CONVERT, "--split")
    run("convert", "src/yard.world", "--split", "--to", "sdf", "-o", "apart")
    assert {path.name: path.read_text() for path in Path("out/yard").iterdir()} == {
        path.name: path.read_text() for path in Path("apart").iterdir()
    }
    assert Path("out/one.sdf").is_file()
    assert last(run, *CONVERT, "--split").endswith("(6 known from before)")
    put(here / "src/yard.world", world.replace('"box"', '"crate"'), age=50)
    run(*CONVERT, "--split")
    assert sorted(path.name for path in Path("out/yard").iterdir()) == ["crate.sdf", "yard.world"]


def test_check_stats_and_diff_need_no_folder_of_results(run: Run, here: Path) -> None:
    assert last(run, "batch", "check", "src", "--jobs", "1") == "5 models: 4 accepted, 1 refused"
    done = run("batch", "stats", "src", "--jobs", "1")
    rows = {row["source"]: row for row in map(json.loads, done.stdout.splitlines())}
    assert done.exit_code == 1
    assert rows["one.urdf"]["statistics"]["models"][0]["links"] == 1
    run(*CONVERT)
    done = run("batch", "diff", "src", "out", "--jobs", "1", "--report", "-")
    rows = {row["source"]: row for row in map(json.loads, done.stdout.splitlines())}
    assert {name: row["outcome"] for name, row in rows.items()} == {
        "crate/model": "same",
        "house": "same",
        "one": "same",
        "wrong": "missing",
        "x": "same",
    }
    assert "wrong: missing: there is no such model in the second folder" in done.stderr
    Path("out/one.sdf").write_text(Path("out/one.sdf").read_text().replace("<mass>1<", "<mass>2<"))
    assert "one: different: different robots: " in run("batch", "diff", "src", "out", "--jobs", "1").stderr


def test_two_runs_do_not_write_to_one_folder(run: Run, here: Path) -> None:
    from twinform.compiler.batch.manifest import Manifest  # noqa: PLC0415 - only here

    with Manifest(Path("out")).open():
        done = run(*CONVERT)
        assert (done.exit_code, "another run is at work in out" in done.stderr) == (2, True)
        assert run(*CONVERT, "--shard", "1/2").exit_code == 2
    with Manifest(Path("out"), "1-of-2").open():
        assert run(*CONVERT).exit_code == 2
        assert run(*CONVERT, "--shard", "1/2").exit_code == 2
        assert run(*CONVERT, "--shard", "2/2").exit_code in {0, 1}


def test_ctrl_c_ends_with_the_summary_and_the_report(here: Path) -> None:
    for number in range(200):
        put(here / f"src/many/{number}.urdf", GOOD)
    program = [sys.executable, "-c", "from twinform.cli import main; main()", *CONVERT, "--report", "report.jsonl"]
    with subprocess.Popen(program, stderr=subprocess.PIPE, text=True) as process:
        while not (Path("report.jsonl").is_file() and Path("report.jsonl").stat().st_size):
            time.sleep(0.02)
        process.send_signal(2)
        _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130
    *_, problem, summary = stderr.splitlines()
    assert problem == "Error: interrupted; run it again, and it goes on from here"
    assert int(summary.split()[0]) == len(Path("report.jsonl").read_text().splitlines()) < 205
    assert "Traceback" not in stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk_ends_the_run(run: Run, here: Path) -> None:
    done = run(*CONVERT, "--report", "/dev/full")
    assert done.exit_code == 2
    assert "No space left on device" in done.stderr
    assert last(run, *CONVERT).startswith("5 models: 4 converted, 1 refused")


def test_a_result_that_finds_no_space_ends_the_run_and_is_made_by_the_next(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:

        def full(*_: object, **__: object) -> None:
            raise OSError(28, "No space left on device", "out/one.sdf")

        patch.setattr("twinform.compiler.batch.recording.write_all_atomically", full)
        done = run(*CONVERT)
    assert (done.exit_code, "cannot write out/one.sdf: No space left" in done.stderr) == (2, True)
    assert last(run, *CONVERT).startswith("5 models: 4 converted, 1 refused")
    assert len(list(Path("out").glob("*.sdf"))) == 2


def test_the_progress_has_a_rate_and_the_time_that_is_left() -> None:
    assert status(10, 40, 2.5) == "10 of 40 models, 2.5 a second, 0:12 left"
    assert status(1, 1_000_000, 50) == "1 of 1,000,000 models, 50 a second, 5:33:20 left"
    assert status(0, 5, 0) == "0 of 5 models, 0 a second"


def test_lines_come_now_and_then_where_there_is_no_terminal(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("twinform.cli.batch_run._EVERY", 0)
    assert "1 of 5 models, " in run(*CONVERT).stderr
    assert " of 5 models, " not in run(*CONVERT, "--quiet").stderr


def test_a_bar_moves_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    from twinform.cli.batch_run import progress  # noqa: PLC0415 - only here

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    with progress(2, quiet=False) as shown:
        shown.step(known=True)
        shown.step(known=False)
    assert "2 of 2 models" in terminal.getvalue()
