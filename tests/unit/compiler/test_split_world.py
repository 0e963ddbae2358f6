"""Splitting a world: one URDF for each model, and a world that includes them."""

from pathlib import Path

import pytest
from lxml import etree

import twinform
from twinform.compiler import CompileError, ConversionRequest, LoadOptions, split
from twinform.testing.oracles import libsdformat

_EXAMPLES = Path(__file__).parents[3] / "examples"
_BODY = "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
WORLD = f"""\
<sdf version="1.9"><world name="w">
  <model name="a b" placement_frame="top"><pose>1 0 0 0 0 0</pose><link name="l">{_BODY}</link>
    <frame name="top"><pose>0 0 2 0 0 0</pose></frame></model>
  <model name="A/b"><pose relative_to="a b">0 1 0 0 0 0</pose><link name="l">{_BODY}</link></model>
  <model name="a_b"><static>true</static><link name="l">{_BODY}</link></model>
  <frame name="f" attached_to="a b::top"><pose>0 0 1 0 0 0</pose></frame>
  <light name="lamp" type="point"><pose relative_to="a b::top">0 0 3 0 0 0</pose></light>
  <include><uri>model://other</uri></include>
</world></sdf>
"""
WRONG = '<sdf version="1.9"><world name="w"><model name="m"><link name="l">{}</link></model></world></sdf>'


def _split(text: str) -> dict[str, etree._Element]:  # pyright: ignore[reportPrivateUsage] - lxml has no public name
    files = split(ConversionRequest(to="urdf"), text.encode(), LoadOptions(), name="room.world").files
    return {name: etree.fromstring(each.encode()) for name, each in files.items()}


def test_every_model_has_a_file_with_a_safe_name_of_its_own() -> None:
    assert list(_split(WORLD)) == ["a_b.urdf", "A_b_1.urdf", "a_b_2.urdf", "room.world"]


def test_the_world_includes_them_where_they_were() -> None:
    world = _split(WORLD)["room.world"]
    rows = [
        tuple(include.findtext(name) for name in ("uri", "name", "pose", "static"))
        for include in world.iterfind("world/include")
    ]
    assert rows == [
        ("a_b.urdf", "a b", "1 0 -2 0 0 0", None),
        ("A_b_1.urdf", "A/b", "0 1 0 0 0 0", None),
        ("a_b_2.urdf", "a_b", None, "true"),
        ("model://other", None, None, None),
    ]
    assert world.find("world/model") is None


def test_nothing_in_the_world_names_a_frame_inside_a_model() -> None:
    world = _split(WORLD)["room.world"]
    frame, light = world.find("world/frame"), world.find("world/light/pose")
    assert frame is not None
    assert light is not None
    assert frame.get("attached_to") == "a b::l"
    assert (frame[0].get("relative_to"), frame[0].text) == ("a b", "0 0 3 0 0 0")
    assert (light.get("relative_to"), light.text) == ("a b", "0 0 5 0 0 0")


def test_a_model_that_cannot_be_urdf_stays_sdf() -> None:
    text = WRONG.replace("1.9", "1.11").format('<inertial auto="true"/>')
    found = split(ConversionRequest(to="urdf"), text.encode(), LoadOptions(), name="room.sdf")
    assert list(found.files) == ["m.sdf", "room.sdf"]
    assert [each.message for each in found.diagnostics if each.rule.name == "kept-as-sdf"] == [
        "model 'm' stays SDF: link 'l' has no collision to compute its inertia from"
    ]


@pytest.mark.parametrize(
    ("model", "why"),
    [
        (
            f"""<link name="a">{_BODY}</link><link name="b">{_BODY}</link>
            <joint name="caster" type="ball"><parent>a</parent><child>b</child></joint>""",
            "ball joint 'caster' would not be one for Gazebo",
        ),
        (
            '<link name="a"><inertial><mass>1e-7</mass></inertial></link>',
            "Gazebo leaves link 'a', which has no mass, out of URDF, with all that hangs from it",
        ),
        ('<model name="b"><link name="c"/></model>', "the parts of the model 'b' in it would have other names"),
        (
            '<link name="a"><collision name="floor"><geometry><plane/></geometry></collision></link>',
            "collision 'floor' of link 'a' is a plane, which URDF does not have",
        ),
    ],
)
def test_a_model_stays_sdf_where_gazebo_would_make_something_else_of_its_urdf(model: str, why: str) -> None:
    text = f'<sdf version="1.9"><world name="w"><model name="m">{model}</model></world></sdf>'
    found = split(ConversionRequest(to="urdf"), text.encode(), LoadOptions(), name="room.sdf")
    assert [each.message for each in found.diagnostics if each.rule.name == "kept-as-sdf"] == [
        f"model 'm' stays SDF: {why}"
    ]
    assert list(found.files) == ["m.sdf", "room.sdf"]


@pytest.mark.parametrize("type_", ["floating", "planar"])
def test_a_model_stays_sdf_where_its_urdf_had_a_joint_that_gazebo_refuses(type_: str) -> None:
    body = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    joint = f'<joint name="j" type="{type_}"><parent link="a"/><child link="b"/></joint>'
    urdf = f'<robot name="m"><link name="a">{body}</link><link name="b">{body}</link>{joint}</robot>'
    model = twinform.convert(urdf.encode(), to="sdf").text.partition("<model")[2].partition("</sdf>")[0]
    text = f'<sdf version="1.9" xmlns:tf="urn:twinform:1"><world name="w"><model{model}</world></sdf>'
    found = split(ConversionRequest(to="urdf"), text.encode(), LoadOptions(), name="room.sdf")
    assert [each.message for each in found.diagnostics if each.rule.name == "kept-as-sdf"] == [
        f"model 'm' stays SDF: Gazebo refuses URDF with a {type_} joint, which holds 'b'"
    ]


