"""Which `<gazebo>` tags libsdformat applies to which shapes; that it does so is asked in `tests/oracles`."""

import pytest

import twinform
from twinform.ir import Model
from twinform.passes.shared.gazebo_tags import lumped_links
from twinform.passes.structure.tag_shapes import seen_shapes, tagged_links, tagging_links

_SHAPE = "<collision{}><geometry><sphere radius='1'/></geometry></collision>"
_LINK = "<link name='{}'>{}</link>"
_FIXED = "<joint name='{0}' type='fixed'><parent link='{1}'/><child link='{2}'/></joint>"


def _model(body: str) -> Model:
    return twinform.loads(f"<robot name='r'>{body}</robot>").models[0]


def _chain(*preserved: str) -> Model:
    """Links a, b and c, of which each hangs on the one before, with an unnamed collision and one called `x`."""
    links = "".join(_LINK.format(name, _SHAPE.format("") + _SHAPE.format(" name='x'")) for name in "abc")
    tags = "".join(
        f"<gazebo reference='{name}'><preserveFixedJoint>1</preserveFixedJoint></gazebo>" for name in preserved
    )
    return _model(links + _FIXED.format("ab", "a", "b") + _FIXED.format("bc", "b", "c") + tags)


def test_links_are_lumped_into_the_first_of_a_chain_unless_their_joint_is_preserved() -> None:
    assert lumped_links(_chain()) == {"a": "a", "b": "a", "c": "a"}
    assert lumped_links(_chain("ab")) == {"a": "a", "b": "b", "c": "b"}
    assert lumped_links(_chain("ab", "bc")) == {"a": "a", "b": "b", "c": "c"}


def test_links_that_are_fixed_in_a_circle_come_to_an_end() -> None:
    links = "".join(_LINK.format(name, "") for name in "ab")
    model = twinform.check(
        f"<robot name='r'>{links}{_FIXED.format('j', 'a', 'b')}{_FIXED.format('k', 'b', 'a')}</robot>".encode()
    ).document
    assert model is None or set(lumped_links(model.models[0])) == {"a", "b"}


def test_shapes_are_numbered_in_the_link_that_they_are_lumped_into() -> None:
    assert [seen.name for seen in seen_shapes(_chain(), "collisions")] == [
        "a_collision",
        "a_fixed_joint_lump__x_collision_1",
        "a_fixed_joint_lump__b_collision_2",
        "a_fixed_joint_lump__x_collision_3",
        "a_fixed_joint_lump__c_collision_4",
        "a_fixed_joint_lump__x_collision_5",
    ]


def test_a_named_shape_gets_the_tags_of_no_link_and_an_unnamed_one_those_of_its_own() -> None:
    model = _chain()
    found = [tagging_links(seen, "collision", lumped_links(model)) for seen in seen_shapes(model, "collisions")]
    assert found == [{"a"}, set(), {"b"}, set(), {"c"}, set()]


@pytest.mark.parametrize(
    ("element", "field"), [("mu1", "collisions"), ("collision", "collisions"), ("material", "visuals")]
)
def test_tags_are_about_one_kind_of_shapes(element: str, field: str) -> None:
    model = _model(_LINK.format("a", "") + f"<gazebo reference='a'><{element}>1</{element}></gazebo>")
    assert {field: tagged_links(model, field) for field in ("collisions", "visuals")} == {
        "collisions": set(),
        "visuals": set(),
        field: {"a"},
    }
