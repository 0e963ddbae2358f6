"""MuJoCo makes the same model of a file of MJCF and of its canonical tree, and refuses what we refuse."""

from pathlib import Path
from typing import Any

import pytest

from testbed.mjcf.canonical_models import CASES, canonical, differences, load, load_canonical, package_files
from twinform.diagnostics import Diagnostic, rules
from twinform.testing import cases

mujoco: Any = pytest.importorskip("mujoco")

_OF_THE_SCHEMA = frozenset({"prefixes.mjcf"})
"""What is wrong in these is found by the reader of the schema, before there is a canonical tree."""
_CASES = [case.path for case in cases(CASES) if case.path.name not in _OF_THE_SCHEMA]
_NOT_SUPPORTED = frozenset({rules.SCALED_FRAME.name, rules.OVERSIZED_FILE.name, rules.UNATTACHED_MODEL.name})
"""What MuJoCo does with these, or would if it had the memory, is not done here."""
_STEP = 8
"""The package files are tested in so many parts."""


def _name(path: Path) -> str:
    return path.name


def _refusals(found: list[Diagnostic]) -> list[str]:
    return [f"{each.location.line}: {each.message}" for each in found if each.is_error or each.refused]


@pytest.mark.parametrize("path", _CASES, ids=_name)
def test_mujoco_and_we_refuse_the_same_cases(path: Path) -> None:
    _, found = canonical(path)
    if {each.rule.name for each in found} & _NOT_SUPPORTED:
        pytest.skip("not supported")
    assert (load(mujoco, path) is None) == bool(_refusals(found))


@pytest.mark.parametrize("path", _CASES, ids=_name)
def test_the_canonical_case_is_the_same_model(path: Path) -> None:
    tree, found = canonical(path)
    if tree is None or _refusals(found):
        pytest.skip("refused")
    model = load(mujoco, path)
    assert differences(mujoco, model, load_canonical(mujoco, path, tree)) == []


@pytest.mark.slow
@pytest.mark.skipif(not package_files(), reason="`make mjcf` downloads the packages")
@pytest.mark.parametrize("part", range(_STEP))
def test_the_canonical_files_of_packages_are_the_same_models(part: int) -> None:
    wrong: list[str] = []
    for path in package_files()[part::_STEP]:
        model = load(mujoco, path)
        if model is None:
            continue
        tree, found = canonical(path)
        if tree is None or _refusals(found):
            wrong += [f"{path}: {each}" for each in _refusals(found)]
            continue
        fields = differences(mujoco, model, load_canonical(mujoco, path, tree))
        wrong += [f"{path}: {', '.join(fields)}"] if fields else []
    assert wrong == []
