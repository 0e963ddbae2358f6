"""There and back through MJCF: on models that Hypothesis makes up, all that MJCF does not say comes back."""

from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from lxml import etree

from tests.profile import examples
from tests.roundtrip.test_generated import text_of
from tests.snippets import ARM, INERTIAL
from twinform.compiler import CompileError, convert
from twinform.compiler.compare import diff
from twinform.ir import Document
from twinform.request_options import Language
from twinform.testing import strategies
from twinform.testing.properties import RoundTrip, assert_valid

_CASES = Path(__file__).parent.parent / "cases"
_SETTINGS = examples(0.5)
_JOINTS = ("revolute", "continuous", "prismatic", "fixed")


def _mismatches(model: Document) -> list[str]:
    trip = RoundTrip.of_whole(text_of(model).encode(), model)
    try:
        there = convert(trip.text, to="mjcf").text
    except CompileError as error:
        # MuJoCo reads no body that moves and weighs nothing.
        assume({each.rule.name for each in error.diagnostics if each.is_error} != {"massless-link"})
        raise
    return [each.message for each in trip.mismatches(trip.back(there))]


@_SETTINGS
@given(strategies.robots(max_links=5, joint_types=_JOINTS))
def test_a_robot_comes_back_from_mjcf(robot: Document) -> None:
    assert _mismatches(robot) == []


@_SETTINGS
@given(strategies.sdf_models(max_links=5))
def test_a_model_comes_back_from_mjcf(model: Document) -> None:
    assert _mismatches(model) == []


@_SETTINGS
@given(st.one_of(strategies.worlds(nested=True), strategies.worlds(anchored=True)))
def test_a_world_comes_back_from_mjcf(world: Document) -> None:
    assert _mismatches(world) == []


_PUCK = f"""
<robot name="table">
  <link name="base"/>
  <link name="puck">{INERTIAL}</link>
  <joint name="glide" type="planar">
    <parent link="base"/><child link="puck"/>
    <origin xyz="1 0 0.5" rpy="0 0.1 0"/><axis xyz="0 0 1"/>
  </joint>
</robot>
""".encode()


def test_a_planar_joint_comes_back_from_mjcf() -> None:
    trip = RoundTrip.of(_PUCK, assert_valid(_PUCK))
    assert [each.message for each in trip.mismatches(trip.back(convert(_PUCK, to="mjcf").text))] == []


_HOME = (
    "edits/loops_in_mjcf.sdf",
    "edits/loops_that_nothing_holds.sdf",
    "edits/made_link_with_a_mass.urdf",
    "edits/walls_in_mjcf.sdf",
    "elements/dialects.urdf",
    "passes/structure/rename_shared.urdf",
)


@pytest.mark.parametrize("case", _HOME)
def test_a_case_comes_back_from_mjcf(case: str) -> None:
    robot = (_CASES / case).read_bytes()
    trip = RoundTrip.of(robot, assert_valid(robot))
    assert [each.message for each in trip.mismatches(trip.back(convert(robot, to="mjcf").text))] == []


def test_a_loop_that_is_added_at_the_root_leaves_it_where_it_is() -> None:
    links = f'<link name="base">{INERTIAL}</link><link name="cup">{INERTIAL}</link>'
    joint = '<joint name="glue" type="fixed"><parent link="base"/><child link="cup"/></joint>'
    there = convert(f'<robot name="cups">{links}{joint}</robot>'.encode(), to="mjcf").text
    loop = '<equality><connect name="loop" body1="cup" body2="base" anchor="0 0 0.1"/></equality></mujoco>'
    there = there.replace("</mujoco>", loop)
    assert "stale-carrier" not in {each.rule.name for each in convert(there.encode(), to="urdf").diagnostics}


def test_a_joint_that_was_made_and_stands_in_the_file_comes_back() -> None:
    held = (_CASES / "edits/held_by_the_world.urdf").read_bytes()
    assert diff(held, convert(convert(held, to="mjcf").text.encode(), to="urdf").text.encode(), carriers=True).same


def test_what_was_a_urdf_says_once_that_a_link_has_no_mass() -> None:
    there = etree.fromstring(convert(b'<robot name="dot"><link name="point"/></robot>', to="mjcf").text.encode())
    custom = there.find("custom")
    assert custom is not None
    for text in custom.findall("text[@name='twinform:model']"):  # nothing else says that it was one
        custom.remove(text)
    assert convert(etree.tostring(there), to="urdf").text.count("<tf:unsaid>") == 1


