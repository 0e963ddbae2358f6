"""Facts that tables name, about robots as each loader builds them; what is expected was seen in the loader."""

import pytest

from twinform.profiles import Effect
from twinform.profiles.walking import read_as

_MASS = '<inertial><mass value="{}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
_HEAVY, _LIGHT = _MASS.format(1), _MASS.format(0)
_LIMIT = '<axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>'
_BOX = '<geometry><box size="{}"/></geometry>'
_RED = '<material name="m"><color rgba="1 0 0 {}"/></material>'


def _link(name: str, inside: str = _HEAVY) -> str:
    return f'<link name="{name}">{inside}</link>'


def _joint(name: str, parent: str, child: str, kind: str = "revolute", attributes: str = "") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}" {attributes}>{ends}{_LIMIT}</joint>'


def _effects(consumer: str, *parts: str) -> set[str]:
    text = f'<robot name="r" xmlns:x="urn:x" xmlns:drake="urn:d">{"".join(parts)}</robot>'
    return {each.effect for each in read_as(consumer, text.encode())}


_A, _B, _C, _D = map(_link, "abcd")
_ENDLESS = _A.replace('ixx="1"', 'ixx="inf"')
_TREE = (_A, _B, _joint("j", "a", "b"))
_FIXED = _joint("j", "a", "b", "fixed")


@pytest.mark.parametrize(
    ("parts", "effects"),
    [
        (_TREE, set[str]()),
        ((_A, _link("b", f'{_HEAVY}<axis x:a="1"/>'), _joint("j", "a", "b")), {"refuses", "warns"}),
        ((_A, _link("b", f'{_HEAVY}<odd x:a="1"/>'), _joint("j", "a", "b")), {"refuses"}),
        ((_A, _link("b", _HEAVY.replace("<mass", '<mass x:a="1"')), _joint("j", "a", "b")), set[str]()),
        ((_A, _B, _joint("j", "a", "b", attributes='a-b="1"')), {"refuses"}),
        ((_A, _B, _joint("j", "a", "b", "floating", 'a-b="1"')), set[str]()),
        ((*_TREE, "<gazebo><a><box/></a></gazebo>"), set[str]()),
        ((*_TREE, _C), {"misreads"}),
        ((*_TREE, _C, _joint("k", "a", "c"), _joint("l", "b", "c")), {"misreads"}),
        ((*_TREE, _joint("k", "b", "a")), {"refuses"}),
        ((*_TREE, _C, _D, _joint("k", "c", "d"), _joint("l", "d", "c")), {"misreads"}),
        ((*_TREE, _RED.format(1)), set[str]()),
        ((*_TREE, _RED.format(2)), {"refuses"}),
        ((_ENDLESS.replace("<inertia ", '<origin xyz="0 0 0"/><inertia '),), {"refuses", "misreads"}),
        ((_ENDLESS,), {"misreads"}),
    ],
)  # fmt: skip
def test_what_urdf_usd_converter_writes(parts: tuple[str, ...], effects: set[str]) -> None:
    assert _effects("usd", *parts) == effects


def test_a_long_chain_of_double_joints_takes_no_longer_than_it_is() -> None:
    links = [_link(str(n)) for n in range(60)]
    joints = [_joint(f"{n}{way}", str(n), str(n + 1)) for n in range(59) for way in "ab"]
    assert _effects("usd", *links, *joints) == {"misreads"}


