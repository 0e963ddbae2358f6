"""Small models of SDF that vary one thing each: what Gazebo's engines make of them, the profile, and the conversion."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.engines import gazebo
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import Assessment, Effect, parse

_PROFILE = "gazebo@fortress"
_INERTIAL = (
    "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
    "</inertial>"
)
_PROBES: list[dict[str, Any]] = tomllib.loads(Path(__file__).with_name("gazebo.toml").read_text("utf-8"))["probe"]
_SETTINGS = gazebo.Settings(steps=200, dt=0.001, start=0.5)
_ENGINES = {"dart": gazebo.PhysicsEngine.DART, "bullet": gazebo.PhysicsEngine.BULLET}
_BY_ROUNDING = ["uncertain-inertia"]
"""What it refuses or takes by how it rounds."""
_named = pytest.mark.parametrize("probe", _PROBES, ids=lambda probe: str(probe["name"]))


def _text(probe: dict[str, Any]) -> bytes:
    return str(probe["text"]).replace("{inertial}", _INERTIAL).encode()


def _assessed(text: bytes) -> Assessment:
    (found,) = assess_file(text, parse(_PROFILE), LoadOptions(), name="model.sdf")
    return found


def _converted(probe: dict[str, Any]) -> twinform.Conversion | None:
    try:
        return twinform.convert(_text(probe), to="sdf", profiles=_PROFILE, name="model.sdf")
    except twinform.CompileError:
        return None


@_named
def test_the_profile_finds_what_engines_mind(probe: dict[str, Any]) -> None:
    found = _assessed(_text(probe))
    assert sorted({each.finding.rule.name for each in found.judgments}) == probe.get("rules", [])
    if {"refuses", "ends"} & {probe.get(engine) for engine in _ENGINES}:
        assert found.by(Effect.REFUSES) or probe["rules"] == _BY_ROUNDING
    if {"freezes", "leaves out"} & {probe.get(engine) for engine in _ENGINES}:
        assert found.judgments


@_named
def test_nothing_is_left_that_the_profile_refuses(probe: dict[str, Any]) -> None:
    made = _converted(probe)
    if made is not None:
        assert not _assessed(made.text.encode()).by(Effect.REFUSES)


@pytest.mark.parametrize("name", _ENGINES)
def test_engines_take_what_was_converted(name: str, tmp_path: Path) -> None:
    if not gazebo.available(_ENGINES[name]):
        pytest.skip(gazebo.MISSING)
    told, before = dict[Path, bool](), dict[Path, str]()
    for number, probe in enumerate(_PROBES):
        source, result = tmp_path / f"{number}.sdf", tmp_path / f"{number}.converted.sdf"
        source.write_bytes(_text(probe))
        before[source] = str(probe.get(name, "takes"))
        if (made := _converted(probe)) is not None:
            result.write_text(made.text, encoding="utf-8")
            told[result] = bool(made.diagnostics)
    seen = gazebo.simulate([*before, *told], _ENGINES[name], _SETTINGS)
    assert {path.name: _verdict(seen[path.resolve()]) for path in before} == {p.name: v for p, v in before.items()}
    for path, is_told in told.items():
        verdict = _verdict(seen[path.resolve()])
        assert verdict == "takes" or (verdict in {"freezes", "leaves out"} and is_told), path.read_text("utf-8")


def _verdict(seen: gazebo.Simulation) -> str:
    if not seen.done:
        return "refuses" if seen.outcome is gazebo.Outcome.REFUSED else "ends"
    if any(joint.kind != "fixed" and not joint.freedom for joint in seen.joints):
        return "freezes"
    return "leaves out" if seen.left_out else "takes"
