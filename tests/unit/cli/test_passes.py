import json
import tomllib
from pathlib import Path

import pytest

from twinform.passes import parse_pipeline, registered_passes
from twinform.passes.framework.pipeline_text import parse_tables

from .conftest import Run


def test_all_passes_are_listed_with_options_defaults_and_an_example(run: Run) -> None:
    text = run("passes").stdout
    assert [line for line in text.splitlines() if not line.startswith(" ")] == list(registered_passes())
    assert text.count("\n    example: ") == len(registered_passes())
    assert "\ncheck-inertia\n    Find masses" in f"\n{text}"
    assert "    options: effort, velocity, lower, upper, " in text
    assert ", joints=[*]\n" in text


def test_the_list_is_there_for_programs(run: Run) -> None:
    found = json.loads(run("passes", "--format", "json").stdout)
    assert [each["name"] for each in found["passes"]] == list(registered_passes())
    (only,) = json.loads(run("passes", "check-inertia", "--format", "json").stdout)["passes"]
    assert (only["owner"], only["example"]) == ("twinform", registered_passes()["check-inertia"].load().example)
    assert only["options"][0]["default"] == 1e-6
    assert only["options"][0]["required"] is False


def test_page_has_options_types_defaults_and_an_example(run: Run) -> None:
    page = run("passes", "fill-limits").stdout
    assert page.startswith("fill-limits (from twinform)\n")
    assert "  effort: number (default: not set)\n      The greatest effort, in N m or N.\n" in page
    assert "  joints: list of text (default: [*])\n" in page
    assert "Example\n  fill-limits{" in page
    assert "eps: number (default: 1e-06)" in run("passes", "check-inertia").stdout


def test_an_unknown_pass_exits_2(run: Run) -> None:
    done = run("passes", "fill-limit")
    assert done.exit_code == 2
    assert "did you mean fill-limits?" in done.stderr


def test_pipelines_of_the_project_are_listed(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("twinform.toml").write_text("[pipelines]\nrobot = 'check-inertia{eps=1e-6},fill-limits{effort=1}'")
    assert run("passes").stdout.endswith("twinform.toml\n@robot\n    check-inertia,fill-limits{effort=1}\n")
    found = json.loads(run("passes", "--format", "json").stdout)
    assert found["pipelines"] == [{"name": "robot", "pipeline": "check-inertia,fill-limits{effort=1}"}]
    assert "pipelines of" not in run("passes", "--no-config").stdout


def test_a_pipeline_is_printed_as_a_table(run: Run) -> None:
    text = "check-inertia,fill-limits{effort=100}"
    printed = run("passes", "--table", text).stdout
    assert parse_tables(tomllib.loads(printed)["pipelines"]["mine"]) == parse_pipeline(text)
    assert run("passes", "--table", "check-inerta").exit_code == 2
