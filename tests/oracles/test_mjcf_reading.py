"""What is read of MJCF is the robot that MuJoCo reads: random models, and the cases that are written by hand."""

from pathlib import Path

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pydrake")

from tests.oracles.mjcf_judge import differences
from tests.oracles.mjcf_models import random_model

_CASES = Path(__file__).parents[1] / "cases/convert/mjcf"
_NO_MESHES = [each for each in sorted(_CASES.glob("*.mjcf")) if "<mesh" not in each.read_text()]


@pytest.mark.parametrize("seed", range(30))
def test_a_random_model_is_the_same_robot(seed: int, tmp_path: Path) -> None:
    source = tmp_path / "model.xml"
    source.write_text(random_model(seed))
    assert differences(source) == []


@pytest.mark.parametrize("case", _NO_MESHES, ids=lambda case: case.stem)
def test_a_case_is_the_same_robot(case: Path) -> None:
    assert differences(case) == []
