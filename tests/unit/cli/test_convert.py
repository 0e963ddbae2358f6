import json
import re
from pathlib import Path

import pytest
from lxml import etree

import twinform

from .conftest import GOOD, Run

SUMMARY = re.compile(r"^expressed \d+, carried \d+, approximated \d+, dropped \d+$", re.MULTILINE)
SDF = '<sdf version="1.9"><model name="one"><link name="base"/></model></sdf>'


def root(text: str | bytes) -> str:
    return str(etree.fromstring(text if isinstance(text, bytes) else text.encode()).tag)


def test_text_goes_to_stdout_and_the_summary_to_stderr(run: Run, folder: Path) -> None:
    done = run("convert", folder / "good.urdf")
    assert done.exit_code == 0
    assert root(done.stdout_bytes) == "sdf"
    assert SUMMARY.search(done.stderr)


@pytest.mark.parametrize(
    ("arguments", "text", "tag"),
    [([], GOOD, "sdf"), ([], SDF, "robot"), (["--to", "urdf"], GOOD, "robot"), (["--to", "sdf"], SDF, "sdf")],
)
def test_target_is_the_other_format_or_the_one_asked_for(run: Run, arguments: list[str], text: str, tag: str) -> None:
    done = run("convert", "-", *arguments, text=text)
    assert done.exit_code == 0, done.stderr
    assert root(done.stdout_bytes) == tag


@pytest.mark.parametrize(
    ("name", "tag"), [("out.sdf", "sdf"), ("out.world", "sdf"), ("out.urdf", "robot"), ("out.xml", "mujoco")]
)
def test_suffix_of_the_output_is_a_target(run: Run, folder: Path, name: str, tag: str) -> None:
    done = run("convert", folder / "good.urdf", "-o", folder / name)
    assert (done.exit_code, done.stdout) == (0, "")
    assert root((folder / name).read_bytes()) == tag


def test_json_loads_back(run: Run, folder: Path) -> None:
    file = folder / "out.json"
    assert run("convert", folder / "good.urdf", "-o", file).exit_code == 0
    assert twinform.load(file) == twinform.load(folder / "good.urdf")
    assert root(run("convert", file, "--to", "sdf").stdout_bytes) == "sdf"
    assert run("convert", file).exit_code == 2


@pytest.mark.parametrize(("name", "code"), [("wrong", 1), ("broken", 2), ("missing", 2)])
def test_nothing_is_written_where_there_is_an_error(run: Run, folder: Path, name: str, code: int) -> None:
    out, ledger = folder / "out.sdf", folder / "ledger.json"
    done = run("convert", folder / f"{name}.urdf", "-o", out, "--ledger", ledger)
    assert (done.exit_code, done.stdout) == (code, "")
    assert ": error: " in done.stderr
    assert not out.exists()
    assert not ledger.exists()


def test_an_old_output_survives_an_error(run: Run, folder: Path) -> None:
    out = folder / "out.sdf"
    out.write_text("old")
    run("convert", folder / "wrong.urdf", "-o", out)
    assert out.read_text() == "old"


def test_warnings_are_on_stderr_and_errors_when_strict(run: Run, folder: Path) -> None:
    done = run("convert", folder / "warned.urdf")
    assert done.exit_code == 0
    assert "[unknown-element]" in done.stderr
    assert run("convert", "--strict", folder / "warned.urdf").exit_code == 1


def test_several_inputs_go_into_a_directory(run: Run, folder: Path) -> None:
    out = folder / "new" / "models"
    done = run("convert", folder / "good.urdf", folder / "warned.urdf", "-o", out)
    assert done.exit_code == 0
    assert sorted(file.name for file in out.iterdir()) == ["good.sdf", "warned.sdf"]
    assert f"{folder / 'good.urdf'}: expressed " in done.stderr


def test_all_of_several_inputs_are_written_or_none(run: Run, folder: Path) -> None:
    done = run("convert", folder / "good.urdf", folder / "wrong.urdf", folder / "warned.urdf", "-o", folder / "out")
    assert (done.exit_code, (folder / "out").exists()) == (1, False)
    assert "nothing is written: 1 of 3 inputs could not be converted" in done.stderr
    assert "expressed" not in done.stderr


def test_one_input_goes_into_a_directory_that_is_there(run: Run, folder: Path) -> None:
    source = (folder / "good.urdf").rename(folder / "arm.urdf.xacro")
    (folder / "out").mkdir()
    assert run("convert", source, "-o", folder / "out").exit_code == 0
    assert (folder / "out" / "arm.sdf").exists()


