"""Model folders in a batch: what lies beside a model comes along, and nothing of anybody else."""

import re
from pathlib import Path

import pytest

from tests.unit.compiler.packaging.robots import PNG, STL
from tests.write_files import write_files
from twinform.compiler.batch import jobs
from twinform.compiler.batch.jobs import FolderTooLargeError, folder_files
from twinform.compiler.request import ConversionRequest

CONFIG = b"""<?xml version="1.0"?>
<model>
  <name>Crate</name> <!-- of wood -->
  <sdf version="1.4">model-1_4.sdf</sdf>
  <sdf version="1.6">model.sdf</sdf>
</model>
"""
SDF = b'<sdf version="%s"><model name="crate"><link name="l"/></model></sdf>'
FILES = {
    "model.config": CONFIG,
    "model.sdf": SDF % b"1.6",
    "model-1_4.sdf": SDF % b"1.4",
    "meshes/crate.stl": STL,
    "materials/textures/crate.png": PNG,
    ".git/config": b"",
    "inner/model.config": CONFIG,
    "inner/notes.txt": b"of another folder",
}
TO_SDF = ConversionRequest(to="sdf")


@pytest.fixture
def crate(tmp_path: Path) -> Path:
    """A model folder."""
    return write_files(tmp_path / "models/crate", FILES)


def _rows(config: bytes) -> list[tuple[str, str]]:
    return re.findall(r'<sdf version="(.*?)">(.*?)<', config.decode())


def test_all_but_models_and_hidden_files_comes_along(crate: Path) -> None:
    files = folder_files(crate / "model.sdf", "crate/model.sdf", TO_SDF, "1.6")
    assert set(files) == {"crate/model.config", "crate/meshes/crate.stl", "crate/materials/textures/crate.png"}
    assert files["crate/meshes/crate.stl"] == STL


def test_a_folder_comes_with_its_newest_model_alone(crate: Path) -> None:
    assert folder_files(crate / "model-1_4.sdf", "crate/model-1_4.sdf", TO_SDF, "1.4") == {}
    (crate / "model.config").unlink()
    assert folder_files(crate / "model.sdf", "crate/model.sdf", TO_SDF, "1.6") == {}


@pytest.mark.parametrize(
    ("request_", "output", "version", "rows"),
    [
        (TO_SDF, "model.sdf", "1.6", [("1.4", "model-1_4.sdf"), ("1.6", "model.sdf")]),
        (ConversionRequest(to="sdf", sdf_version="1.9"), "model.sdf", "1.9", [("1.9", "model.sdf")]),
        (ConversionRequest(to="urdf"), "model.urdf", "1.0", [("1.4", "model-1_4.urdf"), ("1.6", "model.urdf")]),
    ],
)
def test_model_config_names_what_the_models_became(
    crate: Path, request_: ConversionRequest, output: str, version: str, rows: list[tuple[str, str]]
) -> None:
    config = folder_files(crate / "model.sdf", f"crate/{output}", request_, version)["crate/model.config"]
    assert _rows(config) == rows
    assert b"<!-- of wood -->" in config


def test_a_config_that_is_no_xml_brings_nothing(crate: Path) -> None:
    (crate / "model.config").write_bytes(b"<model>")
    assert folder_files(crate / "model.sdf", "crate/model.sdf", TO_SDF, "1.6") == {}


def test_links_that_lead_elsewhere_stay_behind(crate: Path, tmp_path: Path) -> None:
    write_files(tmp_path, {"secret.txt": b"private"})
    (crate / "meshes/secret.txt").symlink_to(tmp_path / "secret.txt")
    (crate / "meshes/crate2.stl").symlink_to("crate.stl")
    files = folder_files(crate / "model.sdf", "crate/model.sdf", TO_SDF, "1.6")
    assert "crate/meshes/crate2.stl" in files
    assert b"private" not in files.values()


def test_too_much_is_not_copied(crate: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jobs, "_LARGEST", 100)
    with pytest.raises(FolderTooLargeError):
        folder_files(crate / "model.sdf", "crate/model.sdf", TO_SDF, "1.6")
