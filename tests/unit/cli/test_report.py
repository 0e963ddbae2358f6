"""`twinform report`: files, forms, exit codes."""

from pathlib import Path

import pytest

from .conftest import GOOD, Run

_HEAVIER = GOOD.replace('<mass value="1"/>', '<mass value="2"/>')


def test_a_page_by_default(run: Run, folder: Path) -> None:
    out = folder / "new/report.html"
    done = run("report", folder / "good.urdf", "-o", out, "--no-view")
    assert (done.exit_code, done.output) == (0, "")
    text = out.read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "<iframe" not in text


def test_the_view_is_in_the_page(run: Run, folder: Path) -> None:
    out = folder / "report.html"
    done = run("report", folder / "good.urdf", "-o", out)
    assert done.exit_code == 0
    assert "<iframe" in out.read_text(encoding="utf-8") or "pip install 'twinform[view]'" in done.stderr


def test_the_name_or_the_option_says_the_form(run: Run, folder: Path) -> None:
    assert run("report", folder / "good.urdf", "-o", folder / "a.md").exit_code == 0
    assert (folder / "a.md").read_text(encoding="utf-8").startswith("## one \\(good\\.urdf\\)\n")
    assert run("report", folder / "good.urdf", "--format", "md").stdout.startswith("## one \\(good\\.urdf\\)\n")


def test_two_files_are_compared(run: Run, folder: Path) -> None:
    (folder / "heavier.urdf").write_text(_HEAVIER)
    done = run("report", folder / "good.urdf", folder / "heavier.urdf", "--format", "md")
    assert done.exit_code == 0
    assert "different robots: 1 difference" in done.stdout
    assert "by 1 kg, 50 \\%" in done.stdout
    same = run("report", folder / "good.urdf", folder / "heavier.urdf", "--format", "md", "--tolerance", "0.6")
    assert "the same robot" in same.stdout


def test_standard_input_is_read_once_for_everything(run: Run, folder: Path) -> None:
    done = run("report", "-", folder / "good.urdf", "--format", "md", text=_HEAVIER)
    assert "different robots: 1 difference" in done.stdout


def test_a_file_with_errors_has_a_report_and_ends_with_1(run: Run, folder: Path) -> None:
    done = run("report", folder / "wrong.urdf", "-o", folder / "report.html")
    assert done.exit_code == 1
    assert "no 3D view: the file has errors" in (folder / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["broken.urdf", "nothing.urdf"])
def test_what_cannot_be_read_has_none(run: Run, folder: Path, name: str) -> None:
    done = run("report", folder / "good.urdf", folder / name, "-o", folder / "report.html")
    assert done.exit_code == 2
    assert "error" in done.stderr
    assert not (folder / "report.html").exists()


def test_an_input_is_not_written_over(run: Run, folder: Path) -> None:
    done = run("report", folder / "good.urdf", "-o", folder / "good.urdf", "--no-view")
    assert done.exit_code == 2
    assert (folder / "good.urdf").read_text() == GOOD


def test_three_files_are_refused(run: Run, folder: Path) -> None:
    assert run("report", *[folder / "good.urdf"] * 3).exit_code == 2
