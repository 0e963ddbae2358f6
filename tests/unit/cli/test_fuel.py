"""`twinform fuel`: an offline cache, and what is found in it."""

from pathlib import Path

import pytest

from tests.snippets import STL
from tests.write_files import write_files

from .conftest import Run

CRATE = b"""<sdf version="1.9"><model name="crate"><link name="l"><visual name="v"><geometry><mesh>
<uri>model://crate/meshes/crate.stl</uri></mesh></geometry></visual></link></model></sdf>"""
FILES = {
    "model.config": b"<model><name>Big Crate</name><sdf version='1.9'>model.sdf</sdf></model>",
    "model.sdf": CRATE,
    "meshes/crate.stl": STL,
    ".git/config": b"private",
}
WORLD = """<sdf version="1.9"><world name="w"><include>
<uri>https://fuel.gazebosim.org/1.0/Some%20Body/models/Big%20Crate</uri></include></world></sdf>"""
ADDRESS = "https://fuel.gazebosim.org/1.0/Some%20Body/models/Big%20Crate/1\n"


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache, which is in force."""
    monkeypatch.setenv("GZ_FUEL_CACHE_PATH", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def crate(tmp_path: Path) -> Path:
    """A model folder."""
    return write_files(tmp_path / "models/crate", FILES)


def test_a_model_is_found_by_its_address(run: Run, cache: Path, crate: Path, tmp_path: Path) -> None:
    world = tmp_path / "w.sdf"
    world.write_text(WORLD)
    assert run("convert", world, "--expand-includes", "--to", "sdf").exit_code == 1
    assert run("fuel", "add", crate, "--owner", "Some Body").stdout == ADDRESS
    place = cache / "fuel.gazebosim.org/some body/models/big crate/1"
    assert sorted(path.relative_to(place).as_posix() for path in place.rglob("*") if path.is_file()) == [
        "meshes/crate.stl", "model.config", "model.sdf"
    ]  # fmt: skip
    done = run("convert", world, "--expand-includes", "--to", "sdf")
    assert done.exit_code == 0
    assert '<model name="crate">' in done.stdout


def test_the_same_files_are_one_version_and_others_the_next(run: Run, cache: Path, crate: Path) -> None:
    add = ("fuel", "add", crate, "--owner", "Some Body")
    assert run(*add).stdout == run(*add).stdout == ADDRESS
    (crate / "model.sdf").write_bytes(CRATE.replace(b"1.9", b"1.8"))
    assert run(*add).stdout == ADDRESS.replace("/1\n", "/2\n")
    assert run("fuel", "list").stdout == "https://fuel.gazebosim.org/1.0/some%20body/models/big%20crate/2\n"
    assert run(*add, "--resource-version", "1").exit_code == 2
    assert run(*add, "--resource-version", "7").stdout.endswith("/7\n")
    assert len(list((cache / "fuel.gazebosim.org/some body/models/big crate").iterdir())) == 3


def test_a_folder_of_models_is_added_whole(run: Run, cache: Path, crate: Path) -> None:
    write_files(crate.parent / "ball", {**FILES, "model.config": b"<model><sdf version='1.9'>model.sdf</sdf></model>"})
    found = run("fuel", "add", crate.parent, "--owner", "me").stdout
    assert [line.rsplit("/", 2)[1] for line in found.splitlines()] == ["ball", "Big%20Crate"]
    assert run("fuel", "add", crate.parent, "--owner", "me", "--name", "x").exit_code == 2
    assert cache.is_dir()


def test_a_world_is_found_by_its_address(run: Run, cache: Path, tmp_path: Path) -> None:
    folder = write_files(tmp_path / "hall", {"hall.sdf": WORLD.encode()})
    assert run("fuel", "add", folder, "--owner", "me").stdout.endswith("/me/worlds/hall/1\n")
    assert (cache / "fuel.gazebosim.org/me/worlds/hall/1/hall.sdf").is_file()


@pytest.mark.parametrize("wrong", [["--owner", ".."], ["--owner", "a/b"], ["--owner", "a", "--name", "."], []])
def test_wrong_names_are_refused(run: Run, cache: Path, crate: Path, wrong: list[str]) -> None:
    assert run("fuel", "add", crate, *wrong).exit_code == 2
    assert not cache.exists()


def test_a_folder_of_nothing_is_refused(run: Run, cache: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    done = run("fuel", "add", tmp_path / "empty", "--owner", "me")
    assert done.exit_code == 2
    assert "has no model.config" in done.stderr
    assert not cache.exists()


def test_links_that_lead_elsewhere_stay_behind(run: Run, cache: Path, crate: Path, tmp_path: Path) -> None:
    write_files(tmp_path, {"secret": b"private"})
    (crate / "meshes/secret").symlink_to(tmp_path / "secret")
    assert run("fuel", "add", crate, "--owner", "me").exit_code == 0
    assert not list(cache.rglob("secret"))


def test_uris_become_addresses_and_models_again(run: Run, cache: Path, crate: Path) -> None:
    run("fuel", "add", crate, "--owner", "me", "--name", "crate", "--cache", cache)
    stored = cache / "fuel.gazebosim.org/me/models/crate/1/model.sdf"
    (crate / "meshes/crate.stl").unlink()
    address = "https://fuel.gazebosim.org/1.0/me/models/crate/1/files/meshes/crate.stl"
    to_fuel = run("convert", stored, "--to", "sdf", "--passes", "rewrite-uris{to=fuel}").stdout
    assert f"<uri>{address}</uri>" in to_fuel
    for taken, written in (("fuel", "model://crate/"), ("http", "model://crate/"), ("file", address)):
        passes = f"rewrite-uris{{to=model from-schemes=[{taken}]}}"
        assert f"<uri>{written}" in run("convert", "-", "--to", "sdf", "--passes", passes, text=to_fuel).stdout


def test_what_is_in_no_cache_has_no_address(run: Run, cache: Path, crate: Path) -> None:
    done = run("convert", crate / "model.sdf", "--to", "sdf", "--passes", "rewrite-uris{to=fuel}")
    assert "is in no local cache of Fuel" in done.stderr
    assert "[unmapped-uri]" in done.stderr
    assert not cache.exists()


def test_the_cache_of_ignition_is_one_too(
    run: Run, crate: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("GZ_FUEL_CACHE_PATH", raising=False)
    monkeypatch.setenv("IGN_FUEL_CACHE_PATH", str(tmp_path / "old"))
    run("fuel", "add", crate, "--owner", "me", "--cache", tmp_path / "old")
    assert run("fuel", "list").stdout.startswith("https://fuel.gazebosim.org/1.0/me/models/")


def test_other_addresses_are_not_called_those_of_fuel(run: Run, tmp_path: Path) -> None:
    mesh = '<visual><geometry><mesh filename="https://example.org/arm.stl"/></geometry></visual>'
    (tmp_path / "r.urdf").write_text(f'<robot name="r"><link name="l">{mesh}</link></robot>')
    done = run("package", tmp_path / "r.urdf", "-o", tmp_path / "out", "--kind", "gazebo-model")
    assert "'https://example.org/arm.stl' is no address of Fuel, and nothing is fetched from example.org" in done.stderr
    assert "gz fuel" not in done.stderr
