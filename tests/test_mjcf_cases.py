"""The case files of MJCF: what is reported where a model is converted, and what it becomes."""

import re
from pathlib import Path
from typing import Literal

import pytest

import twinform
from tests.expected import assert_expected
from twinform.compiler.audit import audit
from twinform.testing import MjcfCase, mjcf_cases

_CASES = Path(__file__).parent / "cases/to_mjcf"


def _name(case: MjcfCase) -> str:
    return str(case.path.relative_to(_CASES))


_ALL = pytest.mark.parametrize("case", mjcf_cases(_CASES), ids=_name)


@_ALL
def test_the_conversion_reports_what_the_case_announces(case: MjcfCase) -> None:
    assert case.mismatches() == []


@_ALL
def test_the_case_becomes_the_mjcf_beside_it(case: MjcfCase) -> None:
    assert_expected(case.text, case.output_path)


_SOURCES = [
    path
    for folder in ("convert", "elements", "to_mjcf", "whole")
    for path in sorted((_CASES.parent / folder).iterdir())
    if path.suffix in {".urdf", ".sdf"} and ".expected" not in path.name
]
_FOLDED = frozenset({"chains_fold.urdf"})
"""Robots with chains that a conversion made, whose links are no bodies again."""


@pytest.mark.parametrize("path", _SOURCES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_every_part_is_in_the_mjcf_or_in_the_ledger(path: Path) -> None:
    made = _converted(path)
    if made is None or path.name in _FOLDED:
        return
    assert made.source is not None
    unaccounted = audit(made.source, made.text, made.ledger).unaccounted
    assert [f"{each.location.path}: {each.text}" for each in unaccounted] == []


_MJCF = sorted([*(_CASES.parent / "mjcf").glob("*.mjcf"), *_CASES.glob("*.expected.xml")])


_WITH_PREFIXES = frozenset({"error_prefixes.mjcf", "prefixes.mjcf"})
"""Their namespaces have made-up prefixes in JSON."""


@pytest.mark.parametrize("to", ["sdf", "mjcf"])
@pytest.mark.parametrize(
    "path", [each for each in _MJCF if each.name not in _WITH_PREFIXES], ids=lambda path: path.name
)
def test_a_file_of_mjcf_comes_back_from_json_as_from_itself(path: Path, to: Literal["sdf", "mjcf"]) -> None:
    try:
        expected = twinform.convert(path, to=to, passes="check-inertia", comments=False).text
    except twinform.CompileError:
        pytest.skip("refused")
    as_json = twinform.convert(path, to="json").text
    made = twinform.convert(as_json.encode(), to=to).text
    # JSON has no lines, by which parts that stand behind the bodies in their own come behind these.
    assert sorted(made.splitlines()) == sorted(expected.splitlines())


_FOLLOWED = frozenset({
    "actuators.mjcf", "attached_twice.mjcf", "chains.expected.xml", "includes.mjcf", "looks.expected.xml",
    "servos_of_classes.mjcf",
})  # fmt: skip
"""Cases whose entries stand where a part is used, or is written in the end, and not where the file has its words."""


@pytest.mark.parametrize("carriers", [True, False])
@pytest.mark.parametrize("to", ["sdf", "urdf"])
@pytest.mark.parametrize("path", _MJCF, ids=lambda path: path.name)
def test_every_part_of_mjcf_is_in_the_result_or_in_the_ledger(
    path: Path, to: Literal["sdf", "urdf"], carriers: bool
) -> None:
    made = _converted(path, to, carriers=carriers)
    if made is None or path.name == "replicates.mjcf":  # what names a part that is copied names the copies
        return
    assert made.source is not None
    found = audit(made.source, made.text, made.ledger)
    if carriers or path.name not in _FOLLOWED:
        assert [f"{each.location.path}: {each.text}" for each in found.unaccounted] == []
    assert made.ledger.expressed + sum(each.weight for each in made.ledger.entries) == found.total
    assert carriers or not _has_ours(made)


def _has_ours(made: twinform.Conversion) -> bool:
    """Whether a result has anything that only twinform reads."""
    return re.search("urn:twinform|tf:|twinform:", made.text) is not None


@pytest.mark.parametrize("path", _SOURCES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_mjcf_without_carriers_has_nothing_of_ours(path: Path) -> None:
    made = _converted(path, carriers=False)
    assert made is None or not _has_ours(made)


def _converted(
    path: Path, to: Literal["sdf", "urdf", "mjcf"] = "mjcf", *, carriers: bool = True
) -> twinform.Conversion | None:
    """The conversion of a case; None where it is refused."""
    try:
        return twinform.convert(path, to=to, comments=False, carriers=carriers)
    except twinform.CompileError:
        return None


_FROM = sorted((_CASES.parent / "from_mjcf").glob("*.mjcf"))


@pytest.mark.parametrize("case", _FROM, ids=lambda case: case.stem)
def test_a_file_of_mjcf_becomes_the_sdf_beside_it(case: Path) -> None:
    assert_expected(twinform.convert(case, to="sdf").text, case.with_suffix(".expected.sdf"))
