"""URIs and includes that lead out of the folders, to what is no file, in circles, or to more than any memory holds."""

import os
from collections.abc import Iterable
from pathlib import Path

import pytest

from tests.hostile.child import rules, twinform

_LINK = '<link name="l"/>'


def _include(uri: str, name: str = "n") -> str:
    return f"<include><uri>{uri}</uri><name>{name}</name></include>"


def _model(inside: str) -> str:
    return f'<sdf version="1.11"><model name="m">{inside}</model></sdf>'


def _write(folder: Path, name: str, includes: Iterable[str]) -> None:
    (folder / name).write_text(_model("".join(_include(uri, f"n{n}") for n, uri in enumerate(includes)) or _LINK))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The folder of a project, with a secret outside of it and links that lead there."""
    (tmp_path / "secret.sdf").write_text(_model(_LINK))
    inside = tmp_path / "project"
    (inside / ".git").mkdir(parents=True)
    (inside / "link.sdf").symlink_to(tmp_path / "secret.sdf")
    (inside / "zero.sdf").symlink_to("/dev/zero")
    (inside / "round.sdf").symlink_to("round.sdf")
    os.mkfifo(inside / "pipe.sdf")
    return inside


URIS = {
    "../secret.sdf": "uri-leaves-folder",
    "../../../../../../../../etc/passwd": "uri-leaves-folder",
    "/etc/passwd": "uri-leaves-folder",
    "file:///etc/passwd": "uri-leaves-folder",
    "model://../secret.sdf": "uri-leaves-folder",
    "model://project/..%2f..%2fsecret.sdf": "uri-leaves-folder",
    "package://../../etc/passwd": "uri-leaves-folder",
    "https://fuel.gazebosim.org/1.0/a/models/../../../../etc/passwd": "unresolved-uri",
    "link.sdf": "uri-leaves-folder",
    "zero.sdf": "uri-leaves-folder",
    "/dev/zero": "uri-leaves-folder",
    "round.sdf": "unresolved-uri",
    "pipe.sdf": "unresolved-uri",
    ".": "broken-model-config",
    "a%00b": "unresolved-uri",
    "a&#10;b": "unresolved-uri",
    "x" * 1_000_000: "unresolved-uri",
    "x/" * 500_000: "unresolved-uri",
    "robot.sdf": "include-cycle",
}


COMMANDS = [
    pytest.param(("check", "--expand-includes"), id="check"),
    pytest.param(("convert", "--to", "urdf"), id="convert", marks=pytest.mark.deep),
]


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(("uri", "rule"), URIS.items(), ids=lambda each: each[:30])
def test_a_uri_leads_nowhere_that_it_must_not(command: tuple[str, ...], uri: str, rule: str, folder: Path) -> None:
    (folder / "robot.sdf").write_text(_model(_include(uri)))
    outcome = twinform(*command, "robot.sdf", folder=folder)
    assert (outcome.code, rules(outcome.output)) == (1, [rule]), outcome.output[:2000]
    assert outcome.output.startswith("robot.sdf:1:")
    assert len(outcome.output) < 10_000
    assert outcome.opened == {str(folder / "robot.sdf")}


def test_a_folder_that_is_named_may_be_read(folder: Path) -> None:
    (folder / "robot.sdf").write_text(_model(_include("../secret.sdf")))
    outcome = twinform("check", "--expand-includes", "--path", folder.parent, "robot.sdf", folder=folder)
    assert outcome.code == 0, outcome.output


def test_files_that_include_each_other_are_a_circle(folder: Path) -> None:
    for n in range(5):
        _write(folder, f"{n}.sdf", [f"{(n + 1) % 5}.sdf"])
    outcome = twinform("check", "--expand-includes", "0.sdf", folder=folder)
    assert rules(outcome.output) == ["include-cycle"]


@pytest.mark.parametrize(("files", "each"), [(12, 10), (31, 2), (40, 1)], ids=["ten each", "two each", "a chain"])
def test_a_bomb_of_includes_is_one_error(files: int, each: int, folder: Path) -> None:
    for n in range(files):
        _write(folder, f"{n}.sdf", [f"{n + 1}.sdf"] * each if n + 1 < files else ())
    outcome = twinform("check", "--expand-includes", "0.sdf", folder=folder)
    assert rules(outcome.output) == ["too-many-includes"], outcome.output[:2000]


def test_a_large_model_many_times_is_one_error(folder: Path) -> None:
    (folder / "large.sdf").write_text(_model("".join(f'<link name="l{n}"/>' for n in range(20_000))))
    _write(folder, "robot.sdf", ["large.sdf"] * 5_000)
    outcome = twinform("check", "--expand-includes", "robot.sdf", folder=folder)
    assert rules(outcome.output) == ["too-many-includes"], outcome.output[:2000]


def test_models_that_nest_deeper_in_every_file_are_one_error(folder: Path) -> None:
    for n in range(30):
        inside = _include(f"{n + 1}.sdf") if n < 29 else _LINK
        nested = "".join(f'<model name="m{k}">' for k in range(60)) + inside + "</model>" * 60
        (folder / f"{n}.sdf").write_text(f'<sdf version="1.11">{nested}</sdf>')
    outcome = twinform("check", "--expand-includes", "0.sdf", folder=folder)
    assert rules(outcome.output) == ["too-many-includes"], outcome.output[:2000]


def test_a_mesh_is_never_read(folder: Path) -> None:
    mesh = '<visual><geometry><mesh filename="../../../../etc/passwd"/></geometry></visual>'
    (folder / "r.urdf").write_text(f'<robot name="r"><link name="a">{mesh}</link></robot>')
    outcome = twinform("convert", "r.urdf", "--to", "sdf", folder=folder)
    assert outcome.code == 0, outcome.output
    assert outcome.opened == {str(folder / "r.urdf")}