def test_plugins_of_one_name_come_back_from_mjcf() -> None:
    motors = "".join(f'<plugin name="motor" filename="m.so"><number>{each}</number></plugin>' for each in range(3))
    drone = f'<sdf version="1.11"><model name="drone"><link name="hull"/>{motors}</model></sdf>'.encode()
    trip = RoundTrip.of(drone, assert_valid(drone))
    assert [each.message for each in trip.mismatches(trip.back(convert(drone, to="mjcf").text))] == []


def test_the_canonical_link_comes_back_from_mjcf() -> None:
    joint = (
        '<joint name="j" type="revolute"><parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis></joint>'
    )
    model = f'<sdf version="1.11"><model name="m"><link name="arm"/><link name="base"/>{joint}</model></sdf>'.encode()
    trip = RoundTrip.of(model, assert_valid(model))
    assert [each.message for each in trip.mismatches(trip.back(convert(model, to="mjcf").text))] == []


def test_words_of_a_newer_sdf_come_back_from_mjcf() -> None:
    links = (
        '<link name="a"><pose>0 0 1 0 0 0</pose></link><link name="b"><pose relative_to="a">1 0 0 0 0 0</pose></link>'
    )
    model = f'<sdf version="1.6"><model name="m">{links}</model></sdf>'.encode()
    trip = RoundTrip.of(model, assert_valid(model))
    assert [each.message for each in trip.mismatches(trip.back(convert(model, to="mjcf").text))] == []


def test_words_of_a_newer_urdf_come_back_from_mjcf() -> None:
    newer = ARM.replace(b'velocity="3"', b'velocity="3" jerk="5"')
    trip = RoundTrip.of(newer, assert_valid(newer))
    assert [each.message for each in trip.mismatches(trip.back(convert(newer, to="mjcf").text))] == []


@pytest.mark.parametrize(
    ("old", "new", "gone"),
    [
        ('range="-1 1"', 'range="-1 2"', 'upper="1"'),
        ('axis="0 0 1"', 'axis="0 1 0"', 'xyz="0 0 1"'),
        ('actuatorfrcrange="-2 2"', 'actuatorfrcrange="-5 5"', 'effort="2"'),
        ('mass="1"', 'mass="7"', 'value="1"'),
    ],
)
def test_an_edit_of_mjcf_wins_and_what_it_does_not_say_stays(old: str, new: str, gone: str) -> None:
    there = convert(ARM, to="mjcf").text
    assert old in there
    back = convert(there.replace(old, new).encode(), to="urdf").text
    assert gone not in back
    assert 'velocity="3"' in back
    assert 'k_velocity="4"' in back


def test_what_belongs_to_a_joint_that_was_renamed_is_stale() -> None:
    there = convert(ARM, to="mjcf").text.replace('<joint name="wrist"', '<joint name="elbow"')
    made = convert(there.encode(), to="urdf")
    assert "stale-carrier" in {each.rule.name for each in made.diagnostics}
    assert '<joint name="elbow"' in made.text
    assert "k_velocity" not in made.text


def test_without_carriers_nothing_of_ours_is_written_and_the_ledger_has_it() -> None:
    made = convert(ARM, to="mjcf", carriers=False)
    assert "twinform" not in made.text
    dropped = [each.message for each in made.ledger.entries if each.fate.value == "dropped"]
    assert "<velocity> of joint 'wrist' has no equivalent in MJCF" in dropped


def test_a_body_without_mass_comes_back_from_urdf() -> None:
    arm = b"""<mujoco model="arm"><worldbody><body name="base">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><freejoint/><body name="tip" pos="0 0 1"/>
    </body></worldbody></mujoco>"""
    there = convert(arm, to="urdf")
    assert there.diagnostics == ()
    assert '<body name="tip" pos="0 0 1"/>' in convert(there.text.encode(), to="mjcf").text


