"""`twinform graph`: languages, files, and what it says of broken ones."""

from pathlib import Path

import pytest
from lxml import etree

from .conftest import GOOD, Run


def test_mermaid_is_printed(run: Run, folder: Path) -> None:
    done = run("graph", folder / "good.urdf")
    assert (done.exit_code, done.stderr) == (0, "")
    assert done.stdout.startswith('flowchart TD\n  n0["base"]\n')


@pytest.mark.parametrize(
    ("name", "begin"), [("a.svg", "<svg "), ("a.dot", "digraph "), ("a.mmd", "flowchart "), ("a", "flow")]
)
def test_the_name_of_the_file_says_the_language(run: Run, folder: Path, name: str, begin: str) -> None:
    out = folder / "new" / name
    done = run("graph", folder / "good.urdf", "-o", out)
    assert (done.exit_code, done.output) == (0, "")
    assert out.read_text(encoding="utf-8").startswith(begin)


def test_the_option_wins_over_the_name(run: Run, folder: Path) -> None:
    run("graph", folder / "good.urdf", "-o", folder / "a.txt", "--format", "svg")
    assert str(etree.parse(folder / "a.txt").getroot().tag).endswith("svg")


def test_a_broken_tree_is_drawn_with_its_errors(run: Run, folder: Path) -> None:
    done = run("graph", folder / "wrong.urdf")
    assert done.exit_code == 1
    assert "[" in done.stderr
    assert ":::missing" in done.stdout


@pytest.mark.parametrize("name", ["broken.urdf", "nothing.urdf"])
def test_what_cannot_be_read_has_no_graph(run: Run, folder: Path, name: str) -> None:
    done = run("graph", folder / name, "-o", folder / "out.svg")
    assert done.exit_code == 2
    assert "error" in done.stderr
    assert not (folder / "out.svg").exists()


def test_the_input_is_not_written_over(run: Run, folder: Path) -> None:
    done = run("graph", folder / "good.urdf", "-o", folder / "good.urdf")
    assert done.exit_code == 2
    assert (folder / "good.urdf").read_text() == GOOD


def test_two_inputs_are_refused(run: Run, folder: Path) -> None:
    assert run("graph", folder / "good.urdf", folder / "good.urdf").exit_code == 2


def test_more_than_mermaid_draws_is_said(run: Run) -> None:
    links = "".join(f'<link name="{i}"/>' for i in range(300))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="0"/><child link="{i}"/></joint>' for i in range(1, 300)
    )
    done = run("graph", "-", text=f'<robot name="r">{links}{joints}</robot>')
    assert done.exit_code == 0
    assert "--format svg has no such limit" in done.stderr


def test_included_models_are_read_on_request(run: Run, folder: Path) -> None:
    (folder / "crate").mkdir()
    (folder / "crate" / "model.config").write_text('<model><name>crate</name><sdf version="1.9">m.sdf</sdf></model>')
    (folder / "crate" / "m.sdf").write_text('<sdf version="1.9"><model name="crate"><link name="wood"/></model></sdf>')
    world = folder / "w.sdf"
    world.write_text('<sdf version="1.9"><world name="w"><include><uri>model://crate</uri></include></world></sdf>')
    assert "wood" not in run("graph", world, "--path", folder).stdout
    assert "wood" in run("graph", world, "--path", folder, "--expand-includes").stdout
