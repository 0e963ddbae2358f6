"""What comes home from MJCF, as the parsers of record of SDF and URDF see it: the same models as before."""

from pathlib import Path

import pytest

import twinform
from testbed.oracles import urdfdom
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import models_of
from twinform.testing.oracles.libsdformat_robot import differences
from twinform.testing.properties import RoundTrip

_CASES = sorted((Path(__file__).parents[1] / "cases" / "home_from_mjcf").iterdir())


@pytest.fixture(scope="module")
def homes(tmp_path_factory: pytest.TempPathFactory) -> dict[Path, Path]:
    """The files that came home, by those that they were."""
    folder = tmp_path_factory.mktemp("homes")
    found = {path: folder / path.name for path in _CASES}
    for path, home in found.items():
        trip = RoundTrip.of_whole(path, twinform.load(path))
        home.write_text(trip.back(twinform.convert(path, to="mjcf").text))
    return found


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
def test_libsdformat_reads_the_same_models(homes: dict[Path, Path]) -> None:
    read = {path: models for path in homes if (models := models_of(path)[1])}
    assert len(read) > len(homes) / 2  # of the others it takes no link without mass, and no name with blanks
    found = {path.name: [*differences(models, models_of(homes[path])[1])] for path, models in read.items()}
    assert {name: each for name, each in found.items() if each} == {}


@pytest.mark.skipif(not urdfdom.available(), reason=urdfdom.MISSING)
def test_urdfdom_reads_what_it_read(homes: dict[Path, Path]) -> None:
    read = [path for path in homes if path.suffix == ".urdf" and not urdfdom.complaints(path)]
    assert read
    assert {path.name: urdfdom.complaints(homes[path]) for path in read} == {path.name: () for path in read}
