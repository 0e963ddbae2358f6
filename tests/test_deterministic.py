"""The same input gives the same bytes, whatever the order of the hash tables."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

_ROOT = Path(__file__).parents[1]
_SCRIPT = """
import json, sys
from pathlib import Path
import twinform

for path in map(Path, sys.argv[1:]):
    for to in ("urdf", "sdf", "json"):
        for version in ("1.4", "1.11") if to == "sdf" else (None,):
            try:
                model = "shelf" if path.name == "warehouse.sdf" and to == "urdf" else None
                passes = "fill-limits{effort=1 velocity=1},check-inertia"
                made = twinform.convert(path, to=to, sdf_version=version, model=model, passes=passes)
            except twinform.CompileError as error:
                print(path, to, version, *error.diagnostics, sep="\\n")
            else:
                print(path, to, version, made.text, made.ledger.to_json(), *made.diagnostics, sep="\\n")
"""
_FILES = (
    "examples/four_wheels.urdf",
    "examples/rover.urdf",
    "examples/warehouse.sdf",
    "tests/cases/check/all_at_once.urdf",
    "tests/cases/check/gazebo_conflicts.urdf",
    *sorted(str(path.relative_to(_ROOT)) for path in (_ROOT / "tests/cases/convert").glob("*.[us]*df"))[::3],
)


def _output(seed: str, *arguments: str) -> bytes:
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=_ROOT, env=environment, check=True, stdout=subprocess.PIPE).stdout


@pytest.mark.parametrize("seed", ["1", "77"])
def test_text_ledger_and_findings_are_the_same_bytes(seed: str, reference: bytes) -> None:
    assert _output(seed, "-c", _SCRIPT, *_FILES) == reference


@pytest.fixture(scope="module")
def reference() -> bytes:
    """What comes out without any hashing."""
    return _output("0", "-c", _SCRIPT, *_FILES)


@pytest.mark.parametrize(
    "command",
    [
        ("passes", "--format", "json"),
        ("explain",),
        ("convert", "examples/warehouse.sdf", "--to", "urdf", "--model", "shelf", "--print-pipeline"),
    ],
)
def test_what_commands_print_is_the_same_bytes(command: tuple[str, ...]) -> None:
    assert _output("3", "-m", "twinform", *command) == _output("0", "-m", "twinform", *command)
