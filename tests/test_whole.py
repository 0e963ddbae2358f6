"""Files that use a whole part of the language: nothing in them is unknown, and nothing is lost on any way."""

from pathlib import Path

import pytest

import twinform
from tests.oracles.xml_trees import first_difference
from twinform.diagnostics import Fate, Severity
from twinform.ir import Document, Format

_FILES = sorted((Path(__file__).parent / "cases/whole").glob("*"))
_SDF = [path for path in _FILES if path.suffix == ".sdf"]
_OUTSIDE = "outside-model"
"""The rule for parts of a world that are no part of a robot."""


def _name(path: Path) -> str:
    return path.name


def _read(path: Path) -> Document:
    checked = twinform.check(path)
    assert [each.message for each in checked.diagnostics if each.severity > Severity.INFO] == []
    assert checked.document is not None
    return checked.document


def _models(document: Document) -> list[str | None]:
    inside = [f"{world.name}::{model.name}" for world in document.worlds for model in world.models]
    return [*inside] or [None]


@pytest.mark.parametrize("path", _FILES, ids=_name)
def test_it_is_written_as_it_was_read(path: Path) -> None:
    document = _read(path)
    if document.format is Format.SDF:
        text = twinform.convert(path, to="sdf", sdf_version=document.version).text
    else:
        text = twinform.convert(path, to="urdf").text
    assert first_difference(path.read_bytes(), text.encode()) is None


@pytest.mark.parametrize("path", _FILES, ids=_name)
def test_the_other_format_expresses_or_carries_all_of_a_robot(path: Path) -> None:
    document = _read(path)
    to = "urdf" if document.format is Format.SDF else "sdf"
    for model in _models(document):
        made = twinform.convert(path, to=to, model=model)
        dropped = [entry for entry in made.ledger.entries if entry.fate is Fate.DROPPED]
        assert [entry.message for entry in dropped if entry.rule.name != _OUTSIDE] == []
        assert twinform.check(made.text.encode()).accepted


@pytest.mark.parametrize("version", ["1.4", "1.6", "1.9"])
@pytest.mark.parametrize("path", [path for path in _SDF if "1_4" not in path.name], ids=_name)
def test_an_older_version_brings_it_back(path: Path, version: str) -> None:
    older = twinform.convert(path, to="sdf", sdf_version=version)
    again = twinform.convert(older.text.encode(), to="sdf", sdf_version=_read(path).version)
    assert {entry.fate for entry in older.ledger.entries} <= {Fate.CARRIED}
    assert first_difference(path.read_bytes(), again.text.encode()) is None


@pytest.mark.parametrize("path", [path for path in _SDF if "1_4" in path.name], ids=_name)
def test_old_words_become_new_ones_without_a_loss(path: Path) -> None:
    newer = twinform.convert(path, to="sdf", sdf_version="1.12")
    assert [entry.message for entry in newer.ledger.entries if entry.fate is Fate.DROPPED] == []
    assert twinform.check(newer.text.encode(), strict=True).accepted
