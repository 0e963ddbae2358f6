"""Each row of the facts tables stands in a case file, and no part of these files is lost on any way."""

from pathlib import Path

import pytest

import twinform
from generators.mapping.measure import CASES, conversions, measured
from testbed.corpus.there_and_back import robots
from testbed.oracles.xml_trees import first_difference
from twinform.compiler.audit import audit
from twinform.diagnostics import Fate, Severity, rules
from twinform.ir import Document, Format
from twinform.server.mapping import FORMATS, FormatName, rows
from twinform.testing.properties import RoundTrip


def _name(path: Path) -> str:
    return f"{path.parent.name}/{path.name}"


_FILES = [path for folder in ("elements", "whole") for path in sorted((CASES / folder).iterdir())]
_SDF = [path for path in _FILES if path.suffix == ".sdf"]
_OLD_SYNTAX = [path for path in _SDF if path.stem.startswith("syntax") or path.stem.endswith("_1_4")]
"""Files about what later versions write in another way."""
_SCREWS = frozenset({"joints.sdf", "screw_1_10.sdf"})
"""Files with joints that SDF 1.4 does not have."""
_INCLUDING = frozenset({"world_settings.sdf"})
"""Files with includes that older versions need the contents of, which are not there."""
_OLDER = [
    pytest.param(path, version, id=f"{_name(path)}-{version}")
    for path in _SDF
    if path not in _OLD_SYNTAX
    for version in ("1.4", "1.5", "1.6", "1.9")
    if version != "1.4" or path.name not in _SCREWS
    if version == "1.9" or path.name not in _INCLUDING
]
_OUTSIDE = "outside-model"
"""The rule for parts of a world that are no part of a robot."""
_ALLOWED = frozenset({"missing-file"})
"""Warnings that some of the files are about."""


def _read(path: Path) -> Document:
    checked = twinform.check(path)
    found = [each for each in checked.diagnostics if each.severity > Severity.INFO and each.rule.name not in _ALLOWED]
    assert [each.message for each in found] == []
    assert checked.document is not None
    return checked.document


@pytest.mark.parametrize("format", FORMATS)
def test_every_row_of_the_facts_stands_in_a_case_that_is_accepted(format: FormatName) -> None:
    proved = {row for row, seen in measured().items() if seen.proof is not None}
    assert [row.path for row in rows(format) if row not in proved] == []


@pytest.mark.parametrize("path", _FILES, ids=_name)
def test_it_is_written_as_it_was_read(path: Path) -> None:
    document = _read(path)
    if document.format is Format.SDF:
        text = twinform.convert(path, to="sdf", sdf_version=document.version).text
    else:
        text = twinform.convert(path, to="urdf").text
    assert first_difference(path.read_bytes(), text.encode()) is None


@pytest.mark.parametrize("carriers", [True, False], ids=["carriers", "no_carriers"])
@pytest.mark.parametrize("path", _FILES, ids=_name)
def test_an_audit_accounts_for_every_part_there_and_back(path: Path, carriers: bool) -> None:
    for made in conversions(path, _read(path), carriers=carriers):
        assert isinstance(made, twinform.Conversion)
        assert _unaccounted(made) == []
        assert _unaccounted(twinform.convert(made.text.encode(), to=_own_format(path), carriers=carriers)) == []


@pytest.mark.parametrize("path", _FILES, ids=_name)
def test_the_other_format_drops_nothing_of_a_robot(path: Path) -> None:
    for made in conversions(path, _read(path)):
        assert isinstance(made, twinform.Conversion)
        dropped = [entry for entry in made.ledger.entries if entry.fate is Fate.DROPPED]
        assert [entry.message for entry in dropped if entry.rule.name != _OUTSIDE] == []
        assert twinform.check(made.text.encode()).accepted


@pytest.mark.parametrize("path", _FILES, ids=_name)
def test_it_comes_back_from_the_other_format_as_it_was(path: Path) -> None:
    document = _read(path)
    for robot in robots(document):
        there = twinform.convert(path, to="urdf" if _own_format(path) == "sdf" else "sdf", model=robot)
        trip = RoundTrip.of(path, document, model=robot)
        assert [one.message for one in trip.mismatches(trip.back(there.text))] == []


@pytest.mark.parametrize("path", _OLD_SYNTAX, ids=_name)
def test_the_newest_version_expresses_old_syntax_without_a_loss(path: Path) -> None:
    newer = twinform.convert(path, to="sdf", sdf_version="1.12")
    assert [entry.message for entry in newer.ledger.entries if entry.fate is Fate.DROPPED] == []
    found = [each for each in twinform.check(newer.text.encode()).diagnostics if each.severity > Severity.INFO]
    assert [each.message for each in found if each.rule.name not in {*_ALLOWED, "outside-version"}] == []


@pytest.mark.parametrize(("path", "version"), _OLDER)
def test_an_older_version_brings_it_back(path: Path, version: str) -> None:
    older = twinform.convert(path, to="sdf", sdf_version=version)
    again = twinform.convert(older.text.encode(), to="sdf", sdf_version=_read(path).version)
    lost = (entry for entry in older.ledger.entries if entry.rule is not rules.REPLACED_SHAPE)
    assert {entry.fate for entry in lost} <= {Fate.CARRIED}
    assert first_difference(path.read_bytes(), again.text.encode()) is None


def test_a_pose_in_a_frame_of_its_own_element_comes_back_from_a_version_without_such_frames() -> None:
    path = CASES / "elements/syntax_1_5.sdf"
    newer = twinform.convert(path, to="sdf", sdf_version="1.9")
    again = twinform.convert(newer.text.encode(), to="sdf", sdf_version="1.5")
    assert first_difference(path.read_bytes(), again.text.encode()) is None


def test_the_audit_does_not_take_a_whole_file_for_carried() -> None:
    made = twinform.convert(CASES / "elements/shapes.sdf", to="urdf")
    assert made.source is not None
    counted = audit(made.source, made.text, made.ledger)
    assert (counted.expressed, counted.carried) == (made.ledger.expressed, made.ledger.count(Fate.CARRIED))


def _own_format(path: Path) -> FormatName:
    return "sdf" if path.suffix == ".sdf" else "urdf"


def _unaccounted(made: twinform.Conversion) -> list[str]:
    assert made.source is not None
    parts = audit(made.source, made.text, made.ledger).unaccounted
    return [f"line {part.location.line}: {part.location.path}: {part.text}" for part in parts]
