"""Worlds with their includes expanded, as the reference parser of SDF sees them."""

from pathlib import Path

import pytest

import twinform
from twinform.schemas import versions_of
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import models_of

NEWEST = "1.9"
"""The newest version that libsdformat 12 reads."""
_CASES = Path(__file__).parents[1] / "cases" / "includes"


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize("name", ["accept_merged.sdf", "accept_several.sdf", "two_models.sdf"])
def test_libsdformat_accepts_what_includes_become(tmp_path: Path, name: str) -> None:
    result = twinform.convert(_CASES / name, to="sdf", expand_includes=True, paths=[_CASES / "parts"])
    path = tmp_path / name
    path.write_text(result.text)
    assert libsdformat.judge([path])[path].errors == ()


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize(
    "versions",
    [
        *(("1.4", "1.6", "1.8", "1.10", "1.12"), ("1.12", "1.6"), ("1.6.1", "1.6"), ("1.6", "1.6.1"), ("", "1")),
        *(("1.6 x", "1.4"), ("1.4", "1.6"), ("1.06", "1.5")),
    ],
)
def test_the_model_of_a_folder_is_the_one_that_libsdformat_takes(versions: tuple[str, ...], tmp_path: Path) -> None:
    folder = tmp_path / "crate"
    folder.mkdir()
    for version in versions:
        link = f"<link name='of {version}'><inertial><mass>1</mass></inertial></link>"
        own = version if version in versions_of("sdf") else "1.5"
        (folder / f"{version}.sdf").write_text(f"<sdf version='{own}'><model name='m'>{link}</model></sdf>")
    rows = "".join(f"<sdf version='{version}'>{version}.sdf</sdf>" for version in versions)
    (folder / "model.config").write_text(f"<model><name>crate</name>{rows}</model>")
    for own in ("1.4", "1.6", "1.9"):
        world = tmp_path / "world.sdf"
        include = "<include><uri>model://crate</uri></include>"
        world.write_text(f"<sdf version='{own}'><world name='w'>{include}</world></sdf>")
        (theirs,) = models_of(world, [tmp_path])[1]
        made = twinform.convert(world, to="sdf", sdf_version=NEWEST, expand_includes=True, paths=[tmp_path])
        (ours,) = made.document.worlds[0].models
        assert [link.name for link in ours.links] == [row["name"] for row in theirs["links"]]


@pytest.mark.parametrize(("asked", "taken"), [(None, "of_1.11"), ("1.9", "of_1.8"), ("1.12", "of_1.11")])
def test_the_reader_chooses_the_model_of_a_folder(asked: str | None, taken: str, tmp_path: Path) -> None:
    (tmp_path / "crate").mkdir()
    for version in ("1.8", "1.11"):
        text = f"<sdf version='{version}'><model name='m'><link name='of_{version}'/></model></sdf>"
        (tmp_path / "crate" / f"{version}.sdf").write_text(text)
    rows = "".join(f"<sdf version='{version}'>{version}.sdf</sdf>" for version in ("1.8", "1.11"))
    (tmp_path / "crate" / "model.config").write_text(f"<model><name>crate</name>{rows}</model>")
    text = "<sdf version='1.9'><world name='w'><include><uri>model://crate</uri></include></world></sdf>"
    made = twinform.convert(text.encode(), to="sdf", sdf_version=asked, expand_includes=True, paths=[tmp_path])
    assert [link.name for link in made.document.worlds[0].models[0].links] == [taken]


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
@pytest.mark.parametrize("version", ["1.8", "1.7", "1.6"])
def test_an_older_version_is_the_same_robot_without_newer_words_of_includes(version: str, tmp_path: Path) -> None:
    source = tmp_path / "source.sdf"
    pose = "<pose>0 0 2 0.1 0.2 0.3</pose><placement_frame>tip</placement_frame>"
    merged = f'<include merge="true"><uri>arm/model.sdf</uri><name>a</name>{pose}</include>'
    nested = f"<include><uri>arm/model.sdf</uri><name>b</name>{pose}</include>"
    source.write_text(f"<sdf version='1.9'><model name='m'><link name='base'/>{merged}{nested}</model></sdf>")
    made = twinform.convert(source, to="sdf", sdf_version=version, paths=[_CASES / "parts"])
    older = tmp_path / "older.sdf"
    older.write_text(made.text)
    (before,), (after,) = (models_of(path, [_CASES / "parts"])[1] for path in (source, older))
    for part in ("links", "joints"):
        assert [row["name"] for row in after[part]] == [row["name"] for row in before[part]]
        for ours, theirs in zip(after[part], before[part], strict=True):
            # libsdformat writes the pose of a merged model with six digits, and reads it again
            assert ours["pose"] == pytest.approx(theirs["pose"], abs=1e-6)
