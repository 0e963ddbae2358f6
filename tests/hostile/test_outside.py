"""What lies outside of a robot's folder stays there: 40 ways to a secret, and to files that are not to be written."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from tests.hostile.child import Outcome, twinform

SECRET = "hunter2canary"
"""What no output may have; the variables of the environment and the files outside are full of it."""
_HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
_LINK = "link to "
"""How the text of a file begins that is made a symbolic link."""
OUTSIDE = {
    ".ssh/id": f"-----BEGIN KEY-----\n{SECRET}\n",
    ".netrc": f"machine a login b password {SECRET}\n",
    ".aws/credentials": f"[default]\nkey = {SECRET}\n",
    ".gh.yml": f"host:\n  token: {SECRET}\n",
    "keys.yaml": f"a: {SECRET}\n",
    "broken.yaml": f"{SECRET}: [\n",
    "secret.sdf": f'<sdf version="1.9"><model name="{SECRET}"><link name="l"/></model></sdf>',
    "secret.urdf": f'<robot name="{SECRET}"><link name="a"><mass value="1.0"/></link></robot>',
    "secret.toml": f'[registry]\n{SECRET} = "a"\n',
    "secret.json": f'{{"{SECRET}": 1}}',
    "secret.obj": f"mtllib {SECRET}.mtl\nv 0 0 0\n",
    "Downloads/other/notes.yaml": f"a: {SECRET}\n",
    "Downloads/other/package.xml": f"<package><name>other_{SECRET}</name></package>",
}
"""Files below the home folder."""
VARIABLES = dict.fromkeys(("DBPASS", "MY_PW", "HOOK_URL", "DATABASE_URL", "ROS_BRIDGE_PW", "GZ_X", "npm_x"), SECRET)


def _data(path: str) -> str:
    return f"{_HEAD}<link name=\"${{xacro.load_yaml('{path}')}}\"/></robot>"


def _mesh(uri: str) -> str:
    return (
        f'<robot name="r"><link name="a"><visual><geometry><mesh filename="{uri}"/></geometry></visual></link></robot>'
    )


def _model(inside: str) -> str:
    return f'<sdf version="1.11"><model name="m">{inside}</model></sdf>'


def _include(uri: str) -> str:
    return _model(f"<include><uri>{uri}</uri></include>")


def _body(text: str) -> str:
    return f"{_HEAD}{text}</robot>"


ATTEMPTS: Mapping[str, tuple[Mapping[str, str], str]] = {
    # what a xacro file reads
    "xacro: a key above": ({"a.xacro": _data("../../.ssh/id")}, "check a.xacro"),
    "xacro: a password above": ({"a.xacro": _data("../../.netrc")}, "check a.xacro"),
    "xacro: a field": ({"a.xacro": _data("../../.gh.yml").replace("')", "')['host']['token']")}, "check a.xacro"),
    "xacro: the error of YAML": ({"a.xacro": _data("../../.aws/credentials")}, "check a.xacro"),
    "xacro: the error of YAML, inside": ({"a.xacro": _data("b.yaml"), "b.yaml": f"{SECRET}: ["}, "check a.xacro"),
    "xacro: a tag of YAML, inside": ({"a.xacro": _data("b.yaml"), "b.yaml": f"a: !{SECRET} 1"}, "check a.xacro"),
    "xacro: a visible file above": ({"a.xacro": _data("../../keys.yaml")}, "check a.xacro"),
    "xacro: beside, no package": ({"a.xacro": _data("../mine/keys.yaml")}, "check a.xacro"),
    "xacro: hidden, inside": ({"a.xacro": _data(".git/config"), ".git/config": SECRET}, "check a.xacro"),
    "xacro: by a link": ({"a.xacro": _data("b.yaml"), "b.yaml": f"{_LINK}../../keys.yaml"}, "check a.xacro"),
    "xacro: by a link to a folder": ({"a.xacro": _data("up/keys.yaml"), "up": f"{_LINK}../.."}, "check a.xacro"),
    "xacro: a link to what is hidden": (
        {"a.xacro": _data("b.yaml"), "b.yaml": f"{_LINK}.git/config", ".git/config": SECRET},
        "check a.xacro",
    ),
    "xacro: a link, then up": (
        {"a.xacro": _data("in/../../keys.yaml"), "in": f"{_LINK}deep/er", "deep/er/x": ""},
        "check a.xacro",
    ),
    "xacro: a pattern": ({"a.xacro": _body('<xacro:include filename="../../*.urdf"/>')}, "check a.xacro"),
    "xacro: a pattern of what is hidden": ({"a.xacro": _body('<xacro:include filename="../../.*"/>')}, "check a.xacro"),
    "xacro: a pattern through a link": (
        {"a.xacro": _body('<xacro:include filename="*/*.urdf"/>'), "up": f"{_LINK}../.."},
        "check a.xacro",
    ),
    "xacro: an include that is no XML": (
        {"a.xacro": _body('<xacro:include filename="../../.netrc"/>')},
        "check a.xacro",
    ),
    "xacro: find the home folder": ({"a.xacro": _data("$(find home)/keys.yaml")}, "check a.xacro"),
    "xacro: find by a manifest that is a link": (
        {"a.xacro": _data("package://home/keys.yaml"), "package.xml": f"{_LINK}../../secret.urdf"},
        "check a.xacro",
    ),
    "xacro: variables": (
        {"a.xacro": _body("".join(f'<link name="$(optenv {name} x)_{n}"/>' for n, name in enumerate(VARIABLES)))},
        "check a.xacro",
    ),
    "xacro: variables, to a file": (
        {"a.xacro": _body('<link name="a$(optenv DBPASS x)"/>')},
        "convert a.xacro --to sdf",
    ),
    "xacro: a variable in eval": ({"a.xacro": _body("<link name=\"$(eval env('MY_PW'))\"/>")}, "check a.xacro"),
    "xacro: variables that a configuration gives": (
        {"a.xacro": _body('<link name="$(env DBPASS)"/>'), "twinform.toml": 'env = ["*"]'},
        "check a.xacro",
    ),
    # marks that try to widen the root
    "root: folders of a configuration": (
        {"a.xacro": _data("../../keys.yaml"), "twinform.toml": 'paths = ["../.."]'},
        "check a.xacro",
    ),
    "root: a configuration that is a link": (
        {"a.xacro": _body(""), "twinform.toml": f"{_LINK}../../secret.toml"},
        "check .",
    ),
    "root: a repository below": (
        {"p/a.xacro": _data("../../../keys.yaml"), "p/.git": "gitdir: ../../.."},
        "check p/a.xacro",
    ),
    # what models read
    "sdf: an include": ({"a.sdf": _include("../../secret.sdf")}, "check --expand-includes a.sdf"),
    "sdf: an include by a link": (
        {"a.sdf": _include("b.sdf"), "b.sdf": f"{_LINK}../../secret.sdf"},
        "convert a.sdf --to urdf",
    ),
    "sdf: an include that is no model": (
        {"a.sdf": _include("b.sdf"), "b.sdf": f"{SECRET}\n<a"},
        "check --expand-includes a.sdf",
    ),
    "sdf: a model.config that is a link": (
        {"a.sdf": _include("model://m"), "m/model.config": f"{_LINK}../../../secret.sdf", "m/model.sdf": _model("")},
        "check --expand-includes a.sdf",
    ),
    "sdf: a model.config that leads out": (
        {"a.sdf": _include("model://m"), "m/model.config": "<model><sdf>../../../secret.sdf</sdf></model>"},
        "check --expand-includes a.sdf",
    ),
    "mesh: a triangle count outside": ({"a.urdf": _mesh("../../secret.obj")}, "stats a.urdf"),
    "mesh: by a link": ({"a.urdf": _mesh("b.obj"), "b.obj": f"{_LINK}../../secret.obj"}, "stats a.urdf"),
    "mesh: a name that is nearly right": ({"a.urdf": _mesh("../../secret.ob")}, "check a.urdf"),
    # files that commands find or are named
    "link: found in a folder": ({"a.urdf": f"{_LINK}../../.netrc"}, "check ."),
    "link: a model, found in a folder": ({"a.urdf": f"{_LINK}../../secret.urdf"}, "check ."),
    "link: a xacro file, found in a folder": ({"a.xacro": f"{_LINK}../../.netrc"}, "check ."),
    "link: of an archive": ({"a.tgz": f"{_LINK}../../.netrc"}, "batch check a.tgz"),
    "link: named": ({"a.urdf": f"{_LINK}../../secret.urdf"}, "convert a.urdf --to sdf"),
    "link: through a folder": ({"up": f"{_LINK}../..", ".git/HEAD": ""}, "check up/secret.urdf"),
    "link: of .gitignore": ({"a.urdf": _body(""), ".gitignore": f"{_LINK}../../.netrc", ".git/HEAD": ""}, "check ."),
    "link: of a baseline": (
        {"a.urdf": _body(""), "b.json": f"{_LINK}../../secret.json"},
        "check a.urdf --baseline b.json",
    ),
    "link: of a reproducer": ({"r.json": f"{_LINK}../../secret.json"}, "reproduce r.json"),
    "link: to standard input": ({"a.urdf": f"{_LINK}/dev/stdin"}, "check ."),
    "link: to memory": ({"a.urdf": f"{_LINK}/proc/self/environ"}, "check a.urdf"),
}
PIPES = ("check .", "check a.urdf", "convert a.urdf --to sdf", "format --check .", "reproduce a.urdf", "stats a.urdf",
         "graph a.urdf", "check b.xacro", "batch check a.tgz", "diff a.urdf a.urdf")  # fmt: skip
REWRITES = {
    "format": "format .",
    "format, named": "format a.urdf",
    "fix": "fix a.urdf",
    "check --fix": "check --fix --unsafe-fixes .",
    "in place": "convert a.urdf --in-place --passes fill-limits",
    "output": "convert b.urdf --to urdf -o a.urdf",
    "output, in a hidden folder": "convert b.urdf --to urdf -o hook.urdf",
    "baseline": "check b.urdf --baseline a.urdf --update-baseline",
}


@pytest.fixture
def evil(tmp_path: Path) -> Path:
    """A folder of a stranger's in the downloads of a home folder."""
    home = tmp_path / "home"
    for name, text in OUTSIDE.items():
        _put(home / name, text)
    folder = home / "Downloads/evil"
    folder.mkdir()
    return folder


