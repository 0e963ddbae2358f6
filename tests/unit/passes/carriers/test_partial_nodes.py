"""What a target leaves unsaid of a node, and what says it, make the node again; and what is said always counts."""

from typing import cast

from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.diagnostics import Source
from twinform.ir import (
    Axis,
    Box,
    Cone,
    Document,
    Dynamics,
    Element,
    Format,
    Geometry,
    Inertial,
    Joint,
    Limit,
    Link,
    Model,
    Node,
    Opaque,
    Plugin,
    Pose,
    Visual,
)
from twinform.ir.record import field_values, fields_of
from twinform.passes.carriers.mjcf_texts import node_element, parse_text_name, read_node, text_name, xml_data
from twinform.passes.carriers.partial_nodes import IDENTITY, Merging, remainder
from twinform.passes.carriers.said_by_mjcf import said_by_mjcf
from twinform.testing import strategies

_MODELS = strategies.sdf_models(max_links=4).map(lambda document: document.models[0])


def said_half(node: Node) -> Node | None:
    """What MJCF says of a node, as the node that it is read as."""
    fields = said_by_mjcf(node)
    if fields is None:
        return None
    update: dict[str, object] = {"opaque": ()}
    for name, value in field_values(node).items():
        if name in IDENTITY or name in fields or name == "opaque":
            continue
        if isinstance(value, Node):
            update[name] = said_half(value)
        elif isinstance(value, tuple) and value and isinstance(value[0], Node):
            nodes = cast("tuple[Node, ...]", value)
            update[name] = tuple(half for each in nodes if (half := said_half(each)) is not None)
        else:
            update[name] = fields_of(type(node))[name].default
    return node.copy(**update)


@examples()
@given(_MODELS.flatmap(lambda model: st.sampled_from([*model.links, *model.joints, model])))
def test_what_is_said_and_the_remainder_are_the_node(node: Node) -> None:
    half, left, merging = said_half(node), remainder(node, said_by_mjcf), Merging()
    assert half is not None
    assert (merging.merge(half, left) if left else half) == node
    assert merging.stale == []


@examples()
@given(_MODELS.flatmap(lambda model: st.sampled_from([*model.links, *model.joints])))
def test_a_remainder_comes_back_from_its_text(node: Link | Joint) -> None:
    left, kind = remainder(node, said_by_mjcf), type(node).__name__.lower()
    if left is not None:
        assert read_node(xml_data(node_element(left, kind)), kind, Source("x.xml", 7, None, "text", None)) == left


_LINK = Link(
    name="arm",
    inertial=Inertial(pose=Pose(xyz=(1, 0, 0)), mass=2, opaque=(Opaque(element=Element(name="density", text="3")),)),
    visuals=(
        Visual(name="seen", geometry=Geometry(shape=Box(size=(1, 2, 3))), plugins=(Plugin(name="p"),)),
        Visual(name="tip", plugins=(Plugin(name="q"),)),
    ),
)


def _merged(node: Link | Joint, said: Node) -> tuple[Node, list[Node]]:
    left, merging = remainder(node, said_by_mjcf), Merging()
    assert left is not None
    return merging.merge(said, left), merging.stale


def test_an_edit_of_what_is_said_counts() -> None:
    said = said_half(_LINK)
    assert isinstance(said, Link)
    edited = said.copy(inertial=Inertial(mass=5))
    merged, stale = _merged(_LINK, edited)
    assert isinstance(merged, Link)
    assert merged.inertial is not None
    assert (merged.inertial.mass, merged.inertial.pose, stale) == (5, None, [])
    assert merged.inertial.opaque == (_LINK.inertial and _LINK.inertial.opaque)


def test_the_rest_of_what_was_removed_is_stale() -> None:
    merged, stale = _merged(_LINK, Link(name="arm"))
    assert merged == Link(name="arm", visuals=_LINK.visuals[1:])
    assert [type(each) for each in stale] == [Inertial, Visual]


def test_a_shape_that_became_another_one_has_no_rest_of_the_old_one() -> None:
    link = Link(name="arm", visuals=(_LINK.visuals[0],))
    said = Link(name="arm", visuals=(Visual(name="seen", geometry=Geometry(shape=Cone(radius=1))),))
    merged, _ = _merged(link, said)
    assert isinstance(merged, Link)
    assert merged.visuals[0].geometry == said.visuals[0].geometry


def test_limits_that_are_left_count_without_those_that_were_removed() -> None:
    limit = Limit(lower=-1, upper=1, velocity=3)
    axis = Axis(xyz=(0, 0, 1), limit=limit, dynamics=Dynamics(damping=1))
    joint = Joint(name="j", type="revolute", parent="a", child="b", axis=axis)
    merged, stale = _merged(joint, Joint(name="j", type="revolute", parent="a", child="b", axis=Axis(xyz=(1, 0, 0))))
    assert isinstance(merged, Joint)
    assert (merged.axis, stale) == (Axis(xyz=(1, 0, 0), limit=Limit(velocity=3)), [])


def test_names_of_texts_have_any_name_in_them() -> None:
    for name in ("a", "a::b", "a:b:c", "a b/c", "twinform:x"):
        assert parse_text_name(text_name("link", name)) == ("", "link", name)
        assert parse_text_name(f"left_{text_name('link', name)}") == ("left_", "link", name)
    assert parse_text_name("robot") is None


def test_a_model_says_its_parts_itself() -> None:
    document = Document(format=Format.SDF, models=(Model(name="m", static=True, links=(_LINK,)),))
    left = remainder(document.models[0], said_by_mjcf)
    assert left is not None
    assert (left.links, left.static) == ((), True)
