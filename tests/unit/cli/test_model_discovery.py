import os
from pathlib import Path

import pytest

import twinform
from twinform.cli.inputs import NothingFoundError, discover
from twinform.cli.model_files import Exclusion, is_checked, is_model, is_text

NO_EXCLUSION = Exclusion(())


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _write(*names: str, text: str = "") -> None:
    for name in names:
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text)


def test_a_folder_has_the_models_below_it_in_order(here: Path) -> None:
    _write("b/z.urdf", "b/a.sdf", "a.world", "b/c/model.sdf", "README.md", "b/mesh.dae", "model.config")
    assert discover(["."], Exclusion()) == ["a.world", "b/a.sdf", "b/c/model.sdf", "b/z.urdf"]
    assert discover(["b"], Exclusion()) == ["b/a.sdf", "b/c/model.sdf", "b/z.urdf"]
    assert discover([str(here / "b/c")], Exclusion()) == [str(here / "b/c/model.sdf")]


def test_a_file_that_is_meant_twice_is_there_once(here: Path) -> None:
    _write("b/z.urdf", "a.urdf")
    assert discover(["b/z.urdf", "./a.urdf", ".", "b/../a.urdf", "*.urdf"], Exclusion()) == ["b/z.urdf", "./a.urdf"]


def test_hidden_files_and_what_tools_make_are_left_out_and_named_files_are_not(here: Path) -> None:
    _write(".git/a.urdf", ".a.urdf", "build/a.urdf", "x/install/a.urdf", "log/a.urdf", "node_modules/a.sdf", "k/a.urdf")
    assert discover(["."], Exclusion()) == ["k/a.urdf"]
    assert discover(["build/a.urdf", ".a.urdf"], Exclusion()) == ["build/a.urdf", ".a.urdf"]
    assert discover(["build", "x/install"], Exclusion()) == ["build/a.urdf", "x/install/a.urdf"]


def test_an_exclusion_can_be_enforced(here: Path) -> None:
    _write("third/a.urdf", "k/a.urdf", "k/generated_a.urdf")
    _write("m.xacro", text="<robot/>")
    exclusion = Exclusion(("third/", "generated_*"), force=True)
    named = ["third/a.urdf", "k/generated_a.urdf", "k/a.urdf", "third", "m.xacro", "-"]
    assert discover(named, exclusion) == ["k/a.urdf", "-"]
    assert discover(named[:1], exclusion) == []
    assert discover(["m.xacro"], Exclusion()) == ["m.xacro"]


def test_an_exclusion_is_relative_to_its_folder(here: Path) -> None:
    _write("a/b/x.urdf", "a/x.urdf", "b/x.urdf")
    assert discover(["."], Exclusion(("/b/",))) == ["a/b/x.urdf", "a/x.urdf"]
    assert discover(["a"], Exclusion(("/b/",), here)) == ["a/b/x.urdf", "a/x.urdf"]
    assert discover(["a"], Exclusion(("/b/",), here / "a")) == ["a/x.urdf"]
    os.chdir("b")  # what is outside of the folder has its own beginning
    assert discover([".."], Exclusion(("a/",))) == ["../b/x.urdf"]


@pytest.mark.parametrize(
    ("pattern", "found"),
    [
        ("*.urdf", ["a.urdf"]),
        ("**/*.urdf", ["a.urdf", "m/b.urdf", "m/n/c.urdf"]),
        ("m/*", ["m/b.urdf", "m/n/c.urdf", "m/n/d.sdf"]),
        ("m/**/*.sdf", ["m/n/d.sdf"]),
        ("[am]*/*.urdf", ["m/b.urdf"]),
        ("m/?.xml", ["m/e.xml"]),
        ("./m/*.urdf", ["m/b.urdf"]),
    ],
)
def test_a_glob_means_what_fits_it(here: Path, pattern: str, found: list[str]) -> None:
    _write("a.urdf", "m/b.urdf", "m/n/c.urdf", "m/n/d.sdf", "m/e.xml", "build/f.urdf", ".h/g.urdf")
    assert discover([pattern], Exclusion()) == found


def test_a_name_with_brackets_that_is_there_is_no_glob(here: Path) -> None:
    _write("robot[1].urdf")
    assert discover(["robot[1].urdf"], Exclusion()) == ["robot[1].urdf"]


