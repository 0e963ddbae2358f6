"""Fixes of real models, whole and with mistakes: never another robot without a word, no new finding; deep: of all."""

import re
from pathlib import Path
from random import Random

import pytest

from testbed.corpus.files import Kind, models
from testbed.fixed_files import fixed_file
from testbed.mutated.mutated import mutated
from testbed.typos import typos
from tests.corpus.portions import portions
from tests.profile import DEEP
from twinform.compiler import LoadOptions
from twinform.compiler.fixing import FixResult, apply_fixes

PORTIONS = portions(models())
_MESH = re.compile(rb'(?:filename="|<uri>)(?:(?:package|model)://)?([^"<$:]*?\.(?:stl|dae|obj|glb))', re.IGNORECASE)


@pytest.mark.parametrize("portion", PORTIONS)
def test_fixes_keep_their_promises(corpus: Path, portion: str) -> None:
    assert corpus.is_dir()
    for file in PORTIONS[portion][:: 1 if DEEP else 4]:
        assert fixed_file(str(file.path), file.path.read_bytes()).faults == (), file.name


@pytest.mark.parametrize("kind", [Kind.URDF, Kind.SDF])
def test_fixes_of_mutated_files_keep_their_promises(corpus: Path, kind: Kind) -> None:
    assert corpus.is_dir()
    verdicts = set[bool | None]()
    for seed in range(500 if DEEP else 20):
        made = mutated(kind, seed)
        fixed = fixed_file(made.file, made.text)
        assert fixed.faults == (), str(made)
        verdicts.add(fixed.same)
    assert True in verdicts, "no robot was compared with what became of it"


@pytest.mark.parametrize("portion", PORTIONS)
def test_a_misspelt_name_is_fixed_back_or_stays(corpus: Path, portion: str) -> None:
    assert corpus.is_dir()
    for file in PORTIONS[portion][:: 1 if DEEP else 8]:
        data = file.path.read_bytes()
        whole = _guessed(data, str(file.path)).data
        for typo in typos(data, Random(len(data)), 3):
            fixed = _guessed(typo.text, str(file.path))
            assert whole == fixed.data or typo.written.encode() in fixed.data, (file.name, typo[1:])


@pytest.mark.parametrize("portion", PORTIONS)
def test_a_missing_mesh_becomes_no_other_one(corpus: Path, portion: str, tmp_path: Path) -> None:
    assert corpus.is_dir()
    for number, file in enumerate(PORTIONS[portion]):
        robot, folder = _robot_of_meshes(file.path.read_bytes()), tmp_path / str(number)
        names = {each.decode(errors="replace") for each in _MESH.findall(robot)}
        gone = set(Random(len(robot)).sample(sorted(names), (len(names) + 2) // 3))
        for name in names:
            place = folder / name
            place.parent.mkdir(parents=True, exist_ok=True)
            if name not in gone:
                place.touch()
        fixed = _guessed(robot, str(folder / "robot.urdf"))
        assert [each.found for each in fixed.applied if each.rule.name == "missing-file"] == [], file.name


def _robot_of_meshes(data: bytes) -> bytes:
    """A robot with the meshes of a file, in folders below it."""
    names = sorted({b"m/" + each.strip(b"/.") for each in _MESH.findall(data) if b".." not in each})
    visuals = b"".join(b'<visual><geometry><mesh filename="' + each + b'"/></geometry></visual>' for each in names)
    return b'<robot name="r"><link name="a">' + visuals + b"</link></robot>"


def _guessed(data: bytes, name: str) -> FixResult:
    return apply_fixes(data, LoadOptions(), name=name, unsafe=True)
