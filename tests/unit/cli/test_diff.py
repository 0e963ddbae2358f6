import json
from pathlib import Path

import pytest

from .conftest import Run

_ARM = Path(__file__).parents[3] / "examples/arm.urdf"


@pytest.fixture
def heavier(tmp_path: Path) -> Path:
    """The arm with another mass."""
    path = tmp_path / "heavier.urdf"
    path.write_text(_ARM.read_text().replace('<mass value="4"/>', '<mass value="5"/>'))
    return path


def test_the_exit_code_is_the_verdict(run: Run, folder: Path, heavier: Path):
    assert run("diff", _ARM, _ARM).exit_code == 0
    assert run("diff", _ARM, heavier).exit_code == 1
    assert run("diff", _ARM, folder / "missing.urdf").exit_code == 2
    assert run("diff", folder / "wrong.urdf", _ARM).exit_code == 2


def test_text_reports_where_what_and_by_how_much(run: Run, heavier: Path):
    done = run("diff", _ARM, heavier)
    line = f"  {_ARM}:25, {heavier}:25: difference: inertial/mass is 4 kg, and 5 kg (by 1 kg, 20 %)"
    assert done.stdout.splitlines() == ["link 'base_link'", line]
    assert done.stderr == "different robots: 1 difference, 0 notes\n"


def test_json_has_every_key(run: Run, heavier: Path):
    found = json.loads(run("diff", "--format", "json", _ARM, heavier).stdout)
    assert found.keys() == {"a", "b", "same", "tolerance", "items"}
    (item,) = found["items"]
    assert {key: item[key] for key in ("severity", "group", "name", "aspect")} == {
        "severity": "difference",
        "group": "link",
        "name": "base_link",
        "aspect": "inertial/mass",
    }
    assert item["a"] == {
        "value": "4 kg",
        "file": str(_ARM),
        "line": 25,
        "path": "/robot[@name='arm']/link[@name='base_link']/inertial",
    }
    assert (item["absolute"], item["relative"], item["unit"]) == (1.0, 0.2, "kg")


def test_what_is_within_the_tolerance_is_the_same(run: Run, heavier: Path):
    assert run("diff", "--tolerance", "0.3", _ARM, heavier).exit_code == 0


_CARRIED = Path(__file__).parents[2] / "cases/diff/carried_closed_loop"


def test_what_others_skip_counts_unless_the_option_or_the_project_says_no(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    files = _CARRIED / "a.sdf", _CARRIED / "b.urdf"
    assert run("diff", *files).stderr == "different robots: 0 differences, 1 carried, 0 notes\n"
    assert run("diff", *files, "--carriers").exit_code == 0
    (tmp_path / "twinform.toml").write_text("carriers = true\n")  # which is about conversions
    assert run("diff", *files).exit_code == 1
    (tmp_path / "twinform.toml").write_text("read-carriers = true\n")
    assert run("diff", *files).exit_code == 0
    assert run("diff", *files, "--no-carriers").exit_code == 1


def test_errors_of_both_files_are_reported_on_stderr(run: Run, folder: Path):
    done = run("diff", folder / "wrong.urdf", folder / "broken.urdf")
    assert done.exit_code == 2
    assert done.stdout == ""
    assert "wrong.urdf:3:4: error" in done.stderr
    assert "broken.urdf" in done.stderr


@pytest.mark.parametrize("count", [1, 3])
def test_two_files_are_compared(run: Run, count: int):
    assert run("diff", *[_ARM] * count).exit_code == 2


def test_standard_input_may_be_one_of_them(run: Run, heavier: Path):
    done = run("diff", "-", heavier, text=_ARM.read_text())
    assert done.exit_code == 1
    assert "<stdin>:25" in done.stdout
