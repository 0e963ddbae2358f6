from pathlib import Path

import pytest

from tests.unit.cli.conftest import Run

_EXAMPLES = Path(__file__).parents[3] / "examples"
WORLD = _EXAMPLES / "warehouse.sdf"
BAD = (
    '<sdf version="1.11"><world name="w"><model name="good"><link name="a"/></model><model name="bad"><link name="a">'
    '<inertial auto="true"/></link></model></world></sdf>'
)


def test_a_world_is_split_into_a_folder(run: Run, tmp_path: Path) -> None:
    done = run(
        "convert", WORLD, "--split", "--to", "urdf", "-o", tmp_path / "out", "--ledger", tmp_path / "ledger.json"
    )
    assert done.exit_code == 0
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"warehouse.sdf", "ground_plane.sdf", "shelf.urdf", "lift_cart.urdf"}
    assert (tmp_path / "ledger.json").exists()
    assert "4 files: expressed" in done.stderr


def test_nothing_is_written_where_one_model_fails(run: Run, tmp_path: Path) -> None:
    world = tmp_path / "world.sdf"
    world.write_text(BAD)
    denied = ("--to", "urdf", "--deny", "kept-as-sdf")
    assert run("convert", world, "--split", "-o", tmp_path / "out", *denied).exit_code == 1
    assert not (tmp_path / "out").exists()


def test_nothing_is_written_where_one_file_cannot_be(run: Run, tmp_path: Path) -> None:
    (tmp_path / "out/shelf.sdf").mkdir(parents=True)
    assert run("convert", WORLD, "--split", "-o", tmp_path / "out").exit_code == 2
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["shelf.sdf"]


@pytest.mark.parametrize(
    "options", [[], ["-o", "-"], ["-o", "out", "--to", "json"], ["-o", "out", "--model", "shelf"], ["-o", "out", WORLD]]
)
def test_what_contradicts_splitting_is_wrong_usage(run: Run, options: list[str | Path]) -> None:
    assert run("convert", WORLD, "--split", *options).exit_code == 2


def test_expanded_includes_are_split_too(run: Run, tmp_path: Path) -> None:
    assert run("convert", WORLD, "--split", "--expand-includes", "-o", tmp_path).exit_code == 0
    assert (tmp_path / "crate_1.sdf").exists()


def test_a_world_of_includes_alone_says_what_would_split_them(run: Run, tmp_path: Path) -> None:
    include = "<include><uri>https://fuel.gazebosim.org/1.0/openrobotics/models/cart</uri></include>"
    (tmp_path / "w.sdf").write_text(f'<sdf version="1.9"><world name="w">{include}</world></sdf>')
    done = run("convert", tmp_path / "w.sdf", "--split", "-o", tmp_path / "out")
    assert done.exit_code == 0
    assert "the file has no model of its own; --expand-includes also writes the models that it includes" in done.stderr
    assert "1 file: expressed" in done.stderr
