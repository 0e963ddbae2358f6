"""Options that choose by name are lists of patterns in every pass."""

import pytest

from twinform.passes import find_pass, parse_pipeline, registered_passes
from twinform.passes.framework.pass_base import EVERY, matches, with_such_a_name
from twinform.passes.framework.pass_page import options
from twinform.passes.joints.fill_limits import FillLimits

CHOOSING = {"collisions", "joints", "lights", "links", "plugins", "sensors", "visuals"}


@pytest.mark.parametrize("name", [name for name, each in registered_passes().items() if each.owner == "twinform"])
def test_what_chooses_by_name_has_one_type_and_one_description(name: str) -> None:
    shape = with_such_a_name("")
    found = {each.name: each for each in options(find_pass(name)) if each.name in CHOOSING or "wildcard" in each.text}
    assert found.keys() <= CHOOSING | {"keep"}
    for each in found.values():
        assert each.type == "list of text"
        assert each.value in ([], list(EVERY))
        assert each.text.endswith(shape)


@pytest.mark.parametrize(
    ("written", "patterns"),
    [
        ("left_*", ("left_*",)),
        ('"arm_[0-9]"', ("arm_[0-9]",)),
        ("[left_*,right_*]", ("left_*", "right_*")),
        ("[]", ()),
    ],
)
def test_one_pattern_needs_no_brackets(written: str, patterns: tuple[str, ...]) -> None:
    text = f"fill-limits{{effort=100 joints={written}}}"
    pipeline = parse_pipeline(text)
    assert tuple(pipeline) == (FillLimits(effort=100, joints=patterns),)
    assert str(pipeline) == text


def test_one_of_the_patterns_has_to_match() -> None:
    assert matches("left_knee", ("right_*", "left_*"))
    assert not matches("Left_knee", ("left_*",))
    assert not matches("left_knee", ())
    assert matches(None, EVERY)
