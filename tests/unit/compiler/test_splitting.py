"""Splitting a world: one URDF for each model, and a world that includes them."""

from pathlib import Path

import pytest
from lxml import etree

import twinform
from twinform.compiler import CompileError, Order, Reading, split
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
    files = split(Order(to="urdf"), text.encode(), Reading(), name="room.world").files
    return {name: etree.fromstring(each.encode()) for name, each in files.items()}


def test_every_model_has_a_file_with_a_safe_name_of_its_own() -> None:
    assert list(_split(WORLD)) == ["a_b.urdf", "A_b_1.urdf", "a_b_2.urdf", "room.sdf"]


def test_the_world_includes_them_where_they_were() -> None:
    world = _split(WORLD)["room.sdf"]
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
    world = _split(WORLD)["room.sdf"]
    frame, light = world.find("world/frame"), world.find("world/light/pose")
    assert frame is not None
    assert light is not None
    assert frame.get("attached_to") == "a b::l"
    assert (frame[0].get("relative_to"), frame[0].text) == ("a b", "0 0 3 0 0 0")
    assert (light.get("relative_to"), light.text) == ("a b", "0 0 5 0 0 0")


def test_one_model_that_is_refused_stops_all() -> None:
    text = WRONG.replace("1.9", "1.11").format('<inertial auto="true"/>')
    with pytest.raises(CompileError) as caught:
        split(Order(to="urdf"), text.encode(), Reading())
    assert "automatic-inertia" in {each.rule.name for each in caught.value.diagnostics}


def test_urdf_cannot_be_split() -> None:
    with pytest.raises(CompileError, match="holds one robot"):
        split(Order(to="urdf"), _EXAMPLES / "rover.urdf", Reading())


def test_the_files_together_are_the_world_again(tmp_path: Path) -> None:
    result = split(Order(to="urdf"), _EXAMPLES / "warehouse.sdf", Reading())
    for name, text in result.files.items():
        (tmp_path / name).write_text(text)
    again = twinform.convert(tmp_path / "warehouse.sdf", to="sdf", expand_includes=True, paths=[_EXAMPLES])
    names = {model.name for model in again.document.worlds[0].models}
    assert names == {"ground_plane", "shelf", "lift_cart", "crate_1"}


@pytest.mark.skipif(not libsdformat.available(), reason=libsdformat.MISSING)
def test_libsdformat_accepts_every_file(tmp_path: Path) -> None:
    result = split(Order(to="urdf", expand_includes=True), _EXAMPLES / "warehouse.sdf", Reading())
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
    )["room.sdf"]
    rows = [
        (each.get("name"), each.findtext("parent"), each.findtext("child"), *_pose(each))
        for each in world.iterfind("world/joint")
    ]
    assert rows == [
        ("tow", "world", "cart::l", "cart", "0 2 3 0 0 0"),
        ("chain", "cart::l", "cart::k", "cart", "0 2 4 0 0 0"),
        ("post", "world", "stake", None, None),
    ]


def _pose(element: etree._Element) -> tuple[str | None, str | None]:  # pyright: ignore[reportPrivateUsage] - likewise
    pose = element.find("pose")
    return (None, None) if pose is None else (pose.get("relative_to"), pose.text)
