"""The page about hostile input: each kind has a row and a section, and each section names tests that exist."""

import re
from pathlib import Path

import pytest

from fuzz.table import TARGETS

_ROOT = Path(__file__).parents[1]
_TEXT = (_ROOT / "docs" / "explanation" / "hostile-input.md").read_text(encoding="utf-8")
KINDS = (
    "Models", "MJCF", "xacro", "SRDF and parameters", "JSON of the IR", "Configurations", "Path patterns", "Baselines",
    "Reproducers", "Meshes and textures", "USD", "Archives", "Manifests", "The cache of Fuel",
    "Results of earlier runs", "File names and links", "Environment variables", "The editor's protocol",
    "The tools of agents", "The 3D view", "Batches and Dask", "Passes and plugins of others",
)  # fmt: skip
_SECTIONS = dict(re.findall(r"^## (.+)\n((?:(?!## ).*\n)*)", _TEXT, re.MULTILINE))
_ROW = re.compile(r"^\| \[(.+?)\]\(#.+?\)((?: \| [^|\n]+){5}) \|$", re.MULTILINE)


def test_every_kind_has_a_row_and_a_section() -> None:
    assert tuple(name for name, _ in _ROW.findall(_TEXT)) == tuple(_SECTIONS) == KINDS


@pytest.mark.parametrize("kind", KINDS)
def test_a_section_names_tests_that_there_are(kind: str) -> None:
    held = _SECTIONS[kind].partition("Held by:")[2]
    tests = re.findall(r"`(tests/[^`]+)`", held)
    assert tests
    assert [name for name in tests if "def test_" not in (_ROOT / name).read_text(encoding="utf-8")] == []


def test_every_fuzz_target_holds_something() -> None:
    named = {name for each in re.findall(r"\(targets?\s([^)]*)\)", _TEXT) for name in re.findall(r"`(\w+)`", each)}
    assert named == {*TARGETS} - {"pipeline"}, "pipelines come from the command line and from configurations"
