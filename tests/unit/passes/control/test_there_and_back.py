from pathlib import Path
from typing import Literal

import pytest

import twinform

CASES = Path(__file__).parents[3] / "cases/passes/control"
THERE, BACK = "ros2-control-from-transmissions", "transmissions-from-ros2-control"


@pytest.mark.parametrize("language", ["urdf", "sdf"])
def test_there_back_and_there_is_there(language: Literal["urdf", "sdf"]) -> None:
    once = twinform.convert(CASES / f"simple.{language}", to=language, passes=THERE).text
    thrice = twinform.convert(once.encode(), to=language, passes=f"{BACK},{THERE}").text
    assert thrice == once