@pytest.mark.parametrize(
    ("parts", "effects"),
    [
        (_TREE, set[str]()),
        ((_link("a", _LIGHT), _B, _joint("j", "a", "b")), {"drops", "refuses"}),
        ((_link("a", _LIGHT), "<gazebo><static>true</static></gazebo>"), {"drops"}),
        ((_link("a", _LIGHT), "<gazebo><static>true</static></gazebo><gazebo/>"), {"drops", "refuses"}),
        ((_link("a", ""), _B, _joint("j", "a", "b", "fixed")), set[str]()),
        ((_link("a", ""), _B, _FIXED, '<gazebo reference="j"><preserveFixedJoint value="1"/></gazebo>'),
         {"drops", "refuses"}),
        ((_A, _link("b", ""), _link("c", _LIGHT), _FIXED, _joint("k", "b", "c", "fixed")), {"refuses"}),
        ((_link("world", ""),), {"refuses"}),
        ((_link("world"), _A, _joint("j", "world", "a")), {"drops"}),
        ((_A.replace('izz="1"', 'izz="9"'),), {"refuses"}),
        ((_A.replace('ixx="1"', 'ixx="1 1"'),), {"drops"}),
        ((_A, '<gazebo reference="a"><mu1 value="0.5"/></gazebo>'), set[str]()),
        ((_A, '<gazebo reference="a"><mu1>much</mu1></gazebo>'), {"refuses"}),
        ((_A, '<gazebo reference="a"><mu1>1e400</mu1></gazebo>'), {"refuses"}),
        ((_A, '<gazebo reference="a"><mu1><!-- a -->1</mu1></gazebo>'), {"refuses", "warns"}),
        ((_A, '<gazebo reference="a"><maxContacts>1.5</maxContacts></gazebo>'), set[str]()),
        ((_A, "<gazebo><cfmDamping>true</cfmDamping></gazebo>"), {"warns"}),
        ((*_TREE, "<gazebo><joint><parent>a</parent><child>b</child></joint></gazebo>"), set[str]()),
        ((_A, _B, _joint("j", "a", "b", "floating")), {"refuses"}),
        ((_A, _B, _joint("j", "a", "b", "floating"), '<gazebo><frame name="j"/></gazebo>'), set[str]()),
        ((_A, _B, _joint("j", "a", "b", "floating"), '<gazebo reference="a"><frame name="j"/></gazebo>'), {"refuses"}),
        ((_A, _B, _joint("j", "a", "b", "planar"), '<gazebo><frame name="j"/></gazebo>'), {"misreads"}),
        ((_A, _B, _joint("j", "a", "b", "fixed"), "<gazebo><joint><parent>a</parent><child>b</child></joint></gazebo>"),
         {"refuses"}),
    ],
)  # fmt: skip
def test_what_libsdformat_leaves(parts: tuple[str, ...], effects: set[str]) -> None:
    assert _effects("gazebo", *parts) == effects


_SCREW = '<drake:joint name="s" type="screw"><parent link="a"/><child link="b"/>{}</drake:joint>'


@pytest.mark.parametrize(
    ("consumer", "parts", "effects"),
    [
        ("drake", (_A, _B, _SCREW.format('<drake:screw_thread_pitch value="0.1"/>')), set[str]()),
        ("drake", (_A, _B, _SCREW.format("")), {"refuses"}),
        ("drake", (_A, _SCREW.format('<drake:screw_thread_pitch value="0.1"/>')), {"refuses"}),
        ("drake", (_link("a", "<odd/>").replace("<link", '<link drake_ignore="true"'), _B), {"drops"}),
        ("drake", (*_TREE, _C, _joint("k", "c", "b")), set[str]()),
        ("drake", (*_TREE, _C, _joint("k", "c", "b"), _joint("l", "a", "c")), {"refuses"}),
        ("drake", (_A, _RED.replace("1 0 0", "9 0 0").format(1)), set[str]()),
        ("mujoco", (_link("a", _HEAVY.replace('"1"', '"1e-15"')),), {"refuses"}),
        ("mujoco", (_A, _RED.format(1), _RED.format("?")), set[str]()),
        ("mujoco", (_A, _RED.format("?")), {"refuses"}),
        ("mujoco", (_link("a", f'{_HEAVY}<visual>{_BOX.format("1 1 1")}<origin far="nan"/></visual>'),), set[str]()),
        ("yourdfpy", (_link("a", f"<visual>{_BOX.format('1 1')}</visual>"),), {"misreads"}),
        ("yourdfpy", (_link("a", f"<visual>{_BOX.format('1 1')}{_RED.format(1)}</visual>"),), {"misreads", "refuses"}),
    ],
)
def test_what_else_loaders_make_of_a_robot(consumer: str, parts: tuple[str, ...], effects: set[str]) -> None:
    assert _effects(consumer, *parts) == effects


@pytest.mark.parametrize("consumer", ["gazebo", "usd", "drake", "mujoco"])
@pytest.mark.parametrize("text", ["inf 0 0", "nan 0 0", "1e999 0 0", "x"])
def test_places_that_are_none_end_nothing(consumer: str, text: str) -> None:
    fixed = _joint("j", "a", "b", "fixed").replace("<parent", f'<origin xyz="0 0 0" rpy="{text}"/><parent')
    assert _effects(consumer, _A, _B, fixed) <= set(Effect)


def test_a_joint_without_a_name_is_followed_by_none_that_follows_nothing() -> None:
    assert _effects("newton", _A, _B, _C, _joint("", "a", "b"), _joint("k", "b", "c")) == set()


def test_a_joint_of_a_type_that_nobody_knows_has_an_axis_of_numbers() -> None:
    joint = _joint("j", "a", "b", "").replace('xyz="1 0 0"', 'xyz="x 0 1"')
    assert Effect.REFUSES in _effects("yourdfpy", _A, _B, joint)
