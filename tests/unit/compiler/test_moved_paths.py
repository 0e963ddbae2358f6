"""Relative paths of a world whose files go to another folder."""

from pathlib import Path

import pytest
from lxml import etree

from twinform.compiler import ConversionRequest, LoadOptions, SplitWorld, split
from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Severity

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
WORLD = """\
<sdf version="1.11"><world name="w"><model name="m"><link name="l">
  <inertial auto="true"/>
  <collision name="c"><geometry><mesh><uri>{}</uri></mesh></geometry></collision>
</link></model></world></sdf>
"""


def _split(
    tmp_path: Path, folder: Path | None, *, uri: str = "shapes/a.obj", paths: tuple[Path, ...] = ()
) -> SplitWorld:
    world = tmp_path / "here/room.sdf"
    world.parent.mkdir(exist_ok=True)
    world.write_text(WORLD.format(uri))
    return split(ConversionRequest(to="urdf"), world, LoadOptions(search=SearchPath.of(paths, {})), folder=folder)


def _mesh(found: SplitWorld) -> str:
    shape = etree.fromstring(found.files["m.urdf"].encode()).find("link/collision/geometry/mesh")
    assert shape is not None
    return shape.get("filename", "")


@pytest.fixture
def shape(tmp_path: Path) -> Path:
    """A mesh beside the world."""
    path = tmp_path / "here/shapes/a.obj"
    path.parent.mkdir(parents=True)
    path.write_text(TETRAHEDRON)
    return path


@pytest.mark.parametrize("folder", ["here", "there/../here", None])
@pytest.mark.usefixtures("shape")
def test_paths_stay_where_the_files_stay(tmp_path: Path, folder: str | None) -> None:
    (tmp_path / "there").mkdir()
    assert _mesh(_split(tmp_path, None if folder is None else tmp_path / folder)) == "shapes/a.obj"


@pytest.mark.parametrize("folder", ["there", "there/deep/er", "here/out", "."])
def test_a_path_leads_to_the_same_file_from_a_folder_that_need_not_be_there_yet(
    tmp_path: Path, shape: Path, folder: str
) -> None:
    found = _mesh(_split(tmp_path, tmp_path / folder))
    (tmp_path / folder).mkdir(parents=True, exist_ok=True)
    assert (tmp_path / folder / found).resolve() == shape
    assert not Path(found).is_absolute()


def test_a_folder_behind_a_link_is_where_it_really_is(tmp_path: Path, shape: Path) -> None:
    (tmp_path / "far/away").mkdir(parents=True)
    (tmp_path / "there").symlink_to(tmp_path / "far/away")
    found = _mesh(_split(tmp_path, tmp_path / "there"))
    assert (tmp_path / "there" / found).resolve() == shape


@pytest.mark.usefixtures("shape")
def test_inertias_are_computed_from_meshes_as_in_the_same_folder(tmp_path: Path) -> None:
    same, other = (_split(tmp_path, tmp_path / folder).files["m.urdf"] for folder in ("here", "there"))
    assert other.replace("../here/shapes", "shapes") == same
    assert '<mass value="166.66' in same


def test_a_file_that_is_found_by_a_search_path_is_named_from_there(tmp_path: Path, shape: Path) -> None:
    found = _mesh(_split(tmp_path, tmp_path / "there", uri="a.obj", paths=(shape.parent,)))
    assert found == "../here/shapes/a.obj"


def test_a_path_that_leads_nowhere_stays_and_is_reported(tmp_path: Path) -> None:
    world = WORLD.format("shapes/../none/a.obj").replace('<inertial auto="true"/>', "")
    path = tmp_path / "room.sdf"
    path.write_text(world)
    found = split(ConversionRequest(to="sdf"), path, LoadOptions(), folder=tmp_path / "there")
    assert [
        (each.rule.name, each.location.line, each.found)
        for each in found.diagnostics
        if each.severity is Severity.WARNING
    ] == [("missing-file", 3, "shapes/../none/a.obj")]
    assert "<uri>shapes/../none/a.obj</uri>" in found.files["m.sdf"]
