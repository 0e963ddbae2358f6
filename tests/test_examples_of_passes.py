"""Every pass has an example that is a pipeline, and that does its work on a real model."""

from pathlib import Path

import pytest

import twinform
from twinform.passes import parse_pipeline, registered_passes

pytestmark = pytest.mark.slow

_EXAMPLES = Path(__file__).parents[1] / "examples"
_MODELS = ("four_wheels.urdf", "rover.urdf", "arm.urdf", "sensor_base.urdf", "warehouse.sdf", "crate/model.sdf")


@pytest.mark.parametrize("name", registered_passes())
def test_the_example_of_a_pass_runs_on_a_real_model(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # for what a pass writes
    example = registered_passes()[name].load().example
    assert name in [each.name for each in parse_pipeline(example)]
    refusals = dict(_refusals(example))
    assert len(refusals) < len(_MODELS), refusals


def _refusals(example: str) -> list[tuple[str, str]]:
    """The models that have an error after these passes; a pass that fails or breaks a model raises here."""
    found: list[tuple[str, str]] = []
    for model in _MODELS:
        path = _EXAMPLES / model
        to = "urdf" if path.suffix == ".urdf" else "sdf"
        try:
            twinform.convert(path, to=to, passes=example, paths=[_EXAMPLES])
        except twinform.CompileError as error:
            found.append((model, str(error)))
    return found
