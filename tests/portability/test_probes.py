"""Small robots with one thing changed: what each loader does with them, and that its profile says so.

`probes/SUBJECT.toml` has changes of `probes/robot.urdf`, a text and another one for it, and a letter for each loader in
the order of `CONSUMERS`: `.` accepts, `w` warns, `R` refuses. All were measured; the loaders that are here are asked
about some of them again, and about all in the deep profile. Of other releases, it is the table that says what they do.
"""

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from testbed.engines.readers import LOADERS, Loader
from tests.profile import DEEP
from twinform.profiles.walking import read_as

FOLDER = Path(__file__).with_name("probes")
CONSUMERS = (
    "urdfdom@3.0", "pinocchio@4", "pybullet@3.2", "yourdfpy@0.0.60", "urdf-parser-py@0.0.4", "drake@1.51", "mujoco@4.0",
    "usd@0.3", "gazebo@fortress", "dart@6.20",
)  # fmt: skip
"""The loaders of the letters."""
TABLES = tuple(name for name in CONSUMERS if name != "gazebo@fortress")
"""Those of which all is in their tables; libsdformat has more to say about what urdfdom reads."""
ELSEWHERE = 3 if DEEP else 211
"""Loaders are asked about one probe in so many."""
UNTOLD = {
    "pybullet": {"text: a null character"},
    "drake": {
        # files that are not there, and numbers that overflow
        "axis: xyz: '0 0 1e300'", "material: texture", "material: color and texture", "material: texture by package",
        "material: global, with a texture", "material: global with the color in a visual with a texture",
        "limit: lower: hexadecimal", "dynamics: friction: hexadecimal",
        "geometry: radius of a cylinder: '0x10'", "geometry: length of a cylinder: '0x10'",
    },
    "dart": {"name: link: world"},
    "mujoco": {
        "axis: xyz: '0 0 1e300'", "material: nan", "robot: Robot",
    },
    "newton": {
        "material: texture", "material: color and texture", "material: texture by package",
        "material: global, with a texture", "material: global with the color in a visual with a texture",
    },
    "usd": {
        "name: robot: a back slash", "material: texture", "material: color and texture", "material: texture by package",
        "material: global, with a texture",
    },
}  # fmt: skip
"""What tables do not tell, by the loader: what depends on other files, and what hardly any file has."""


@dataclass(frozen=True, slots=True)
class Probe:
    """A changed robot, and a letter for each loader."""

    name: str
    text: bytes
    verdicts: str


@cache
def probes() -> tuple[Probe, ...]:
    return tuple(probe for path in sorted(FOLDER.glob("*.toml")) for probe in _of(path))


def _of(path: Path) -> Iterator[Probe]:
    robot = (FOLDER / "robot.urdf").read_text(encoding="utf-8")
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    for row in table.get("probe", ()):
        yield Probe(f"{path.stem}: {row['name']}", _changed(robot, row["changes"]), row["verdicts"])
    for row in table.get("values", ()):
        for value, verdicts in row["verdicts"]:
            change = [[row["find"], row["write"].replace("{}", value)]]
            yield Probe(f"{path.stem}: {row['name']}: {value!r}", _changed(robot, change), verdicts)


def _changed(text: str, changes: list[list[str]]) -> bytes:
    for find, write in changes:
        assert find in text, find
        text = text.replace(find, write, -1 if find == "\n" else 1)
    return text.encode()


def _letter(loader: Loader, path: Path) -> str:
    return {"accepts": ".", "warns": "w", "refuses": "R"}[loader.verdict(loader.ask(path))]


def test_there_are_probes_of_every_kind() -> None:
    assert len(probes()) > 1000
    for at, _ in enumerate(CONSUMERS):
        assert {probe.verdicts[at] for probe in probes()} == set(".wR")


def _is_told(consumer: str, probe: Probe, verdict: str) -> bool:
    """Whether a table says of a probe what the loader does with it."""
    effects = {each.effect for each in read_as(consumer, probe.text)}
    said = "R" if "refuses" in effects else "w" if effects else "."
    is_told = said == verdict or (said == "w" and verdict == "." and effects != {"warns"})
    return is_told or probe.name in UNTOLD.get(consumer.partition("@")[0], ())


@pytest.mark.parametrize("consumer", TABLES)
def test_a_table_says_what_the_loader_does(consumer: str) -> None:
    at = CONSUMERS.index(consumer)
    some = probes()[:: 1 if DEEP else 3]
    wrong = [f"{each.name}: {each.verdicts[at]}" for each in some if not _is_told(consumer, each, each.verdicts[at])]
    assert wrong == []


@pytest.mark.parametrize("loader", LOADERS, ids=lambda loader: loader.consumer)
def test_a_loader_does_what_is_written_of_it(loader: Loader, tmp_path: Path) -> None:
    if not loader.reader.present():
        pytest.skip(f"{loader.consumer} is not here: it needs {loader.reader.needs}")
    path = tmp_path / "robot.urdf"
    for probe in probes()[::ELSEWHERE]:
        path.write_bytes(probe.text)
        found = _letter(loader, path)
        if loader.consumer in CONSUMERS:
            assert found == probe.verdicts[CONSUMERS.index(loader.consumer)], probe.name
        else:
            assert _is_told(loader.consumer, probe, found), (probe.name, found)
    loader.reader.close()