def _put(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    if text.startswith(_LINK):
        path.symlink_to(text.removeprefix(_LINK))
    else:
        path.write_text(text)


def _run(command: str, evil: Path, written: int = 0) -> Outcome:
    environment = {"HOME": str(evil.parents[1]), **VARIABLES}
    return twinform(*command.split(), folder=evil, seconds=10, environment=environment, written=written)


@pytest.mark.parametrize("name", ATTEMPTS)
def test_a_secret_is_neither_printed_nor_opened(name: str, evil: Path) -> None:
    files, command = ATTEMPTS[name]
    for path, text in files.items():
        _put(evil / path, text)
    outcome = _run(command, evil)
    assert SECRET not in outcome.output
    assert "Traceback" not in outcome.output
    assert not [path for path in outcome.opened if _is_secret(path, evil)]


def _is_secret(path: str, evil: Path) -> bool:
    """Whether a file is of the home folder and none that a file of this folder may lead to."""
    # a manifest is looked at to learn what the packages beside a package are called
    is_manifest = Path(path).parent.parent == evil.parent and Path(path).name == "package.xml"
    return Path(path).is_relative_to(evil.parents[1]) and not Path(path).is_relative_to(evil) and not is_manifest


@pytest.mark.parametrize("command", PIPES)
@pytest.mark.parametrize("trap", ["pipe", "link to a pipe", "link to a device"])
def test_nothing_waits_for_a_pipe_or_device(command: str, trap: str, evil: Path) -> None:
    for name in ("a.urdf", "b.xacro", "a.tgz", ".gitignore"):
        if trap == "pipe":
            os.mkfifo(evil / name)
        else:
            (evil / name).symlink_to("/dev/zero" if trap == "link to a device" else "pipe")
    if trap == "link to a pipe":
        os.mkfifo(evil / "pipe")
    outcome = _run(command, evil, 2**20 if command.startswith("batch") else 0)
    assert outcome.code in {1, 2}, outcome.output
    assert "Traceback" not in outcome.output
    assert outcome.output.count("it is") or "leads to" in outcome.output, outcome.output


def _tree(folder: Path) -> Iterator[tuple[Path, bytes]]:
    return ((path, path.read_bytes()) for path in sorted(folder.rglob("*")) if path.is_file())


@pytest.mark.parametrize("name", REWRITES)
def test_a_link_out_of_the_folder_is_not_written_through(name: str, evil: Path) -> None:
    (evil / "a.urdf").symlink_to("../../secret.urdf")
    (evil / ".git").mkdir()
    (evil / "hook.urdf").symlink_to(".git/hook")
    if "b.urdf" in REWRITES[name]:
        (evil / "b.urdf").write_text('<robot name="b"><link name="a"/></robot>')
    before = list(_tree(evil.parents[1]))
    outcome = _run(REWRITES[name], evil, written=2**20)
    assert outcome.code != 0
    assert list(_tree(evil.parents[1])) == before
    assert "leads to" in outcome.output
    assert "meant" in outcome.output, outcome.output


def test_sources_that_are_named_may_be_reached_by_links(evil: Path) -> None:
    """An installation that colcon has made of links."""
    source, installed = evil / "src/arm", evil / "install/arm/share/arm"
    _put(source / "package.xml", "<package><name>arm</name></package>")
    _put(source / "urdf/a.urdf.xacro", _body('<xacro:include filename="$(find arm)/urdf/b.xacro"/>'))
    _put(source / "urdf/b.xacro", _body('<link name="b"/>'))
    for path in ("package.xml", "urdf/a.urdf.xacro", "urdf/b.xacro"):
        (installed / path).parent.mkdir(parents=True, exist_ok=True)
        (installed / path).symlink_to(source / path)
    outcome = _run("check install/arm/share/arm/urdf/a.urdf.xacro", evil)
    assert (outcome.code, "give its folder: --path " in outcome.output) == (1, True)
    outcome = _run("check install/arm/share/arm/urdf/a.urdf.xacro --path src/arm", evil)
    assert outcome.code == 0, outcome.output


def test_packages_beside_each_other_are_a_workspace(evil: Path) -> None:
    for name in ("a", "b"):
        _put(evil / f"src/{name}/package.xml", f"<package><name>{name}</name></package>")
    _put(evil / "src/a/a.urdf.xacro", _body('<xacro:include filename="$(find b)/b.xacro"/>'))
    _put(evil / "src/b/b.xacro", _body('<link name="b"/>'))
    outcome = _run("check src/a/a.urdf.xacro", evil)
    assert outcome.code == 0, outcome.output


@pytest.mark.parametrize("place", [".local/share/ws", ".cache/x/robot"])
def test_a_checkout_in_a_hidden_folder_works(place: str, evil: Path) -> None:
    _put(evil / place / ".git/HEAD", "")
    _put(evil / place / "urdf/a.urdf.xacro", _body('<xacro:include filename="../parts/b.xacro"/>'))
    _put(evil / place / "parts/b.xacro", _body('<link name="b"/>'))
    outcome = _run(f"check {place}/urdf/a.urdf.xacro", evil)
    assert outcome.code == 0, outcome.output
    for mark in (".git", ".hg"):
        _put(evil.parents[1] / mark / "HEAD", "")  # somebody keeps the home folder in a repository
    _put(evil / "a.xacro", _data("../../keys.yaml"))
    assert SECRET not in _run("check a.xacro", evil).output


def test_a_variable_that_is_kept_back_is_said_and_can_be_given(evil: Path) -> None:
    _put(evil / "a.xacro", _body('<link name="$(optenv GZ_X left)"/>'))
    outcome = _run("check a.xacro", evil)
    assert (outcome.code, "'GZ_X' is set" in outcome.output, "--env GZ_X" in outcome.output) == (0, True, True)
    outcome = _run("convert a.xacro --env GZ_? --to urdf", evil)
    assert f'name="{SECRET}"' in outcome.output
    _put(evil / "twinform.toml", 'env = ["GZ_*"]')
    assert SECRET not in _run("convert a.xacro --to urdf", evil).output
    assert SECRET in _run("convert a.xacro --to urdf --trust-config", evil).output
