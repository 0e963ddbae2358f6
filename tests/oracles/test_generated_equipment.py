"""What generated models have for Gazebo is what libsdformat finds in them once they are converted, or it is said."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, assume, given, settings

from testbed.corpus.files import CorpusFile, Kind
from testbed.equipment.judging import Verdict, judged_sdf, judged_urdf
from tests.oracles.equipped import equipped_models, equipped_robots
from tests.profile import examples
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import RobotRow, describing

Read = Callable[[Path], RobotRow]
_GOOD = {Verdict.SAME, Verdict.SAID}
_SETTINGS = settings(examples(), suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)


@pytest.fixture(scope="module")
def read() -> Iterator[Read]:
    """The robot that libsdformat sees in a file."""
    if not libsdformat.available():
        pytest.skip(libsdformat.MISSING)
    with describing() as found:
        yield found


@_SETTINGS
@given(text=equipped_models())
def test_gazebo_finds_in_our_urdf_what_a_generated_model_has(text: str, read: Read, tmp_path: Path) -> None:
    file, before = _read(text, tmp_path / "model.sdf", Kind.SDF, read)
    found = judged_sdf(file, None, before, read)
    assert (found.verdict in _GOOD, found.cause) == (True, "")


@_SETTINGS
@given(text=equipped_robots())
def test_gazebo_finds_in_our_sdf_what_it_finds_in_a_generated_urdf(text: str, read: Read, tmp_path: Path) -> None:
    file, _ = _read(text, tmp_path / "robot.urdf", Kind.URDF, read)
    found = judged_urdf(file, read)
    assert (found.verdict in _GOOD, found.cause) == (True, "")


def _read(text: str, path: Path, kind: Kind, read: Read) -> tuple[CorpusFile, RobotRow]:
    """The text as a file, if libsdformat takes it."""
    path.write_text(text, encoding="utf-8")
    try:
        robot = read(path)
    except RuntimeError:
        assume(False)
        raise
    return CorpusFile(str(path), kind, {}), robot