def test_elements_outside_of_all_sections_come_back_from_sdf() -> None:
    fragment = b'<mujoco><body name="arm"><geom size="0.1"/></body><body name="hand"/></mujoco>'
    back = convert(convert(fragment, to="sdf").text.encode(), to="mjcf").text
    assert '<body name="arm">' in back
    assert '<body name="hand"/>' in back


def test_what_is_kept_for_a_site_of_the_world_comes_back() -> None:
    arm = b"""<mujoco model="arm"><worldbody><site name="hook"/><body name="rod">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint axis="0 1 0"/><site name="tip" pos="0 0 1"/>
    </body></worldbody><equality><connect site1="hook" site2="tip"/></equality></mujoco>"""
    for format_ in ("sdf", "urdf"):
        there = convert(arm, to=format_).text
        assert '<connect site1="hook" site2="tip"/>' in convert(there.encode(), to="mjcf").text


def test_what_only_mjcf_says_of_lights_and_cameras_comes_back_twice() -> None:
    room = b"""<mujoco model="room"><worldbody><body name="arm"><freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <light name="lamp" type="spot" pos="0 0 2" exponent="3"/><camera name="eye" output="depth" resolution="64 48"/>
    </body></worldbody></mujoco>"""
    first = convert(convert(room, to="sdf").text.encode(), to="mjcf").text
    second = convert(convert(first.encode(), to="sdf").text.encode(), to="mjcf").text
    assert first == second
    assert 'exponent="3"' in second
    assert 'output="depth"' in second


def test_a_model_with_a_sensor_of_sdf_is_still_of_mjcf() -> None:
    arm = b"""<mujoco model="arm"><worldbody><body name="arm"><freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><geom name="bone" size="0.1 0.2 0.3" group="1"/>
    </body></worldbody></mujoco>"""
    sensors = '<sensor name="imu" type="imu"/><sensor name="gps" type="navsat"/>'
    with_sensors = convert(arm, to="sdf").text.replace("</link>", f"{sensors}</link>", 1)
    first = convert(with_sensors.encode(), to="mjcf").text
    second = convert(convert(first.encode(), to="sdf").text.encode(), to="mjcf").text
    assert first == second
    assert 'size="0.1 0.2 0.3"' in second
    assert all(each in convert(second.encode(), to="sdf").text for each in ('"imu" type="imu"', '"gps" type="navsat"'))


def test_a_terrain_that_is_seen_and_touched_needs_no_text() -> None:
    ground = b"""<mujoco model="ground"><asset><hfield name="hills" file="hills.png" size="1 1 0.1 0.1"/></asset>
      <worldbody><geom name="hills" type="hfield" hfield="hills"/></worldbody></mujoco>"""
    assert "<custom>" not in convert(convert(ground, to="sdf").text.encode(), to="mjcf").text


def test_a_model_that_was_a_urdf_between_still_floats_in_mjcf() -> None:
    sail = '<link name="sail"><inertial><mass>1</mass></inertial></link>'
    kite = f'<sdf version="1.12"><model name="kite">{sail}</model></sdf>'
    urdf = convert(kite.encode(), to="urdf").text
    there = convert(urdf.encode(), to="mjcf").text
    assert "<freejoint/>" in there
    assert convert(there.encode(), to="urdf").text == urdf


def test_a_link_that_was_set_free_and_fixed_again_does_not_float() -> None:
    inertial = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
    wall = f'<mujoco model="wall"><worldbody><body name="wall">{inertial}</body></worldbody></mujoco>'
    robot = convert(wall.encode(), to="urdf").text.replace('type="fixed"', 'type="floating"')
    free = convert(robot.encode(), to="mjcf").text
    assert "<freejoint/>" in free
    back = convert(free.replace("<freejoint/>", "").encode(), to="urdf")
    assert 'type="floating"' not in back.text
    assert [each.rule.name for each in back.diagnostics] == ["stale-carrier"]


@pytest.mark.parametrize("other", ["sdf", "urdf"])
def test_an_inertial_of_zeros_comes_back_to_mjcf(other: Language) -> None:
    zeros = '<inertial pos="0.5 0 0.25" mass="0" diaginertia="0 0 0"/>'
    model = f"""<mujoco model="m"><worldbody><body name="base">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="camera">{zeros}</body></body></worldbody></mujoco>"""
    there = convert(model.encode(), to=other).text
    assert zeros in convert(there.encode(), to="mjcf").text
