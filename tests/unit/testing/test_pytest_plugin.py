"""The pytest plugin, in repositories that ask for it and in ones that do not."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

_GOOD = '<robot name="r"><link name="a"/></robot>'
_BAD = '<robot name="r"><link name="a"/>\n<link name="a"/></robot>'
_TEST = 'def test_it(load_model):\n    assert load_model("urdf/good.urdf").models[0].name == "r"\n'


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf/good.urdf").write_text(_GOOD)
    (tmp_path / "urdf/bad.urdf").write_text(_BAD)
    (tmp_path / "test_it.py").write_text(_TEST)
    return tmp_path


def _run(folder: Path, settings: str) -> str:
    (folder / "pytest.ini").write_text(f"[pytest]\n{settings}")
    command = [sys.executable, "-m", "pytest", "-v", "-p", "no:cacheprovider", "--color=no", "-W", "error"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False).stdout


def test_nothing_is_collected_where_nobody_asks(repository: Path) -> None:
    output = _run(repository, "")
    assert "1 passed" in output
    assert "good.urdf" not in output


def test_model_files_are_tests_where_somebody_does(repository: Path) -> None:
    output = _run(repository, "twinform_models = urdf/*.urdf\ntwinform_round_trip = true")
    assert "urdf/good.urdf::check PASSED" in output
    assert "urdf/good.urdf::round-trip PASSED" in output
    assert "urdf/bad.urdf::check FAILED" in output
    assert "bad.urdf:2: error: link 'a' is defined twice [duplicate-name]" in output
    assert "Traceback" not in output


def test_a_pattern_chooses_its_files(repository: Path) -> None:
    assert "2 passed" in _run(repository, "twinform_models = good.urdf")


def test_neither_pytest_nor_the_package_imports_the_compiler() -> None:
    program = "import sys, pytest, hypothesis, twinform, twinform.testing.plugin; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    heavy = {"lxml", "pydantic", "numpy", "xmlschema", "twinform.compiler", "twinform.ir"}
    assert heavy.isdisjoint(done.stdout.split())
