"""Features: each asks a question, findings lead to them, and the table that says so names no other."""

import json
from pathlib import Path

import pytest

import twinform
from twinform.profiles import every_release
from twinform.profiles.features import PLAIN, SHOWN_BY, features, shown_by
from twinform.profiles.walking import reads

_SHOWN = json.loads(SHOWN_BY.read_text(encoding="utf-8"))
_LINES = 25
_SHARE = 0.85
"""So many of all rows of profiles are shown by a feature, at least."""


def test_each_feature_is_short_and_asks_one_question() -> None:
    found = features()
    assert PLAIN in found
    assert {each.format for each in found.values()} == {"URDF", "SDF"}
    assert [name for name, each in found.items() if len(each.text.splitlines()) > _LINES] == []
    assert [name for name, each in found.items() if not each.question.endswith("?")] == []
    assert len({each.title for each in found.values()}) == len(found)


def test_the_plain_robot_is_without_a_finding() -> None:
    assert twinform.check(features()[PLAIN].path).diagnostics == ()


def test_every_entry_leads_to_a_feature() -> None:
    assert {feature for rows in _SHOWN.values() for _, _, feature in rows} <= set(features())


def test_most_rows_of_profiles_are_shown_by_a_feature() -> None:
    rows = [shown_by(row.about, "", row.rule) for each in every_release() for row in each.rows]
    demands = [shown_by(each.about, "") for one in every_release() if one.reads for each in reads(one.reads).demands]
    shown = [*rows, *demands]
    assert sum(map(bool, shown)) >= _SHARE * len(shown)


@pytest.mark.parametrize(
    ("path", "feature"),
    [
        ("/robot[@name='x']/link[@name='y']/collision/geometry/box/@size", "shapes/size-zero"),
        ("/robot/link/visual[2]/geometry/sphere/@radius", "shapes/size-negative"),
        ("/robot/link/self_collision/shape/box/@size", "shapes/size-zero"),
    ],
)
def test_a_row_leads_to_the_feature_of_its_place_or_one_that_is_alike(path: str, feature: str) -> None:
    assert shown_by("a shape has a size", path) == feature


def test_a_row_that_nothing_shows_leads_nowhere() -> None:
    assert shown_by("it sings", "/robot") == ""
    assert shown_by("libsdformat refuses it", "/sdf/model/link", "no-such-rule") == ""


def test_a_finding_for_a_consumer_names_the_feature_below_its_passes(tmp_path: Path) -> None:
    text = features()["shapes/size-zero"].text.encode()
    (tmp_path / "a.urdf").write_bytes(text)
    found = [each for each in twinform.check(tmp_path / "a.urdf", profiles="drake").diagnostics if each.is_error]
    assert {each.help for each in found} == {
        "--passes 'tidy-shapes'\n`twinform explain shapes/size-zero` says who reads it"
    }
