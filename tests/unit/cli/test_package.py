"""`twinform package`: what is written, what is refused, and that other programs find everything in it."""

import os
import re
import shutil
from pathlib import Path

import pytest

import twinform
from tests.snippets import INERTIAL, STL
from tests.unit.cli.conftest import GOOD, Run
from tests.unit.compiler.packaging.robots import ARM, FILES, PNG, arm
from tests.write_files import write_files
from twinform.testing.oracles.libsdformat import MISSING, available, models_of, named_files

pytestmark = pytest.mark.slow

SAID = (
    "--description", "An arm.", "--maintainer", "A. Body", "--email", "a@body.org", "--license", "MIT", "--no-thumbnail"
)  # fmt: skip
WORLD = """<sdf version="1.9"><world name="hall">
  <include><uri>model://sun</uri></include>
  <model name="table"><static>true</static><link name="top">
    <visual name="v"><geometry><mesh><uri>meshes/top.stl</uri></mesh></geometry></visual></link></model>
  <model name="Arm 2"><pose>1 2 3 0 0 0</pose><link name="base"><collision name="c"><geometry><mesh>
    <uri>meshes/top.stl</uri></mesh></geometry></collision></link></model>
</world></sdf>
"""


def _written(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _package(run: Run, source: Path, folder: Path, *more: str | Path) -> dict[str, bytes]:
    done = run("package", source, "-o", folder, "--kind", "gazebo-model", *SAID, *more)
    assert done.exit_code == 0, done.stderr
    return _written(folder)


def test_all_files_are_in_the_folder(run: Run, tmp_path: Path) -> None:
    files = _package(run, arm(tmp_path), tmp_path / "out/arm", "--thumbnail")
    assert set(files) == {
        ".twinform-package", "model.config", "model.sdf", "meshes/visual/base.obj", "meshes/visual/arm.mtl",
        "meshes/collision/base.STL", "meshes/tip_one.stl", "materials/textures/skin.png", "thumbnails/1.png",
    }  # fmt: skip
    assert b"map_Kd ../../materials/textures/skin.png" in files["meshes/visual/arm.mtl"]
    assert files["meshes/visual/base.obj"] == FILES["meshes/visual/base.obj"]
    uris = set(re.findall(r"<(?:uri|albedo_map)>(.*?)</", files["model.sdf"].decode()))
    assert uris == {
        "model://arm/meshes/visual/base.obj", "model://arm/meshes/collision/base.STL",
        "model://arm/meshes/tip_one.stl", "model://arm/materials/textures/skin.png",
    }  # fmt: skip


def test_nothing_leads_out_of_the_folder(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    _package(run, source, tmp_path / "out/arm")
    shutil.rmtree(tmp_path / "arm_description")
    checked = run("check", tmp_path / "out/arm", "--strict")
    assert checked.exit_code == 0
    assert "1 file: 0 errors, 0 warnings" in checked.output
    assert "arm_description" not in (tmp_path / "out/arm/model.sdf").read_text()


@pytest.mark.skipif(not available(), reason=MISSING)
def test_libsdformat_finds_every_file_beside_the_folder(run: Run, tmp_path: Path) -> None:
    _package(run, arm(tmp_path), tmp_path / "out/arm", "--sdf-version", "1.9", "--sdf-version", "1.6")
    shutil.rmtree(tmp_path / "arm_description")
    for name in ("model.sdf", "model-1_6.sdf"):
        found = named_files(tmp_path / "out/arm" / name, [tmp_path / "out"])
        assert not found.errors
        assert len(found.paths) == 4 if name == "model.sdf" else 3
        for path in found.paths.values():
            assert path is not None
            assert path.resolve().is_relative_to(tmp_path / "out/arm")


@pytest.mark.skipif(not available(), reason=MISSING)
def test_the_newest_version_is_taken_that_a_reader_knows(run: Run, tmp_path: Path) -> None:
    _package(run, arm(tmp_path), tmp_path / "out/arm", "--sdf-version", "1.5", "--sdf-version", "1.9")
    config = (tmp_path / "out/arm/model.config").read_text()
    assert re.findall(r"<sdf version=\"(.*?)\">(.*?)<", config) == [("1.9", "model.sdf"), ("1.5", "model-1_5.sdf")]
    world = tmp_path / "out/world.sdf"
    world.write_text('<sdf version="1.9"><world name="w"><include><uri>model://arm</uri></include></world></sdf>')
    reading, models = models_of(world)
    assert reading.ok
    assert [model["name"] for model in models] == ["arm"]


def test_the_model_is_the_same_robot(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    _package(run, source, tmp_path / "out/arm")
    found = run("diff", source, tmp_path / "out/arm/model.sdf").stdout
    assert set(re.findall(r"difference: .*/(\w+) is '", found)) == {"uri", "albedo_map"}
    assert found.count("difference: ") == 4


def test_model_config_says_what_was_given(run: Run, tmp_path: Path) -> None:
    config = _package(run, arm(tmp_path), tmp_path / "arm", "--name", "An <arm> & more", "--author", "B")[
        "model.config"
    ]
    assert b"<name>An &lt;arm&gt; &amp; more</name>" in config
    assert b"<name>B</name>" in config
    assert b"<description>An arm.</description>" in config
    assert b"TODO" not in config


def test_what_was_not_given_is_todo_with_a_warning(run: Run, tmp_path: Path) -> None:
    done = run("package", arm(tmp_path), "-o", tmp_path / "arm", "--kind", "gazebo-model")
    assert done.exit_code == 0
    assert "the package says TODO for description, maintainer, email [placeholder]" in done.stderr
    assert b"TODO" in (tmp_path / "arm/model.config").read_bytes()


def test_what_was_not_given_is_as_the_package_around_has_it(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    manifest = source.parent.parent / "package.xml"
    assert manifest.is_file()
    manifest.write_text(
        "<package><name>arm_description</name><version>2.1.0</version><description>An arm of steel.</description>"
        "<maintainer email='ann@example.org'>Ann</maintainer><license>MIT</license></package>"
    )
    done = run("package", source, "-o", tmp_path / "arm", "--kind", "both", "--license", "BSD", "--no-thumbnail")
    assert done.exit_code == 0
    assert "TODO" not in done.stderr
    made = (tmp_path / "arm/package.xml").read_text()
    assert "<version>2.1.0</version>" in made
    assert "<license>BSD</license>" in made
    assert '<maintainer email="ann@example.org">Ann</maintainer>' in made
    assert "<name>Ann</name>" in (tmp_path / "arm/model.config").read_text()


def test_the_same_input_gives_the_same_bytes(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    first = _package(run, source, tmp_path / "one/arm", "--thumbnail")
    assert _package(run, source, tmp_path / "two/arm", "--thumbnail") == first
    assert _package(run, source, tmp_path / "one/arm", "--thumbnail") == first


def test_dry_run_lists_the_files_and_writes_none(run: Run, tmp_path: Path) -> None:
    done = run("package", arm(tmp_path), "-o", tmp_path / "out", "--kind", "gazebo-model", "--dry-run", *SAID)
    assert done.stdout.splitlines() == sorted(done.stdout.splitlines())
    assert "meshes/visual/base.obj" in done.stdout
    assert not (tmp_path / "out").exists()


def test_a_missing_file_is_an_error_with_its_line(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    (tmp_path / "arm_description/meshes/collision/base.STL").unlink()
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model")
    assert done.exit_code == 1
    assert re.search(r"arm\.urdf:7:?\d*: error: .*base\.STL' is not found \[unpackaged-file\]", done.stderr)
    assert not (tmp_path / "out").exists()


def test_what_a_mesh_names_and_is_missing_is_an_error_too(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    (tmp_path / "arm_description/meshes/textures/skin.png").unlink()
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model")
    assert done.exit_code == 1
    assert "arm.mtl' names '../textures/skin.png', which is not there" in done.stderr


def test_missing_files_may_be_allowed(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    for path in ("meshes/collision/base.STL", "meshes/textures/skin.png"):
        (tmp_path / "arm_description" / path).unlink()
    ledger = tmp_path / "ledger.json"
    files = _package(run, source, tmp_path / "out", "--allow-missing", "--ledger", ledger)
    assert b"model://arm_description/meshes/collision/base.STL" in files["model.sdf"]
    assert "base.STL' is not in the package" in ledger.read_text()
    assert files["meshes/visual/base.obj"]


def _linked_out(folder: Path) -> None:
    (folder / "secret.stl").write_bytes(STL)
    mesh = folder / "arm_description/meshes/collision/base.STL"
    mesh.unlink()
    mesh.symlink_to(folder / "secret.stl")


def _climbing(folder: Path) -> None:
    write_files(folder, {"secret.png": PNG})
    (folder / "arm_description/meshes/visual/arm.mtl").write_text("newmtl skin\nmap_Kd ../../../secret.png\n")


def _absolute(folder: Path) -> None:
    write_files(folder, {"secret.png": PNG})
    (folder / "arm_description/meshes/visual/arm.mtl").write_text(f"newmtl skin\nmap_Kd {folder}/secret.png\n")


def _another_kind(folder: Path) -> None:
    write_files(folder, {"arm_description/meshes/notes.txt": b"private"})
    (folder / "arm_description/meshes/visual/arm.mtl").write_text("newmtl skin\nmap_Kd ../notes.txt\n")


def _another_kind_by_link(folder: Path) -> None:
    write_files(folder, {"arm_description/meshes/notes.txt": b"private"})
    skin = folder / "arm_description/meshes/textures/skin.png"
    skin.unlink()
    skin.symlink_to("../notes.txt")


@pytest.mark.parametrize("hostile", [_linked_out, _climbing, _absolute, _another_kind, _another_kind_by_link])
@pytest.mark.parametrize("more", [[], ["--allow-missing"]])
def test_files_of_somebody_else_are_not_copied(run: Run, tmp_path: Path, hostile: object, more: list[str]) -> None:
    folder = tmp_path / "download"
    source = arm(folder)
    assert callable(hostile)
    hostile(folder)
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID, *more)
    written = _written(tmp_path / "out") if (tmp_path / "out").exists() else {}
    assert b"private" not in written.values()
    assert more or done.exit_code == 1
    if hostile in (_linked_out, _climbing, _absolute):
        assert done.exit_code == 1
        assert "[uri-leaves-folder]" in done.stderr
        assert not written


def test_files_of_somebody_else_are_not_written_over(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    write_files(tmp_path / "out", {"model.sdf": b"mine", "notes.txt": b"mine"})
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 2
    assert "model.sdf would be written over" in done.stderr
    assert _written(tmp_path / "out") == {"model.sdf": b"mine", "notes.txt": b"mine"}
    files = _package(run, source, tmp_path / "out", "--force")
    assert files["model.sdf"] != b"mine"
    assert files["notes.txt"] == b"mine"


def test_an_edited_file_is_not_written_over(run: Run, tmp_path: Path) -> None:
    source, folder = arm(tmp_path), tmp_path / "out"
    _package(run, source, folder)
    (folder / "model.sdf").write_text("edited")
    assert run("package", source, "-o", folder, "--kind", "gazebo-model", *SAID).exit_code == 2
    assert (folder / "model.sdf").read_text() == "edited"


def test_what_the_package_has_no_more_goes_away(run: Run, tmp_path: Path) -> None:
    source, folder = arm(tmp_path), tmp_path / "out"
    _package(run, source, folder)
    source.write_text(ARM.replace("meshes/visual/base.obj", "meshes/collision/base.STL"))
    files = _package(run, source, folder)
    assert "meshes/collision/base.STL" in files
    assert not (folder / "meshes/visual").exists()


def test_links_in_the_folder_are_not_followed(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out/meshes").symlink_to(tmp_path / "elsewhere")
    assert run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID).exit_code == 2
    files = _package(run, source, tmp_path / "out", "--force")
    assert "meshes/visual/base.obj" in files
    assert not (tmp_path / "out/meshes").is_symlink()
    assert not list((tmp_path / "elsewhere").iterdir())


def test_a_list_of_files_that_leads_away_is_not_believed(run: Run, tmp_path: Path) -> None:
    source, folder = arm(tmp_path), tmp_path / "out"
    _package(run, source, folder)
    (tmp_path / "precious").write_text("x")
    digest = "2d711642b726b04401627ca9fbac32f5c8530fb1903cc4db02258717921a4881"
    mark = folder / ".twinform-package"
    mark.write_text(f"{mark.read_text()}{digest}  ../precious\n")
    assert run("package", source, "-o", folder, "--kind", "gazebo-model", *SAID).exit_code == 2
    _package(run, source, folder, "--force")
    assert (tmp_path / "precious").exists()


def test_a_file_that_is_read_is_not_written_over(run: Run, tmp_path: Path) -> None:
    _package(run, arm(tmp_path), tmp_path / "arm")
    done = run("package", tmp_path / "arm/model.sdf", "-o", tmp_path / "arm", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 2
    assert "which is read" in done.stderr


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written_is_reported(run: Run, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir(mode=0o500)
    done = run("package", arm(tmp_path), "-o", tmp_path / "out/arm", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 2


def test_a_file_in_the_place_of_the_folder_is_wrong_usage(run: Run, tmp_path: Path) -> None:
    (tmp_path / "out").write_text("")
    assert run("package", arm(tmp_path), "-o", tmp_path / "out", "--kind", "gazebo-model").exit_code == 2
    assert run("package", arm(tmp_path), "-o", tmp_path / "out/arm", "--kind", "gazebo-model").exit_code == 2


def test_one_content_is_there_once_and_one_name_twice(run: Run, tmp_path: Path) -> None:
    source = tmp_path / "robot.urdf"
    meshes = {
        "a/part.stl": STL,
        "b/part.stl": STL.replace(b"1 0 0", b"2 0 0"),
        "c/other.stl": STL,
        "d/PART.STL": b"solid",
    }
    write_files(tmp_path, {f"pkg_{path[0]}/meshes/{path[2:]}": data for path, data in meshes.items()})
    write_files(tmp_path, {f"pkg_{name}/package.xml": f"<package><name>{name}</name></package>" for name in "abcd"})
    uris = (f"package://{path[0]}/meshes/{path[2:]}" for path in meshes)
    shapes = "".join(f'<visual><geometry><mesh filename="{uri}"/></geometry></visual>' for uri in uris)
    source.write_text(f'<robot name="r"><link name="l">{INERTIAL}{shapes}</link></robot>')
    files = _package(run, source, tmp_path / "out", "--path", tmp_path)
    assert {path for path in files if path.startswith("meshes/")} == {
        "meshes/part.stl", "meshes/b/part.stl", "meshes/d/PART.STL"
    }  # fmt: skip


def test_names_are_those_that_every_program_takes(run: Run, tmp_path: Path) -> None:
    source = write_files(tmp_path, {"r.urdf": b"", "meshes/Bras été #1.stl": STL}) / "r.urdf"
    mesh = '<visual><geometry><mesh filename="meshes/Bras été #1.stl"/></geometry></visual>'
    source.write_text(f'<robot name="r"><link name="l">{INERTIAL}{mesh}</link></robot>')
    assert "meshes/Bras_ete_1.stl" in _package(run, source, tmp_path / "out")


def test_a_world_becomes_folders_of_its_models(run: Run, tmp_path: Path) -> None:
    source = write_files(tmp_path, {"hall.sdf": WORLD.encode(), "meshes/top.stl": STL}) / "hall.sdf"
    files = _package(run, source, tmp_path / "out")
    assert set(files) == {
        ".twinform-package", "worlds/hall.sdf", "models/table/model.config", "models/table/model.sdf",
        "models/table/meshes/top.stl", "models/Arm_2/model.config", "models/Arm_2/model.sdf",
        "models/Arm_2/meshes/top.stl",
    }  # fmt: skip
    world = files["worlds/hall.sdf"].decode()
    assert re.findall("<uri>(.*?)<", world) == ["model://sun", "model://table", "model://Arm_2"]
    assert "<name>Arm 2</name>" in world
    assert b"model://table/meshes/top.stl" in files["models/table/model.sdf"]


@pytest.mark.skipif(not available(), reason=MISSING)
def test_libsdformat_reads_the_world_with_all_its_models(run: Run, tmp_path: Path) -> None:
    text = WORLD.replace("<include><uri>model://sun</uri></include>", "")
    source = write_files(tmp_path, {"hall.sdf": text.encode(), "meshes/top.stl": STL}) / "hall.sdf"
    _, before = models_of(source)
    _package(run, source, tmp_path / "out")
    world = tmp_path / "out/worlds/hall.sdf"
    reading, after = models_of(world, [tmp_path / "out/models"])
    assert reading.ok
    assert after == before
    source.unlink()
    (tmp_path / "meshes/top.stl").unlink()
    found = named_files(world, [tmp_path / "out/models"])
    assert len(found.paths) == 2
    assert None not in found.paths.values()


def test_a_model_of_a_world_may_be_taken_alone(run: Run, tmp_path: Path) -> None:
    source = write_files(tmp_path, {"hall.sdf": WORLD.encode(), "meshes/top.stl": STL}) / "hall.sdf"
    files = _package(run, source, tmp_path / "table", "--model", "table")
    assert {"model.sdf", "model.config", "meshes/top.stl"} < set(files)


def test_an_include_of_the_same_name_is_refused(run: Run, tmp_path: Path) -> None:
    text = WORLD.replace("model://sun", "model://table").replace(
        "<uri>model://table", "<name>x</name><uri>model://table"
    )
    source = write_files(tmp_path, {"hall.sdf": text.encode(), "meshes/top.stl": STL}) / "hall.sdf"
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 1
    assert "'model://table' would lead to the folder of another model of the package" in done.stderr


def test_includes_of_models_are_what_it_depends_on(run: Run, tmp_path: Path) -> None:
    text = '<sdf version="1.9"><model name="m"><include><uri>model://hand</uri></include><link name="l"/></model></sdf>'
    source = write_files(tmp_path, {"m.sdf": text.encode()}) / "m.sdf"
    files = _package(run, source, tmp_path / "out")
    assert b"<depend>\n    <model>\n      <uri>model://hand</uri>" in files["model.config"]


def test_includes_by_paths_are_refused(run: Run, tmp_path: Path) -> None:
    text = '<sdf version="1.9"><model name="m"><include><uri>hand.sdf</uri></include><link name="l"/></model></sdf>'
    hand = '<sdf version="1.9"><model name="hand"><link name="l"/></model></sdf>'
    source = write_files(tmp_path, {"m.sdf": text.encode(), "hand.sdf": hand.encode()}) / "m.sdf"
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 1
    assert "[unpackaged-include]" in done.stderr
    assert b"'hand'" not in _package(run, source, tmp_path / "out", "--expand-includes")["model.sdf"]


_PARAMETER = "<parameters>package://control/a.yaml</parameters>"
_PLUGIN = f'<plugin name="control" filename="x.so"><group>{_PARAMETER}</group></plugin>'
_WITH_PLUGIN = (
    f'<robot name="r"><link name="l">{INERTIAL}</link><gazebo>{_PLUGIN}</gazebo></robot>',
    f'<sdf version="1.9"><model name="r"><link name="l"/>{_PLUGIN}</model></sdf>',
)


@pytest.mark.parametrize("text", _WITH_PLUGIN)
def test_parameters_of_plugins_stay_with_a_warning(run: Run, tmp_path: Path, text: str) -> None:
    source = write_files(tmp_path, {"r.urdf" if text.startswith("<robot") else "r.sdf": text.encode()})
    source = next(source.glob("r.*"))
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 0
    message = (
        "plugin 'control' names 'package://control/a.yaml', which is not put into the package [unpackaged-parameter]"
    )
    assert done.stderr.count(message) == 1
    assert "package://control/a.yaml" in (tmp_path / "out/model.sdf").read_text()


def test_several_models_need_a_name(run: Run, tmp_path: Path) -> None:
    text = '<sdf version="1.6"><model name="a"><link name="l"/></model><model name="b"><link name="l"/></model></sdf>'
    source = write_files(tmp_path, {"m.sdf": text.encode()}) / "m.sdf"
    done = run("package", source, "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 1
    assert "[model-not-chosen]" in done.stderr
    assert _package(run, source, tmp_path / "out", "--model", "b")


def test_standard_input_has_no_files_beside_it(run: Run, tmp_path: Path) -> None:
    done = run("package", "-", "-o", tmp_path / "out", "--kind", "gazebo-model", *SAID, text=GOOD)
    assert done.exit_code == 0
    assert twinform.load(tmp_path / "out/model.sdf").models[0].name == "one"


def test_folders_of_material_scripts_come_whole(run: Run, tmp_path: Path) -> None:
    script = b"material Wood { technique { pass { texture_unit { texture wood.png } } } }"
    model = (
        '<sdf version="1.9"><model name="m"><link name="l"><visual name="v"><geometry><box><size>1 1 1</size></box>'
        "</geometry><material><script><uri>model://old/materials/scripts</uri><uri>model://old/materials/textures</uri>"
        "<name>Wood</name></script></material></visual><visual name='w'><geometry><sphere><radius>1</radius></sphere>"
        "</geometry><material><pbr><metal><albedo_map>materials/textures/wood.png</albedo_map></metal></pbr></material>"
        "</visual><visual name='x'><geometry><sphere><radius>1</radius></sphere></geometry><material><script>"
        "<uri>file://media/materials/scripts/gazebo.material</uri><name>Gazebo/Grey</name></script></material></visual>"
        "</link></model></sdf>"
    )
    files = {
        "model.config": b"<model><name>old</name><sdf version='1.9'>model.sdf</sdf></model>",
        "model.sdf": model.encode(),
        "materials/scripts/wood.material": script,
        "materials/scripts/wood.vert": b"void main() {}",
        "materials/scripts/notes.txt": b"private",
        "materials/textures/wood.png": PNG,
    }
    written = _package(run, write_files(tmp_path / "old", files) / "model.sdf", tmp_path / "new")
    assert {path for path in written if path.startswith("materials/")} == {
        "materials/scripts/wood.material", "materials/scripts/wood.vert", "materials/textures/wood.png"
    }  # fmt: skip
    uris = re.findall(r"<(?:uri|albedo_map)>(.*?)</", written["model.sdf"].decode())
    assert uris == [
        "model://new/materials/scripts", "model://new/materials/textures", "model://new/materials/textures/wood.png",
        "file://media/materials/scripts/gazebo.material",
    ]  # fmt: skip


def test_a_texture_that_a_script_names_keeps_its_bare_name(run: Run, tmp_path: Path) -> None:
    script = b"material Wood { technique { pass { texture_unit {\ntexture wood.png\n} } } }"
    model = (
        '<sdf version="1.9"><model name="m"><link name="l"><visual name="v"><geometry><box><size>1 1 1</size></box>'
        "</geometry><material><script><uri>file://wood.material</uri><name>Wood</name></script></material></visual>"
        "</link></model></sdf>"
    )
    source = write_files(tmp_path / "old", {"m.sdf": model, "wood.material": script, "wood.png": PNG}) / "m.sdf"
    written = _package(run, source, tmp_path / "new")
    assert written["materials/scripts/wood.material"] == script
    assert written["materials/textures/wood.png"] == PNG


@pytest.mark.parametrize("wrong", [["--kind", "deb"], [], ["--kind", "gazebo-model", "--sdf-version", "7"]])
def test_wrong_usage(run: Run, folder: Path, wrong: list[str]) -> None:
    assert run("package", folder / "good.urdf", "-o", folder / "out", *wrong).exit_code == 2


def test_two_inputs_are_wrong_usage(run: Run, folder: Path) -> None:
    good = folder / "good.urdf"
    assert run("package", good, good, "-o", folder / "out", "--kind", "gazebo-model").exit_code == 2


def test_a_name_that_is_not_that_of_the_folder_cannot_be_for_both(run: Run, folder: Path) -> None:
    done = run("package", folder / "good.urdf", "-o", folder / "out", "--kind", "both", "--name", "other")
    assert done.exit_code == 2
    assert "they have to be the same" in done.stderr


@pytest.mark.parametrize(("file", "code"), [("wrong.urdf", 1), ("broken.urdf", 2), ("absent.urdf", 2)])
def test_exit_codes_are_those_of_convert(run: Run, folder: Path, file: str, code: int) -> None:
    assert run("package", folder / file, "-o", folder / "out", "--kind", "gazebo-model").exit_code == code
    assert not (folder / "out").exists()


_EVERYWHERE = """<sdf version="1.9"><model name="arm"><link name="base">
  <visual name="ground"><geometry><heightmap><uri>media/height.png</uri><size>1 1 1</size><texture>
    <diffuse>media/dirt.png</diffuse><normal>media/bumps.png</normal><size>1</size></texture></heightmap></geometry>
    <material><diffuse>1 0 0 1</diffuse></material></visual>
  <particle_emitter name="smoke" type="point"><color_range_image>media/colors.png</color_range_image>
    <material><pbr><metal><albedo_map>media/smoke.png</albedo_map></metal></pbr></material></particle_emitter>
  <projector name="beamer"><texture>media/slide.png</texture></projector>
  <audio_source><uri>media/beep.wav</uri></audio_source>
</link></model></sdf>
"""


def test_files_are_found_wherever_an_element_names_one(run: Run, tmp_path: Path) -> None:
    names = ("height.png", "dirt.png", "bumps.png", "colors.png", "smoke.png", "slide.png", "beep.wav")
    write_files(tmp_path, {"arm.sdf": _EVERYWHERE.encode(), **{f"media/{name}": name.encode() for name in names}})
    files = _package(run, tmp_path / "arm.sdf", tmp_path / "out/arm")
    assert {Path(path).name for path in files} == {*names, "model.sdf", "model.config", ".twinform-package"}
    uris = set(re.findall(r"model://arm/([^<]*)<", files["model.sdf"].decode()))
    assert uris == {path for path in files if path.endswith((".png", ".wav"))}
    assert "<diffuse>1 0 0 1</diffuse>" in files["model.sdf"].decode()


def test_a_picture_of_the_sky_goes_with_the_world(run: Run, tmp_path: Path) -> None:
    world = '<sdf version="1.9"><world name="w"><scene><sky><cubemap_uri>{}</cubemap_uri></sky></scene></world></sdf>'
    write_files(tmp_path, {"media/sky.dds": b"sky", "w.sdf": world.format("media/sky.dds").encode()})
    files = _package(run, tmp_path / "w.sdf", tmp_path / "out/w")
    (name,) = re.findall("<cubemap_uri>(.*)</cubemap_uri>", files["worlds/w.sdf"].decode())
    assert files[f"worlds/{name}"] == b"sky"


def test_an_image_of_a_folder_of_scripts_is_there_once(run: Run, tmp_path: Path) -> None:
    material = (
        "<pbr><metal><albedo_map>model://arm/materials/textures/skin.png</albedo_map></metal></pbr>"
        "<script><uri>model://arm/materials/textures</uri><name>Skin</name></script>"
    )
    shape = f"<geometry><box><size>1 1 1</size></box></geometry><material>{material}</material>"
    sdf = f'<sdf version="1.9"><model name="arm"><link name="l"><visual name="v">{shape}</visual></link></model></sdf>'
    folder = {"materials/textures/skin.png": PNG, "model.config": b"<model/>", "model.sdf": sdf.encode()}
    files = _package(run, write_files(tmp_path / "arm", folder) / "model.sdf", tmp_path / "out/arm")
    assert [path for path in files if path.endswith(".png")] == ["materials/textures/skin.png"]
    assert b"<uri>model://arm/materials/textures</uri>" in files["model.sdf"]


def test_a_pointer_of_git_lfs_is_not_put_into_a_package(run: Run, tmp_path: Path) -> None:
    source = arm(tmp_path)
    pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n"
    write_files(tmp_path / "arm_description", {"meshes/collision/base.STL": pointer})
    done = run("package", source, "-o", tmp_path / "out/arm", "--kind", "gazebo-model", *SAID)
    assert done.exit_code == 1
    assert "base.STL' is a pointer of Git LFS and not the file itself [unpackaged-file]" in done.stderr
    assert "git lfs pull" in done.stderr


def test_a_folder_for_mujoco_has_a_robot_a_scene_and_its_files(run: Run, tmp_path: Path) -> None:
    done = run("package", arm(tmp_path), "-o", tmp_path / "out", "--kind", "mujoco")
    assert done.exit_code == 0, done.stderr
    files = _written(tmp_path / "out")
    assert {path for path in files if not path.startswith("assets/")} == {".twinform-package", "model.xml", "scene.xml"}
    named = set(re.findall(rb'file="(.*?)"', files["model.xml"]))
    assert named
    assert {name.decode() for name in named} <= {path for path in files if path.startswith("assets/")}
    assert b'<include file="model.xml"/>' in files["scene.xml"]
    assert "TODO" not in done.stderr
    assert not [path for path in files if path.endswith(".mtl")]  # which MuJoCo does not read


def test_a_mesh_for_a_shape_that_mjcf_lacks_is_where_all_files_are(run: Run, tmp_path: Path) -> None:
    cone = "<cone><radius>1</radius><length>1</length></cone>"
    text = f'<model name="m"><link name="a"><visual name="v"><geometry>{cone}</geometry></visual></link></model>'
    (tmp_path / "m.sdf").write_text(f'<sdf version="1.12">{text}</sdf>')
    assert run("package", tmp_path / "m.sdf", "-o", tmp_path / "out", "--kind", "mujoco").exit_code == 0
    files = _written(tmp_path / "out")
    (mesh,) = (path for path in files if path.endswith(".obj"))
    assert mesh.startswith("assets/")
    assert f'file="{mesh}"'.encode() in files["model.xml"]
