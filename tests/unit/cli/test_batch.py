"""A folder of models: all are worked on, whatever one of them does."""

import json
import os
import time
from collections import Counter
from pathlib import Path
from typing import Any, ClassVar

import pytest

from tests.distributions import Install
from tests.write_files import write_files
from twinform.compiler.batch.entries import outputs
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import Pass

from .conftest import BROKEN, GOOD, WARNED, WRONG, Run

pytestmark = pytest.mark.slow


class Chaos(Pass):
    """Does what the name of the model stands for."""

    name: ClassVar[str] = "chaos"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        match document.models[0].name:
            case "crash":
                os._exit(9)
            case "hang":
                time.sleep(600)
            case "raise":
                raise ZeroDivisionError("no parts")
            case _:
                pass
        return document


@pytest.fixture(scope="module")
def _chaos(install: Install) -> None:
    install("stranger", {"chaos": f"{__name__}:Chaos"})


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A current folder with models in `src`."""
    monkeypatch.chdir(tmp_path)
    write_files(
        tmp_path / "src",
        {
            "one.urdf": GOOD,
            "deep/er/two.urdf": GOOD.replace("one", "two"),
            "deep/warned.urdf": WARNED,
            "notes.txt": "no model",
            ".git/hidden.urdf": GOOD,
        },
    )
    return tmp_path


def results() -> list[str]:
    return sorted(path.relative_to("out").as_posix() for path in Path("out").rglob("*.*df"))


def report(run: Run, *arguments: str) -> tuple[int, dict[str, Any]]:
    """The exit code and the report of a run."""
    done = run("batch", "convert", "src", "out", "--to", "sdf", "--jobs", "1", "--report", "report.json", *arguments)
    rows = [json.loads(line) for line in Path("report.json").read_text().splitlines()]
    models = sorted(rows, key=lambda row: row["source"])
    return done.exit_code, {"models": models, "summary": Counter(row["outcome"] for row in rows)}


def outcomes(found: dict[str, Any]) -> dict[str, str]:
    return {each["source"]: each["outcome"] for each in found["models"]}


def test_every_model_keeps_its_place(run: Run, here: Path) -> None:
    done = run("batch", "convert", "src", "out", "--to", "sdf")
    assert (done.exit_code, done.stderr) == (0, "3 models: 3 converted\n")
    assert results() == ["deep/er/two.sdf", "deep/warned.sdf", "one.sdf"]
    assert Path("out/one.sdf").read_bytes() == run("convert", "src/one.urdf").stdout_bytes


def test_what_was_done_is_not_done_again(run: Run, here: Path) -> None:
    again = ("batch", "convert", "src", "out", "--to", "sdf", "--jobs", "1")
    run(*again)
    assert run(*again).stderr == "3 models: 3 converted (3 known from before)\n"
    Path("src/one.urdf").write_text(GOOD.replace("base", "foot"))
    assert run(*again).stderr == "3 models: 3 converted (2 known from before)\n"
    assert "foot" in Path("out/one.sdf").read_text()
    Path("out/one.sdf").write_text("edited")
    Path("out/deep/warned.sdf").unlink()
    assert run(*again).stderr == "3 models: 3 converted (1 known from before)\n"
    assert run(*again, "--sdf-version", "1.9").stderr == "3 models: 3 converted\n"
    assert run(*again, "--sdf-version", "1.9", "--fresh").stderr == "3 models: 3 converted\n"
    assert ' version="1.9">' in Path("out/one.sdf").read_text()


@pytest.mark.usefixtures("_chaos")
def test_no_model_stops_the_rest(run: Run, here: Path) -> None:
    for name in ("crash", "hang", "raise"):
        Path(f"src/{name}.urdf").write_text(GOOD.replace('"one"', f'"{name}"'))
    Path("src/wrong.urdf").write_text(WRONG)
    Path("src/broken.urdf").write_text(BROKEN)
    Path("src/gone.urdf").symlink_to("nowhere")
    arguments = ("--passes", "chaos", "--timeout", "8")  # one job takes all of it, and none else may
    code, found = report(run, *arguments)
    assert code == 2
    assert outcomes(found) == {
        "broken.urdf": "unreadable",
        "crash.urdf": "crashed",
        "deep/er/two.urdf": "converted",
        "deep/warned.urdf": "converted",
        "gone.urdf": "unreadable",
        "hang.urdf": "late",
        "one.urdf": "converted",
        "raise.urdf": "failed",
        "wrong.urdf": "refused",
    }
    messages = {each["source"]: each["message"] for each in found["models"]}
    assert messages["crash.urdf"] == "the process died (exit code 9)"
    assert messages["raise.urdf"].startswith("the pass chaos failed: ZeroDivisionError: no parts; to see it again: ")
    assert Path(messages["raise.urdf"].rpartition(" ")[2]).is_file()
    assert results() == ["deep/er/two.sdf", "deep/warned.sdf", "one.sdf"]
    for name in ("crash", "hang"):
        Path(f"src/{name}.urdf").unlink()
    done = run("batch", "convert", "src", "out", "--to", "sdf", *arguments)
    assert "raise.urdf: failed: the pass chaos failed" in done.stderr
    assert "(5 known from before)" in done.stderr  # a fault is tried again, and so is a file that cannot be read


def test_a_lifted_limit_is_another_request(run: Run, here: Path) -> None:
    assert here.is_dir()
    refused = run("batch", "convert", "src", "out", "--to", "sdf", "--max-tags", "3")
    assert refused.exit_code == 2, refused.stderr
    assert run("batch", "convert", "src", "out", "--to", "sdf").stderr.endswith("3 models: 3 converted\n")


def test_errors_alone_exit_with_1_and_stay_known(run: Run, here: Path) -> None:
    Path("src/wrong.urdf").write_text(WRONG)
    for known in ("", " (4 known from before)"):
        done = run("batch", "convert", "src", "out", "--to", "sdf", "--jobs", "1")
        assert done.exit_code == 1
        assert "wrong.urdf: refused: " in done.stderr
        assert done.stderr.endswith(f"4 models: 3 converted, 1 refused{known}\n")


def test_the_report_has_the_findings(run: Run, here: Path) -> None:
    code, found = report(run)
    assert (code, found["summary"]["converted"]) == (0, 3)
    warned = next(each for each in found["models"] if each["source"] == "deep/warned.urdf")
    assert [each["rule"] for each in warned["diagnostics"]] == ["unknown-element"]
    assert warned["ledger"]["carried"] == 1
    assert report(run, "--deny", "unknown-element")[0] == 1
    assert report(run, "--deny", "unknown-element")[1]["summary"]["refused"] == 1


def test_the_result_of_a_model_that_is_wrong_now_goes(run: Run, here: Path) -> None:
    report(run)
    for name in ("one.urdf", "deep/er/two.urdf"):
        Path("src", name).write_text(WRONG)
    Path("out/one.sdf").write_text("edited by somebody")
    report(run)
    assert results() == ["deep/warned.sdf", "one.sdf"]


def test_ledgers_lie_beside_the_results(run: Run, here: Path) -> None:
    run("batch", "convert", "src", "out", "--to", "sdf")
    assert "(" not in run("batch", "convert", "src", "out", "--to", "sdf", "--ledgers", "--jobs", "1").stderr
    ledger = Path("out/deep/warned.sdf.ledger.json")
    assert [each["rule"] for each in json.loads(ledger.read_text())["entries"]]
    Path("src/deep/warned.urdf").write_text(WRONG)
    run("batch", "convert", "src", "out", "--to", "sdf", "--ledgers", "--jobs", "1")
    assert not ledger.exists()


def test_two_models_for_one_place_keep_their_endings(run: Run, here: Path) -> None:
    report(run)
    sdf = '<sdf version="1.11"><model name="one"><link name="base"/></model></sdf>'
    Path("src/one.sdf").write_text(sdf)
    assert report(run)[0] == 0
    assert results() == ["deep/er/two.sdf", "deep/warned.sdf", "one.sdf.sdf", "one.urdf.sdf"]


def test_places_that_some_file_systems_take_for_one_are_one() -> None:
    made = outputs(("a/Arm.urdf", "a/arm.sdf", "b/arm.urdf.xacro", ".urdf"), "sdf")
    assert sorted(made.values()) == [".urdf.sdf", "a/Arm.urdf.sdf", "a/arm.sdf.sdf", "b/arm.sdf"]


def test_lines_of_the_manifest_that_are_none_are_read_around(run: Run, here: Path) -> None:
    report(run)
    manifest, lines = (
        Path("out/.twinform-batch/manifest.jsonl"),
        [b"{", b"[]", b"\xff", b'{"source": 1}', b"[" * 100_000],
    )
    manifest.write_bytes(b"\n".join([*lines, manifest.read_bytes() + b'{"source": "cut o']))
    assert "(3 known from before)" in run("batch", "convert", "src", "out", "--to", "sdf").stderr


@pytest.mark.parametrize("dest", ["src", ".", "src/one.urdf"])
def test_results_do_not_go_among_the_sources(run: Run, here: Path, dest: str) -> None:
    assert run("batch", "convert", "src", dest, "--to", "sdf").exit_code == 2
    assert run("batch", "convert", "nowhere", "out", "--to", "sdf").exit_code == 2


def test_a_folder_of_results_inside_the_sources_is_no_source(run: Run, here: Path) -> None:
    for _ in range(2):
        assert run("batch", "convert", "src", "src/deep/out", "--to", "sdf").stderr.startswith("3 models: 3 converted")


def test_a_place_that_is_taken_is_reported(run: Run, here: Path) -> None:
    Path("out/one.sdf").mkdir(parents=True)
    code, found = report(run)
    assert (code, outcomes(found)["one.urdf"]) == (2, "unwritten")
    assert outcomes(found)["deep/warned.urdf"] == "converted"


def test_names_are_bytes(run: Run, here: Path) -> None:
    Path("src/öl.urdf").write_text(GOOD)
    Path(os.fsdecode(b"src/\xff.urdf")).write_text(GOOD)
    for _ in range(2):
        code, found = report(run)
        assert (code, found["summary"]["converted"]) == (0, 5)
    assert Path(os.fsdecode(b"out/\xff.sdf")).is_file()


def test_patterns_decide_what_a_model_is(run: Run, here: Path) -> None:
    Path("src/odd.xml").write_text(GOOD)
    found = report(run, "--pattern", "*.xml", "--pattern", "er/*.urdf")[1]
    assert list(outcomes(found)) == ["deep/er/two.urdf", "odd.xml"]
    assert run("batch", "convert", "src", "out", "--to", "sdf", "--pattern", "*.none").stderr == "0 models\n"
