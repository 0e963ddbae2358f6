"""The loaders that profiles describe: their verdicts, what they keep, and how little of them it takes to stop us."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from testbed.engines.readers import LOADERS, USUAL, Kept, Loader, Reader, Reading, Verdict
from testbed.engines.readers.meshless import without_meshes
from testbed.engines.readers.recalled import Recalled
from twinform.profiles import load
from twinform.profiles.profile import PORTABLE, releases_of

INERTIAL = '<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
ROBOT = f"""<robot name="r"><link name="a">{INERTIAL}</link><link name="b">{INERTIAL}</link>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"""
SILENT = {"check_urdf"}
"""Readers that do not tell what they keep."""
BROKEN = ROBOT.replace('<child link="b"/>', "")


@pytest.fixture(params=LOADERS, ids=lambda loader: loader.consumer)
def loader(request: pytest.FixtureRequest) -> Iterator[Loader]:
    chosen: Loader = request.param
    if not chosen.reader.present():
        pytest.skip(f"{chosen.consumer} is not here: it needs {chosen.reader.needs}")
    yield chosen
    chosen.reader.close()


def _written(folder: Path, text: str) -> Path:
    path = folder / "robot.urdf"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_loader_accepts_refuses_and_says_what_it_keeps(loader: Loader, tmp_path: Path) -> None:
    reading = loader.ask(_written(tmp_path, ROBOT))
    assert loader.verdict(reading) is Verdict.ACCEPTS, reading
    if loader.reader.name not in SILENT:
        assert reading.kept is not None
        assert "b" in reading.kept.links
        assert reading.kept.joints == ("j",)
        assert 2 in reading.kept.masses.values()
    refused = loader.ask(_written(tmp_path, BROKEN))
    assert loader.verdict(refused) is Verdict.REFUSES, refused
    assert refused.kept is None
    assert loader.reader.version()


def test_every_release_that_was_seen_has_a_loader_and_packages_are_of_its_version() -> None:
    tested = [each.name for each in load(PORTABLE)]
    seen = {f"{name}@{each.name}": each.seen for name in tested for each in releases_of(name) if each.seen}
    assert {loader.consumer for loader in LOADERS} == set(seen)
    assert {loader.profile for loader in USUAL} == set(tested)
    for loader in LOADERS:
        assert loader.package is None or loader.package[1] == loader.reader.version() == seen[loader.consumer]


def test_a_reader_whose_process_is_ended_is_asked_again(tmp_path: Path) -> None:
    loader = next(each for each in LOADERS if each.profile == "urdf-parser-py")
    if not loader.reader.present():
        pytest.skip(loader.reader.needs)
    path = _written(tmp_path, ROBOT)
    before = loader.ask(path)
    process = loader.reader._process  # pyright: ignore[reportPrivateUsage] - to end it
    assert process is not None
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert loader.ask(path) == before
    loader.reader.close()


def test_a_reading_is_asked_for_once(tmp_path: Path) -> None:
    path, asked = _written(tmp_path, ROBOT), list[Path]()

    class Counted(Reader):
        def ask(self, path: Path) -> Reading:
            asked.append(path)
            return Reading("", "words", Kept(("a",), (), {"a": 1.0}))

    reader = Counted("counted", frozenset({".urdf"}), "", lambda: True, lambda: "1")
    recalled = Recalled(tmp_path / "deep" / "readings.sqlite")
    assert recalled.ask(reader, path) == recalled.ask(reader, path)
    assert recalled.ask(reader, path).kept == Kept(("a",), (), {"a": 1.0})
    assert len(asked) == 1
    path.write_text(BROKEN, encoding="utf-8")
    recalled.ask(reader, path)
    assert len(asked) == 2


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<mesh filename='a>b.stl' scale='1 1 1'/>", '<box size="0.1 0.1 0.1"/>'),
        ("<mesh filename='a'>\n</mesh>x", '<box size="0.1 0.1 0.1"/>\nx'),
        ("<mesh><uri>a</uri></mesh>", "<box><size>0.1 0.1 0.1</size></box>"),
        (
            "<!-- <mesh filename='a'/> --><mesh filename='b'/>",
            "<!-- <mesh filename='a'/> --><box size=\"0.1 0.1 0.1\"/>",
        ),
        ("<mesh filename='a'<mesh filename='b'/>", "<mesh filename='a'<box size=\"0.1 0.1 0.1\"/>"),
        ("<meshes/><mesh", "<meshes/><mesh"),
    ],
)
def test_a_box_stands_for_a_mesh(text: str, expected: str) -> None:
    assert without_meshes(text.encode()).decode() == expected
