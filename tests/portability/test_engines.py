"""Small robots that vary one thing each: what engines' loaders make of them, and their profiles."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

from testbed.engines.readers import USUAL, Loader
from tests.profile import DEEP
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import Assessment, Effect, parse

_INERTIAL = '<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
_LIMIT = '<limit lower="-1" upper="1" effort="10" velocity="1"/>'
_PROFILES = ("drake", "gazebo", "mujoco", "usd")
_PROBES: list[dict[str, Any]] = tomllib.loads(Path(__file__).with_name("engines.toml").read_text("utf-8"))["probe"]


def _text(probe: dict[str, Any]) -> bytes:
    return str(probe["text"]).replace("{inertial}", _INERTIAL).replace("{limit}", _LIMIT).encode()


def _agrees(verdict: str, assessment: Assessment) -> bool:
    """As `reports/loaders` judges it: a warning may come from anything, and what is dropped may be silent."""
    effects = {each.row.effect for each in assessment.judgments}
    if Effect.REFUSES in effects or verdict == "refuses":
        return Effect.REFUSES in effects and verdict == "refuses"
    return bool(effects) if verdict == "warns" else effects != {Effect.WARNS}


@pytest.mark.parametrize("probe", _PROBES, ids=lambda probe: str(probe["name"]))
def test_profiles_say_what_loaders_did(probe: dict[str, Any]) -> None:
    assessments = assess_file(_text(probe), parse(",".join(_PROFILES)), LoadOptions(), name="robot.urdf")
    wrong = [each.profile.name for each in assessments if not _agrees(probe.get(each.profile.name, "accepts"), each)]
    assert wrong == probe.get("differs", []), [judgment for each in assessments for judgment in each.judgments]


@pytest.mark.parametrize("loader", [each for each in USUAL if each.profile in _PROFILES], ids=lambda one: one.profile)
def test_loaders_still_do_it(loader: Loader, tmp_path: Path) -> None:
    if not loader.reader.present():
        pytest.skip(loader.reader.needs)
    wrong = dict[str, str]()
    for number, probe in enumerate(_PROBES[:: 1 if DEEP else 40]):
        path = tmp_path / f"{number}.urdf"
        path.write_bytes(_text(probe))
        found = loader.verdict(loader.ask(path)).value
        if found != probe.get(loader.profile, "accepts"):
            wrong[str(probe["name"])] = found
    loader.reader.close()
    assert not wrong
