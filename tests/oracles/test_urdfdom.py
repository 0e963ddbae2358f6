"""Every URDF that the compiler writes is read by urdfdom without a complaint."""

from collections.abc import Iterator
from pathlib import Path

import pytest

import twinform
from testbed.corpus.files import CorpusFile, Kind
from testbed.oracles import urdfdom
from tests.corpus.portions import chunks

CHUNKS = chunks(Kind.SDF)


@pytest.fixture(autouse=True)
def reader() -> None:
    if not urdfdom.available():
        pytest.skip(urdfdom.MISSING)


@pytest.mark.parametrize("chunk", CHUNKS)
def test_urdf_made_from_real_sdf_is_read_without_a_complaint(corpus: Path, chunk: str, tmp_path: Path):
    assert corpus.is_dir()
    complaints = {name: urdfdom.complaints(path) for name, path in _converted(CHUNKS[chunk], tmp_path)}
    assert {name: found for name, found in complaints.items() if found} == {}


def _converted(files: tuple[CorpusFile, ...], folder: Path) -> Iterator[tuple[str, Path]]:
    for number, file in enumerate(files):
        path = folder / f"{number}.urdf"
        try:
            path.write_text(twinform.convert(file.path, to="urdf").text, encoding="utf-8")
        except twinform.CompileError:
            continue  # what is refused, and why, is the corpus report's business
        yield file.name, path


def test_a_fault_that_the_exit_status_hides_is_a_complaint(tmp_path: Path):
    path = tmp_path / "robot.urdf"
    path.write_text("<robot name='r'><link name='a'><visual><geometry/></visual></link></robot>")
    assert any("Geometry" in complaint for complaint in urdfdom.complaints(path))


def test_a_good_file_gives_no_complaint(tmp_path: Path):
    path = tmp_path / "robot.urdf"
    path.write_text("<robot name='r'><link name='a'/></robot>")
    assert urdfdom.complaints(path) == ()
