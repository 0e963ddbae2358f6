"""What is done with a model leaves no circles of references: the collector is paused, and would not break them soon."""

import gc
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import twinform

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[3] / "examples"
ROVER = EXAMPLES / "rover.urdf"


def _there_and_back() -> None:
    there = twinform.convert(ROVER, to="sdf", sdf_version="1.6").text
    twinform.convert(there.encode(), name="rover.sdf", to="urdf")


def _refused() -> None:
    with pytest.raises(twinform.CompileError):
        twinform.convert(b"<robot name='r'><link/></robot>", name="r.urdf", to="sdf")


WORK: dict[str, Callable[[], object]] = {
    "check": lambda: twinform.check(ROVER),
    "there and back": _there_and_back,
    "diff": lambda: twinform.diff(ROVER, twinform.convert(ROVER, to="sdf").text.encode()),
    "passes": lambda: twinform.convert(
        ROVER, to="sdf", passes="prefix-names{prefix=a_},lump-fixed-joints,check-inertia"
    ),
    "refused": _refused,
}


@pytest.fixture
def collected() -> Iterator[None]:
    gc.collect()
    gc.freeze()  # what other tests left need not be walked again
    gc.disable()
    yield
    gc.enable()
    gc.unfreeze()


@pytest.mark.parametrize("name", WORK)
@pytest.mark.usefixtures("collected")
def test_nothing_is_left_for_the_collector(name: str) -> None:
    WORK[name]()  # what is made once stays
    gc.collect()
    WORK[name]()
    assert gc.collect() == 0