def test_a_ball_joint_stays_one_without_carriers_too() -> None:
    links = f'<link name="a">{_BODY}</link><link name="b">{_BODY}</link>'
    joint = '<joint name="caster" type="ball"><parent>a</parent><child>b</child></joint>'
    text = f'<sdf version="1.9"><world name="w"><model name="m">{links}{joint}</model></world></sdf>'
    found = split(ConversionRequest(to="urdf", carriers=False), text.encode(), LoadOptions(), name="room.sdf")
    assert list(found.files) == ["m.sdf", "room.sdf"]


def test_all_models_may_stay_sdf() -> None:
    found = split(ConversionRequest(to="sdf"), WORLD.encode(), LoadOptions(), name="room.world")
    assert list(found.files) == ["a_b.sdf", "A_b_1.sdf", "a_b_2.sdf", "room.world"]
    assert not [each for each in found.diagnostics if each.rule.name == "kept-as-sdf"]


def test_a_file_is_not_called_as_one_of_libsdformat_or_as_the_world() -> None:
    text = '<sdf version="1.9"><world name="w"><model name="model"/><model name="room"/></world></sdf>'
    found = split(ConversionRequest(to="sdf"), text.encode(), LoadOptions(), name="room.sdf")
    assert list(found.files) == ["model_1.sdf", "room_1.sdf", "room.sdf"]


def test_the_include_of_a_robot_gives_where_its_root_is() -> None:
    text = f"""
        <sdf version="1.6"><world name="w"><model name="m"><pose>1 0 0 0 0 0</pose>
          <link name="base"><pose>0 0 0.5 0 0 0</pose>{_BODY}</link></model></world></sdf>"""
    world = _split(text)["room.world"]
    assert world.findtext("world/include/pose") == "1 0 0.5 0 0 0"


def test_a_link_that_the_world_names_must_be_there_in_gazebo() -> None:
    text = f"""
        <sdf version="1.9"><world name="w"><model name="m"><link name="a">{_BODY}</link><link name="b"/>
          <joint name="j" type="fixed"><parent>a</parent><child>b</child></joint></model>
          <frame name="f" attached_to="m::b"/></world></sdf>"""
    assert list(_split(text)) == ["m.urdf", "room.world"]  # which `preserveFixedJoint` keeps


def test_urdf_cannot_be_split() -> None:
    with pytest.raises(CompileError, match="holds one robot"):
        split(ConversionRequest(to="urdf"), _EXAMPLES / "rover.urdf", LoadOptions())


def test_the_files_together_are_the_world_again(tmp_path: Path) -> None:
    result = split(ConversionRequest(to="urdf"), _EXAMPLES / "warehouse.sdf", LoadOptions())
    for name, text in result.files.items():
        (tmp_path / name).write_text(text)
    again = twinform.convert(tmp_path / "warehouse.sdf", to="sdf", expand_includes=True, paths=[_EXAMPLES])
    names = {model.name for model in again.document.worlds[0].models}
    assert names == {"ground_plane", "shelf", "lift_cart", "crate_1"}


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
def test_libsdformat_accepts_every_file(tmp_path: Path) -> None:
    result = split(ConversionRequest(to="urdf", expand_includes=True), _EXAMPLES / "warehouse.sdf", LoadOptions())
    for name, text in result.files.items():
        (tmp_path / name).write_text(text)
    robots = [tmp_path / name for name in result.files if name.endswith(".urdf")]
    assert {path.name: verdict.errors for path, verdict in libsdformat.judge(robots).items() if not verdict.ok} == {}


def test_a_joint_in_the_world_ends_on_links_and_stays_where_it_was() -> None:
    world = _split(
        """
        <sdf version="1.11"><world name="room">
          <model name="cart"><pose>1 0 0 0 0 0</pose><link name="l"><pose>0 2 0 0 0 0</pose></link>
            <link name="k"/><joint name="j" type="revolute"><parent>l</parent><child>k</child><axis/></joint>
            <frame name="hitch" attached_to="l"><pose>0 0 3 0 0 0</pose></frame></model>
          <joint name="tow" type="fixed"><parent>world</parent><child>cart::hitch</child></joint>
          <joint name="chain" type="fixed">
            <pose relative_to="cart::hitch">0 0 1 0 0 0</pose><parent>cart::hitch</parent><child>cart::k</child>
          </joint>
          <joint name="post" type="fixed"><parent>world</parent><child>stake</child></joint>
          <frame name="stake" attached_to="cart::l"/>
        </world></sdf>"""
    )["room.world"]
    rows = [
        (each.get("name"), each.findtext("parent"), each.findtext("child"), *_pose(each))
        for each in world.iterfind("world/joint")
    ]
    assert rows == [
        ("tow", "world", "cart::l", "cart::l", "0 0 3 0 0 0"),
        ("chain", "cart::l", "cart::k", "cart::l", "0 0 4 0 0 0"),
        ("post", "world", "stake", None, None),
    ]


def _pose(element: etree._Element) -> tuple[str | None, str | None]:  # pyright: ignore[reportPrivateUsage] - lxml has no public name for its type
    pose = element.find("pose")
    return (None, None) if pose is None else (pose.get("relative_to"), pose.text)
