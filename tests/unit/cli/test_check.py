import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from twinform.cli import main

from .conftest import GOOD, Run


@pytest.mark.parametrize(
    ("names", "code"),
    [
        (["good"], 0),
        (["warned"], 0),
        (["wrong"], 1),
        (["broken"], 2),
        (["missing"], 2),
        (["good", "wrong"], 1),
        (["wrong", "broken", "good"], 2),
    ],
)
def test_exit_code_is_that_of_the_worst_file(run: Run, folder: Path, names: list[str], code: int) -> None:
    assert run("check", *(folder / f"{name}.urdf" for name in names)).exit_code == code


def test_strict_refuses_unknown_names(run: Run, folder: Path) -> None:
    assert run("check", "--strict", folder / "warned.urdf").exit_code == 1


@pytest.mark.parametrize("engine", ["libxml2", "xmlschema"])
def test_both_engines_agree(run: Run, folder: Path, engine: str) -> None:
    assert run("check", "--engine", engine, folder / "good.urdf").exit_code == 0
    assert run("check", "--engine", engine, folder / "wrong.urdf").exit_code == 1


def test_findings_are_on_stdout_and_the_summary_on_stderr(run: Run, folder: Path) -> None:
    file = folder / "warned.urdf"
    done = run("check", file, folder / "broken.urdf")
    assert done.stdout.startswith(f"{file}:2: warning: ")
    assert "[unknown-element]\n    at /" in done.stdout
    assert done.stderr == "2 files: 1 error, 1 warning, 0 notes; 1 could not be read\n"


def test_json_has_a_row_for_every_file(run: Run, folder: Path) -> None:
    files = [folder / "good.urdf", folder / "wrong.urdf", folder / "missing.urdf"]
    rows = json.loads(run("check", "--format", "json", *files).stdout)["files"]
    assert [row["path"] for row in rows] == [str(file) for file in files]
    assert [bool(row["diagnostics"]) for row in rows] == [False, True, True]


@pytest.mark.parametrize(("style", "start"), [("sarif", "{\n"), ("github", "::error file=")])
def test_other_formats(run: Run, folder: Path, style: str, start: str) -> None:
    done = run("check", "--format", style, folder / "wrong.urdf")
    assert done.exit_code == 1
    assert done.stdout.startswith(start)


def test_standard_input(run: Run) -> None:
    done = run("check", "-", "--format", "json", text=GOOD)
    assert json.loads(done.stdout) == {"files": [{"path": "<stdin>", "diagnostics": []}]}


def test_colour_is_for_terminals_without_no_color(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def output(*, terminal: bool) -> str:
        arguments = ["check", str(folder / "warned.urdf")]
        return CliRunner().invoke(main, arguments, color=terminal).stdout

    monkeypatch.delenv("NO_COLOR", raising=False)
    assert "\x1b[" in output(terminal=True)
    assert "\x1b[" not in output(terminal=False)
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[" not in output(terminal=True)