@pytest.mark.parametrize(("target", "name"), [("sdf", "yard.world"), ("urdf", "yard.urdf")])
def test_a_world_in_a_directory_keeps_its_ending_as_long_as_it_is_sdf(
    run: Run, folder: Path, target: str, name: str
) -> None:
    source, out = folder / "yard.world", folder / "out"
    source.write_text(run("convert", folder / "good.urdf").stdout)
    out.mkdir()
    assert run("convert", source, "--to", target, "-o", out).exit_code == 0
    assert [file.name for file in out.iterdir()] == [name]


def test_two_inputs_for_one_output_are_refused(run: Run, folder: Path) -> None:
    (folder / "other").mkdir()
    (folder / "other" / "good.urdf").write_text(GOOD)
    done = run("convert", folder / "good.urdf", folder / "other/good.urdf", "-o", folder / "out")
    assert done.exit_code == 2
    assert "would all be written to" in done.stderr
    assert not (folder / "out").exists()


def test_ledger_is_json(run: Run, folder: Path) -> None:
    ledger = folder / "ledger.json"
    assert run("convert", folder / "good.urdf", "--ledger", ledger).exit_code == 0
    assert set(json.loads(ledger.read_text())) == {"expressed", "entries"}


def test_version_of_sdf(run: Run, folder: Path) -> None:
    done = run("convert", folder / "good.urdf", "--sdf-version", "1.9")
    assert etree.fromstring(done.stdout_bytes).get("version") == "1.9"


def test_passes_run_and_report(run: Run, folder: Path) -> None:
    source = folder / "rod.urdf"
    source.write_text(GOOD.replace('ixx="1"', 'ixx="0"'))
    assert "[indefinite-inertia]" in run("convert", source, "--passes", "check-inertia").stderr
    assert "[indefinite-inertia]" not in run("convert", source).stderr


def test_a_pass_does_not_repeat_what_check_has_reported(run: Run, folder: Path) -> None:
    source = folder / "heavy.urdf"
    source.write_text(GOOD.replace('ixx="1"', 'ixx="5"'))
    assert run("convert", source, "--passes", "check-inertia").stderr.count("[impossible-inertia]") == 1


def test_pipeline_is_printed_and_nothing_is_converted(run: Run, folder: Path) -> None:
    out = folder / "out.sdf"
    done = run("convert", folder / "good.urdf", "-o", out, "--passes", " check-inertia{}", "--print-pipeline")
    assert done.exit_code == 0
    assert done.stdout.startswith("check-inertia,")
    assert not out.exists()
    assert run("convert", folder / "broken.urdf", "--print-pipeline").exit_code == 2


def test_ir_is_dumped_after_a_pass(run: Run, folder: Path) -> None:
    arguments = ["convert", folder / "good.urdf", "--passes", "check-inertia", "--dump-ir-after"]
    done = run(*arguments, "check-inertia")
    dump = done.stderr.split("after check-inertia\n")[1]
    document, _ = json.JSONDecoder().raw_decode(dump)
    assert document["format"] == "urdf"
    done = run(*arguments, "fill-limits")
    assert (done.exit_code, done.stdout) == (2, "")
    assert "no such pass ran; there were check-inertia, " in done.stderr


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["a.urdf", "b.urdf"], "several inputs need -o DIRECTORY"),
        (["a.urdf", "b.urdf", "-o", "good.urdf"], "is a file"),
        (["a.urdf", "b.urdf", "-o", "out", "--ledger", "l.json"], "--ledger takes one input"),
        (["good.urdf", "--to", "usd"], "usd"),
        (["good.urdf", "--sdf-version", "9.9"], "SDF has no version '9.9'"),
        (["good.urdf", "--to", "urdf", "--sdf-version", "1.9"], "--sdf-version is for --to sdf"),
        (["good.urdf", "--passes", "chek-inertia"], "did you mean check-inertia?\n  chek-inertia\n  ^"),
        (["good.urdf", "-o", "good.urdf/out.sdf"], "cannot write"),
    ],
)
def test_wrong_usage_exits_2(
    run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], complaint: str
) -> None:
    monkeypatch.chdir(folder)
    done = run("convert", *arguments)
    assert (done.exit_code, done.stdout) == (2, "")
    assert complaint in done.stderr
    assert sorted(file.name for file in folder.iterdir()) == ["broken.urdf", "good.urdf", "warned.urdf", "wrong.urdf"]
