"""Which format a robot is best kept in: a case for each reason."""

from pathlib import Path

import pytest

from tests.snippets import INERTIAL
from twinform import profiles
from twinform.compiler import LoadOptions
from twinform.compiler.advising import Advice, advise
from twinform.ir import Format

_EXAMPLES = Path(__file__).parents[3] / "examples"
_LINK = '<link name="a"/>'
_ARM = (
    '<model name="m"><link name="a"/><link name="b"/>'
    '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>{}</model>'
)
_SECOND = '<joint name="k" type="revolute"><parent>b</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>'


def _urdf(content: str) -> bytes:
    return f'<robot name="r">{_LINK}{content}</robot>'.encode()


def _sdf(content: str) -> bytes:
    return f'<sdf version="1.11">{content}</sdf>'.encode()


def _advice(source: bytes | Path, model: str | None = None) -> Advice:
    return advise(source, (), LoadOptions(), model=model)


@pytest.mark.parametrize(
    ("source", "kept", "reason"),
    [
        pytest.param(_sdf('<world name="w"/>'), Format.SDF, "it is a world of 0 models", id="world"),
        pytest.param(
            _sdf(f'<model name="a">{_LINK}</model><model name="b">{_LINK}</model>').replace(b"1.11", b"1.4"),
            Format.SDF,
            "it has 2 models; URDF holds one",
            id="two models",
        ),
        pytest.param(_sdf(_ARM.format("")), Format.URDF, "ROS, RViz and MoveIt read URDF alone", id="plain arm"),
        pytest.param(_sdf(_ARM.format(_SECOND)), Format.SDF, "1 part has no URDF equivalent (cut-loop)", id="loop"),
        pytest.param(
            _sdf('<model name="m"><link name="a"/></model>'), Format.SDF, "no joint of it moves", id="scenery"
        ),
        pytest.param(_urdf("<transmission name='t'/>"), Format.URDF, "it has <transmission>", id="transmission"),
        pytest.param(
            _urdf("<ros2_control name='c' type='system'/>"), Format.URDF, "it has <ros2_control>", id="ros2_control"
        ),
        pytest.param(_EXAMPLES / "four_wheels.urdf.xacro", Format.URDF, "its macros are the source", id="macros"),
    ],
)
def test_each_reason(source: bytes | Path, kept: Format, reason: str) -> None:
    choice = _advice(source).choice
    assert choice.format is kept
    assert any(reason in words for words in choice.reasons), choice.reasons


def test_what_is_only_written_otherwise_is_no_loss() -> None:
    """Moved frames, names of materials and tiny masses are in the ledger, and the robot is the same."""
    assert not list(_advice(_EXAMPLES / "gripper.urdf").other.losses())


def test_the_gravest_losses_come_first() -> None:
    axis2 = _SECOND.replace("</joint>", "<sensor name='s' type='force_torque'/></joint>")
    names = [each.rule for each in _advice(_sdf(_ARM.format(axis2))).other.losses()]
    assert names[0] == "cut-loop"


def test_a_format_that_is_impossible_is_told() -> None:
    plane = '<collision name="c"><geometry><plane/></geometry></collision>'
    advice = _advice(_sdf(f'<model name="m"><link name="a"><inertial auto="true"/>{plane}</link></model>'))
    assert advice.choice.format is Format.SDF
    assert any("it cannot be written as URDF" in reason for reason in advice.choice.reasons)


_VISUAL = '<visual><geometry><sphere radius="1"/></geometry></visual>'
_TWO_LINKS = (
    f'<robot name="r"><link name="a">{INERTIAL}{_VISUAL}</link><link name="b"><collision><geometry>'
    '<sphere radius="1"/></geometry></collision></link><joint name="j" type="fixed"><parent link="a"/>'
    '<child link="b"/></joint>{}</robot>'
)
_MJCF = b"""<mujoco model="m"><worldbody><body name="a"><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
<geom size="1"/></body></worldbody></mujoco>"""


def _for_mujoco(source: bytes) -> Advice:
    return advise(source, profiles.load("mujoco"), LoadOptions())


def test_what_mujoco_reads_otherwise_of_a_urdf_is_told() -> None:
    advice = _for_mujoco(_TWO_LINKS.format("").encode())
    (words,) = [each for each in advice.choice.reasons if "MuJoCo reads the URDF otherwise" in each]
    assert "gives 1 link without inertial a mass" in words
    assert "merges 1 link on fixed joints into their parents" in words
    assert "leaves 1 visual out" in words


def test_a_urdf_that_says_so_is_read_as_it_is() -> None:
    settings = '<mujoco><compiler fusestatic="false" discardvisual="false"/></mujoco>'
    advice = _for_mujoco(_TWO_LINKS.format(settings).replace('<link name="b">', f'<link name="b">{INERTIAL}').encode())
    assert not [each for each in advice.choice.reasons if "MuJoCo reads" in each]


def test_for_mujoco_alone_the_choice_is_between_urdf_and_mjcf() -> None:
    advice = _for_mujoco(_TWO_LINKS.format("").encode())
    assert (set(advice.rivals), advice.formats) == ({Format.URDF, Format.MJCF}, (Format.URDF, Format.MJCF))
    both = advise(_TWO_LINKS.format("").encode(), profiles.parse("mujoco,drake"), LoadOptions())
    assert (set(both.rivals), both.formats) == ({Format.URDF, Format.SDF}, tuple(Format))
    (mujoco,) = [each for each in both.consumers if each.profile.name == "mujoco"]
    assert set(mujoco.forms) == {Format.URDF, Format.MJCF}


def test_a_file_of_mjcf_is_one_of_mjcf() -> None:
    advice = _for_mujoco(_MJCF)
    assert (advice.format, advice.version, advice.choice.format) == (Format.MJCF, None, Format.MJCF)
    assert set(_advice(_MJCF).rivals) == set(Format)


def test_an_include_of_mjcf_is_no_macro(tmp_path: Path) -> None:
    (tmp_path / "part.xml").write_text("<mujoco><option timestep='0.01'/></mujoco>")
    path = tmp_path / "whole.xml"
    path.write_bytes(_MJCF.replace(b"</mujoco>", b'<include file="part.xml"/></mujoco>'))
    choice = _advice(path).choice
    assert choice.format is Format.MJCF
    assert not [each for each in choice.reasons if "macros" in each]


def test_losses_of_one_rule_are_one_number() -> None:
    classes = b'<default><default class="b"><geom condim="4"/></default></default><worldbody>'
    written = _MJCF.replace(b"<worldbody>", classes).replace(b"<geom", b'<geom class="b"')
    tied = b"<equality><weld body1='a'/></equality></mujoco>"
    soft = written.replace(b"</mujoco>", tied)
    (words,) = [each for each in _advice(soft).choice.reasons if "no SDF equivalent" in each]
    assert words.count("mjcf-only") == 1, words
