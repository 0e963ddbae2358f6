"""`twinform batch convert --model-folders`."""

from pathlib import Path

import pytest

from tests.unit.compiler.batch.test_model_folders import FILES
from tests.write_files import write_files

from .conftest import Run


@pytest.fixture
def crate(tmp_path: Path) -> Path:
    """A model folder."""
    return write_files(tmp_path / "models/crate", FILES)


@pytest.mark.slow
def test_a_batch_is_done_again_where_a_mesh_has_changed(
    run: Run, crate: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    command = ("batch", "convert", "models", "out", "--to", "sdf", "--model-folders", "--sdf-version", "1.9")
    assert run(*command).exit_code == 0
    written = {path.relative_to("out").as_posix() for path in Path("out").rglob("*") if path.is_file()}
    assert {"crate/model.config", "crate/model.sdf", "crate/meshes/crate.stl"} < written
    assert run("check", "out/crate", "--strict").exit_code == 0
    (crate / "meshes/crate.stl").write_bytes(b"solid new")
    (crate / "materials/textures/crate.png").unlink()
    done = run(*command)
    assert "1 known from before" in done.output
    assert Path("out/crate/meshes/crate.stl").read_bytes() == b"solid new"
    assert not Path("out/crate/materials/textures/crate.png").exists()


@pytest.mark.slow
def test_without_the_option_models_come_alone(
    run: Run, crate: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert crate.is_dir()
    assert run("batch", "convert", "models", "out", "--to", "sdf").exit_code == 0
    assert not Path("out/crate/model.config").exists()
