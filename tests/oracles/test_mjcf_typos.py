"""A misspelt name in MJCF: an error is found on its line where MuJoCo refuses the file."""

from pathlib import Path
from random import Random
from typing import Any

import pytest

import twinform
from testbed.mjcf.canonical_models import CASES, load, package_files
from testbed.typos import typos
from tests.profile import DEEP

pytestmark = pytest.mark.slow
_EACH = 20 if DEEP else 5


@pytest.mark.parametrize("path", sorted(CASES.glob("*.mjcf")), ids=lambda path: path.name)
def test_a_typo_in_a_case_is_found_on_its_line(path: Path) -> None:
    _judge(path)


def test_typos_in_files_of_packages_are_found_on_their_lines() -> None:
    files = package_files()
    if not files:
        pytest.skip("`make mjcf` downloads the packages")
    for path in files[:: 1 if DEEP else 10]:
        _judge(path)


def _judge(path: Path) -> None:
    mujoco: Any = pytest.importorskip("mujoco")
    if not _is_accepted(path) or load(mujoco, path) is None:  # MuJoCo would make a billion copies
        pytest.skip("refused as it is")
    data = path.read_bytes()
    beside = path.with_name(f".misspelt-{path.name}")
    try:
        for typo in typos(data, Random(len(data)), _EACH):
            beside.write_bytes(typo.text)
            taken = load(mujoco, beside) is not None
            errors = [each for each in twinform.check(beside, strict=True).diagnostics if each.is_error]
            assert taken or typo.line in {each.location.line for each in errors}, (typo[1:], errors)
    finally:
        beside.unlink(missing_ok=True)


def _is_accepted(path: Path) -> bool:
    return not any(each.is_error for each in twinform.check(path, strict=True).diagnostics)
