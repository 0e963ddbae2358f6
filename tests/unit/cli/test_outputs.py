"""No output goes over a file that is read, or over another output; all of one call appear together or not at all."""

import os
from pathlib import Path

import pytest

from .conftest import GOOD, Run

WORLD = """<sdf version="1.11"><world name="w">
<model name="one"><link name="l"/></model><model name="two"><link name="l"/></model></world></sdf>"""


@pytest.fixture
def here(here: Path) -> Path:
    """The folder with the files, as the current one, and other names for one of them."""
    Path("soft.sdf").symlink_to("good.urdf")
    Path("hard.sdf").hardlink_to("good.urdf")
    Path("sub").mkdir()
    Path("linked").symlink_to("sub")
    Path("w.sdf").write_text(WORLD)
    Path("twinform.toml").write_text("carriers = true\n")
    return here


def tree(folder: Path) -> dict[str, str]:
    """All files with their texts."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_text() for path in files}


OVER_AN_INPUT = {
    "the result": "good.urdf -o good.urdf",
    "the result by another path": "good.urdf -o sub/../good.urdf",
    "the result by a symbolic link": "good.urdf -o soft.sdf",
    "the result by a hard link": "good.urdf -o hard.sdf",
    "an input by a link": "soft.sdf --to sdf -o good.urdf",
    "the ledger": "good.urdf -o out.sdf --ledger good.urdf",
    "the ledger without a result": "good.urdf --ledger ./good.urdf",
    "the world": "good.urdf -o out.sdf --world good.urdf",
    "the bridge": "good.urdf -o out.sdf --bridge hard.sdf",
    "the configuration": "good.urdf -o out.sdf --ledger twinform.toml",
    "another input": "good.urdf warned.urdf w.sdf --to sdf -o .",
    "a split": "w.sdf --split -o .",
    "the ledger of a split": "w.sdf --split -o out --ledger w.sdf",
}
OVER_ANOTHER = {
    "result and ledger": "good.urdf -o out.sdf --ledger out.sdf",
    "result and world": "good.urdf -o out.sdf --world ./out.sdf",
    "result and bridge": "good.urdf -o out.sdf --bridge out.sdf",
    "world and bridge": "good.urdf -o out.sdf --world w2.sdf --bridge w2.sdf",
    "by a linked folder": "good.urdf -o sub/out.sdf --ledger linked/out.sdf",
    "where case does not count": "good.urdf -o out.sdf --ledger OUT.SDF",
    "one pipe for two texts": "good.urdf -o pipe --ledger pipe",
    "a ledger and a file of a split": "w.sdf --split -o out --ledger out/one.sdf",
    "a file of a pass": "good.urdf -o bridge.yaml --to sdf --passes bridge-config{file=bridge.yaml}",
    "a file of two passes": "good.urdf -o out.sdf --passes bridge-config{file=b.yaml},bridge-config{file=b.yaml}",
    "an input in its place": "good.urdf --in-place --ledger good.urdf",
}


@pytest.mark.parametrize("command", OVER_AN_INPUT.values(), ids=OVER_AN_INPUT.keys())
def test_no_input_is_written_over(run: Run, here: Path, command: str) -> None:
    before = tree(here)
    done = run("convert", *command.split())
    assert (done.exit_code, done.stdout, tree(here)) == (2, "", before)
    assert "would write over" in done.stderr


@pytest.mark.parametrize("command", OVER_ANOTHER.values(), ids=OVER_ANOTHER.keys())
def test_no_output_is_written_over_another(run: Run, here: Path, command: str) -> None:
    os.mkfifo("pipe")
    before = tree(here)
    done = run("convert", *command.split())
    assert (done.exit_code, done.stdout, tree(here)) == (2, "", before)
    assert "name the same file" in done.stderr


def test_standard_input_is_an_input(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("twinform.cli.inputs.InputSource.path", Path("good.urdf"))  # where /dev/stdin leads
    done = run("convert", "-", "-o", "good.urdf", text=GOOD)
    assert (done.exit_code, Path("good.urdf").read_text()) == (2, GOOD)


def test_inputs_whose_results_differ_in_case_only_are_refused(run: Run, here: Path) -> None:
    Path("sub/Good.urdf").write_text(GOOD)
    done = run("convert", "good.urdf", "sub/Good.urdf", "-o", "out/")
    assert (done.exit_code, "would all be written to" in done.stderr) == (2, True)


def test_a_device_takes_several_texts(run: Run, here: Path) -> None:
    assert run("convert", "good.urdf", "-o", "/dev/null", "--ledger", "/dev/null", "--to", "sdf").exit_code == 0


TO_URDF = ("--to", "urdf", "-o")
READ: dict[str, tuple[str, ...]] = {
    "part.sdf": ("around.sdf", *TO_URDF, "out.urdf", "--ledger", "part.sdf"),
    "crate/model.config": ("around.sdf", *TO_URDF, "crate/model.config"),
    "gripper.urdf": ("good.urdf", *TO_URDF, "gripper.urdf", "--passes", "attach{file=gripper.urdf to=base}"),
    "part.xacro": ("r.urdf.xacro", "-o", "out.sdf", "--ledger", "part.xacro"),
    "box.stl": ("meshed.urdf", *TO_URDF, "box.stl", "--passes", "check-inertia{meshes=true}"),
}


@pytest.mark.parametrize("name", READ)
def test_no_file_that_is_read_on_the_way_is_written_over(run: Run, here: Path, name: str) -> None:
    includes = "<include><uri>part.sdf</uri></include><include><uri>crate</uri><name>c</name></include>"
    Path("around.sdf").write_text(f'<sdf version="1.11"><model name="m"><link name="l"/>{includes}</model></sdf>')
    model = '<sdf version="1.11"><model name="p"><link name="l"/></model></sdf>'
    Path("part.sdf").write_text(model)
    Path("crate").mkdir()
    Path("crate/model.config").write_text('<model><name>c</name><sdf version="1.11">model.sdf</sdf></model>')
    Path("crate/model.sdf").write_text(model)
    Path("gripper.urdf").write_text(GOOD.replace("base", "palm"))
    xacro = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    Path("part.xacro").write_text(f'<robot {xacro}><link name="a"/></robot>')
    Path("r.urdf.xacro").write_text(f'<robot {xacro} name="r"><xacro:include filename="part.xacro"/></robot>')
    Path("box.stl").write_text("solid box\nendsolid box\n")
    mesh = '<collision><geometry><mesh filename="box.stl"/></geometry></collision></link>'
    Path("meshed.urdf").write_text(GOOD.replace("</link>", mesh))
    before = tree(here)
    done = run("convert", *READ[name])
    assert (done.exit_code, tree(here)) == (2, before), done.output
    assert f"would write over {name}" in done.stderr


TOGETHER = {
    "result": "good.urdf -o taken/out.sdf --ledger ledger.json --world world.sdf --bridge bridge.yaml",
    "ledger": "good.urdf -o out.sdf --ledger taken/ledger.json --world world.sdf --bridge bridge.yaml",
    "world": "good.urdf -o out.sdf --ledger ledger.json --world taken/world.sdf --bridge bridge.yaml",
    "bridge": "good.urdf -o new/out.sdf --ledger ledger.json --world world.sdf --bridge taken/bridge.yaml",
    "ledger of a split": "w.sdf --split -o out --ledger taken/ledger.json",
    "file of a pass": "good.urdf -o out.sdf --ledger ledger.json --passes bridge-config{file=taken/bridge.yaml}",
}


@pytest.mark.parametrize("command", TOGETHER.values(), ids=TOGETHER.keys())
def test_where_one_file_cannot_be_written_none_is(run: Run, here: Path, command: str) -> None:
    Path("taken").write_text("a file")
    before = tree(here)
    done = run("convert", *command.split())
    assert (done.exit_code, done.stdout) == (2, "")
    assert "cannot write taken/" in done.stderr
    assert tree(here) == before
    assert not Path("new").exists()


def test_where_no_world_can_be_made_nothing_is_written(run: Run, here: Path) -> None:
    before = tree(here)
    done = run("convert", "w.sdf", "--to", "sdf", "-o", "out.sdf", "--ledger", "l.json", "--world", "world.sdf")
    assert (done.exit_code, tree(here)) == (1, before)
    assert "[nothing-to-add-to]" in done.stderr


def test_inputs_are_replaced_in_place(run: Run, here: Path) -> None:
    Path("soft.sdf").unlink()
    done = run("convert", "good.urdf", "w.sdf", "--in-place", "--passes", "prefix-names{prefix=x_}")
    assert done.exit_code == 0, done.stderr
    assert 'name="x_base"' in Path("good.urdf").read_text()
    assert 'name="x_l"' in Path("w.sdf").read_text()
    assert Path("hard.sdf").read_text() == GOOD  # another file from now on


@pytest.mark.parametrize(
    ("command", "complaint"),
    [
        ("good.urdf --in-place -o out.urdf", "--in-place and -o contradict each other"),
        ("good.urdf --in-place --to sdf", "good.urdf stays urdf in its place; leave --to out"),
        ("r.urdf.xacro --in-place", "would be replaced by what it expands to"),
        ("- --in-place", "<stdin> is no file"),
        ("w.sdf --split --in-place", "--split needs -o DIRECTORY"),
    ],
)
def test_what_has_no_place_is_wrong_usage(run: Run, here: Path, command: str, complaint: str) -> None:
    before = tree(here)
    done = run("convert", *command.split(), text=GOOD)
    assert (done.exit_code, tree(here)) == (2, before)
    assert complaint in done.stderr


def test_nothing_is_replaced_where_one_input_is_wrong(run: Run, here: Path) -> None:
    before = tree(here)
    assert run("convert", "good.urdf", "wrong.urdf", "--in-place", "--passes", "prefix-names{prefix=x_}").exit_code == 1
    assert tree(here) == before