@pytest.mark.parametrize(
    ("word", "problem"),
    [
        (".", "there is no model in ."),
        ("*.sdf", r"no model fits \*.sdf"),
        ("build", "there is no model in build"),
        ("k", "there is no model in k; 2 are excluded or ignored by git"),
    ],
)
def test_where_there_is_nothing_is_said(here: Path, word: str, problem: str) -> None:
    _write("README.md", "build/x", "k/.gitignore", text="*.urdf\n")
    _write("k/a.urdf", "k/b.urdf")
    (here / "k/c").mkdir()
    if word == ".":
        _write(".gitignore", text="k\n")
    with pytest.raises(NothingFoundError, match=problem):
        discover([word], Exclusion())


def test_links_lead_in_no_circle_and_a_broken_one_is_found(here: Path) -> None:
    _write("a/x.urdf")
    Path("a/up").symlink_to("..")
    Path("a/self").symlink_to("self")
    Path("a/gone.urdf").symlink_to("nowhere")
    Path("a/y.urdf").symlink_to("x.urdf")
    assert discover(["."], NO_EXCLUSION) == ["a/gone.urdf", "a/x.urdf", "a/y.urdf"]


def test_a_folder_that_cannot_be_listed_is_left_to_who_reads_it(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _write("a/x.urdf", "b/y.urdf")
    scandir = os.scandir

    def refused(folder: str) -> object:
        if Path(folder).name == "b":
            raise PermissionError(13, "Permission denied", folder)
        return scandir(folder)

    monkeypatch.setattr(os, "scandir", refused)
    assert discover(["."], NO_EXCLUSION) == ["a/x.urdf", "b"]


def test_names_of_any_letters(here: Path) -> None:
    _write("größe/ロボット 1.urdf", "a\nb.urdf")
    assert discover(["."], Exclusion()) == ["a\nb.urdf", "größe/ロボット 1.urdf"]


_XACRO = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"{}>{}</robot>'
_MACRO = '<xacro:macro name="m" params="x"><link name="${x}"/></xacro:macro>'


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.urdf", "", True),
        ("A.URDF", "", True),
        ("a.sdf", "", True),
        ("model.sdf", "", True),
        ("a.world", "", True),
        ("a.xml", "", False),
        ("a.urdf.bak", "", False),
        ("a.xacro", _XACRO.format(' name="r"', "<link name='a'/>"), True),
        ("a.xacro", _XACRO.format(' name="r"', _MACRO + "<xacro:m x='1'/>"), True),
        ("a.xacro", _XACRO.format(' name="r"', "<xacro:include filename='b.xacro'/>"), True),
        ("a.urdf.xacro", _XACRO.format(' name="r"', _MACRO), False),
        ("a.urdf.xacro", _XACRO.format("", "<link name='a'/>"), False),
        ("a.xacro", _XACRO.format(' name="r"', "<xacro:include filename='b.xacro'/>" + _MACRO), False),
        ("a.xacro", _XACRO.format(' name="r"', "<xacro:property name='p' value='1'/><material name='red'/>"), False),
        ("a.xacro", "<sdf version='1.9'/>", True),
        ("a.xacro", "<launch/>", False),
        ("a.xacro", "", False),
        ("a.xacro", "<robot name='r'><link", True),
        ("a.json", "{}", False),
        ("a.json", '{"robot": 1}', False),
    ],
)
def test_which_files_are_models(tmp_path: Path, name: str, text: str, expected: bool) -> None:
    path = tmp_path / name
    path.write_text(text)
    assert is_model(path) is expected


def test_our_json_is_one(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text(twinform.dumps(twinform.loads('<robot name="r"><link name="a"/></robot>'), to="json"))
    assert is_model(path)


def test_a_pattern_may_name_other_endings(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text("<robot/>")
    (tmp_path / "m.xacro").write_text(_XACRO.format("", _MACRO))
    assert is_model(tmp_path / "a.xml", named=True)
    assert not is_model(tmp_path / "m.xacro", named=True)


_PENDULUM = '<mujoco><worldbody><body name="arm"><geom size="1"/></body></worldbody></mujoco>'


def test_xml_is_a_model_where_its_root_says_that_it_is_mjcf(here: Path) -> None:
    _write("a.mjcf", "b/c.xml", text=f"<!-- of <robot> -->\n{_PENDULUM}")
    _write("package.xml", "robot.launch.xml", text='<?xml version="1.0"?><package format="3"/>')
    _write("assets.xml", text="<mujoco><asset/></mujoco>")
    _write("part.xml", text="<mujocoinclude><body/></mujocoinclude>")
    assert discover(["."], Exclusion()) == ["a.mjcf", "b/c.xml"]
    assert discover(["."], Exclusion(), is_checked) == ["a.mjcf", "assets.xml", "b/c.xml"]
    assert discover(["."], Exclusion(), is_text) == ["a.mjcf", "assets.xml", "b/c.xml"]
    assert "package.xml" in discover(["*.xml"], Exclusion())  # somebody asks for it
