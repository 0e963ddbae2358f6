"""Nested models and the scopes of the names in them."""

from twinform.ir import Document, Format, Include, Link, Model, World
from twinform.ir.groups import Groups, tops
from twinform.ir.scopes import (
    nested_includes,
    nested_models,
    nested_names,
    outer_models,
    scoped_links,
    scoped_models,
    scopes_of,
)

_GRIPPER = Model(name="gripper", links=(Link(name="palm"),), includes=(Include(uri="model://finger"),))
_ARM = Model(name="arm", links=(Link(name="elbow"),), models=(_GRIPPER,))
_ROBOT = Model(name="robot", links=(Link(name="base"),), models=(_ARM, Model(name="head")))


def test_models_come_from_the_outside_in_with_the_prefixes_of_their_names() -> None:
    assert [*scoped_models(_ROBOT)] == [
        ("", _ROBOT),
        ("arm::", _ARM),
        ("arm::gripper::", _GRIPPER),
        ("head::", Model(name="head")),
    ]
    assert [*nested_models(_ARM)] == [_ARM, _GRIPPER]
    assert [*nested_names(_ROBOT)] == ["arm", "arm::gripper", "head"]
    assert [name for name, _ in scoped_links(_ROBOT)] == ["base", "arm::elbow", "arm::gripper::palm"]
    assert [each.uri for each in nested_includes(_ROBOT)] == ["model://finger"]


def test_a_scoped_name_is_in_models_from_the_outside_in() -> None:
    assert [*scopes_of("arm::gripper::palm")] == ["arm", "arm::gripper"]
    assert [*scopes_of("base")] == []
    assert [*scopes_of("a:::b")] == ["a", "a:"]  # as every text that the name begins with, before `::`


def test_models_of_worlds_are_outer_ones() -> None:
    document = Document(format=Format.SDF, models=(_ROBOT,), worlds=(World(name="default", models=(_ARM,)),))
    assert [each.name for each in outer_models(document)] == ["robot", "arm"]


def test_joined_names_are_one_group() -> None:
    groups = Groups()
    assert groups.join("a", "b")
    assert groups.join("b", "c")
    assert not groups.join("c", "a")
    assert groups.find("c") == "a"
    assert groups.find("d") == "d"


def test_a_chain_has_one_top_and_a_circle_the_name_that_is_met_again() -> None:
    assert tops(["c", "a", "d"], {"c": "b", "b": "a"}) == {"a": "a", "b": "a", "c": "a", "d": "d"}
    assert tops(["x", "y"], {"x": "y", "y": "x"}) == {"x": "x", "y": "x"}
