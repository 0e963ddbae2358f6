"""Where comments go: beside each in the source stands what it stands before, behind or in in the target."""

import re

import pytest

import twinform
from tests.snippets import INERTIAL
from twinform.compiler.input.loading import LoadOptions, read
from twinform.compiler.input.take_comments import comments_of
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink

pytestmark = pytest.mark.slow


URDF = f"""<?xml version="1.0"?>
<!-- License -->
<!-- of two
     lines -->
<robot name="r"> <!-- behind robot -->
  <!-- before a material -->
  <material name="red"><color rgba="1 0 0 1"/></material>
  <!-- before base -->
  <link name="base">  <!-- behind base -->
    {INERTIAL}
    <!-- before visual -->
    <visual>
      <!-- before origin -->
      <origin xyz="0 0 1"/>
      <geometry> <!-- behind geometry --> <box size="1 1 1"/> <!-- behind box --> </geometry>
      <!-- at the end of visual -->
    </visual> <!-- behind visual --> <!-- too -->
  </link>
  <!-- before the joint --> <!-- on the same line -->
  <joint name="j" type="revolute">
    <parent link="base"/> <!-- behind parent -->
    <child link="arm"/>
    <axis xyz="0 0 1"/>
    <!-- before limit -->
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <link name="arm">{INERTIAL}<!-- at the end of arm --></link>
  <!-- before the sensor -->
  <gazebo reference="arm">
    <sensor name="imu" type="imu"><!-- in the sensor --><update_rate>5</update_rate></sensor>
  </gazebo>
  <!-- before the tags -->
  <gazebo reference="base"><mu1>1</mu1></gazebo>
  <!-- before the plugin -->
  <gazebo>
    <plugin name="p" filename="p"><!-- in the plugin --><x>1</x><!-- at the end of the plugin --></plugin>
  </gazebo>
  <!-- before the transmission -->
  <transmission name="t"><type>x</type><joint name="j"/><actuator name="m"/></transmission>
  <!-- at the end -->
</robot>
<!-- behind all -->
"""

IN_SDF = {
    "License": "<!-- of two",
    "before a material": '<material name="red">',
    "before base": '<link name="base">',
    "before visual": '<visual name="base_visual">',
    "before origin": "<pose>",
    "at the end of visual": "</visual>",
    "before the joint": "<!-- on the same line -->",
    "on the same line": '<joint name="j"',
    "before limit": "<limit>",
    "before the sensor": '<sensor name="imu"',
    "in the sensor": "<update_rate>",
    "before the tags": "<mu1>",
    "before the plugin": "<plugin",
    "in the plugin": "<x>",
    "before the transmission": "<transmission",
    "at the end": "</model>",
}
"""What follows on the next line."""
BESIDE = {
    "behind base": '<link name="base">',
    "behind robot": '<model name="r">',
    "behind box": "</box>",
    "at the end of arm": "</inertial>",
    "at the end of the plugin": "<x>1</x>",
    "behind visual": "</visual>",
    "behind parent": "<parent>base</parent>",
}
_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)


def comments(text: str) -> list[str]:
    """The comments of a text, in alphabetical order and without their layout."""
    return sorted(" ".join(each.split()) for each in _COMMENT.findall(text))


def lines_of(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines()]


@pytest.mark.parametrize("to", ["urdf", "sdf"])
def test_each_comment_is_there_once(to: str) -> None:
    made = twinform.convert(URDF.encode(), to="urdf" if to == "urdf" else "sdf").text
    assert comments(made) == comments(URDF)
    back = twinform.convert(made.encode(), to="urdf").text
    assert comments(back) == comments(URDF)
    again = twinform.convert(back.encode(), to="sdf").text
    assert comments(again) == comments(URDF)


@pytest.mark.parametrize("comment", IN_SDF)
def test_a_comment_stands_before_what_its_own_has_become(comment: str) -> None:
    lines = lines_of(twinform.convert(URDF.encode(), to="sdf").text)
    follows = lines[lines.index(f"<!-- {comment} -->") + 1]
    assert follows.startswith(IN_SDF[comment])


@pytest.mark.parametrize("comment", BESIDE)
def test_a_comment_stands_on_the_line_of_what_its_own_has_become(comment: str) -> None:
    lines = lines_of(twinform.convert(URDF.encode(), to="sdf").text)
    assert any(line.startswith(f"{BESIDE[comment]} <!-- {comment} -->") for line in lines)


def test_comments_around_the_root_stay_there() -> None:
    lines = twinform.convert(URDF.encode(), to="sdf").text.splitlines()
    assert lines[:4] == ['<?xml version="1.0"?>', "<!-- License -->", "<!-- of two", "     lines -->"]
    assert lines[-1] == "<!-- behind all -->"


def test_what_is_written_is_the_same_without_them() -> None:
    with_comments = twinform.convert(URDF.encode(), to="sdf")
    without = twinform.convert(URDF.encode(), to="sdf", comments=False)
    assert with_comments.document == without.document
    assert with_comments.ledger == without.ledger
    assert "<!--" not in without.text
    bare = [line.strip() for line in _COMMENT.sub("", with_comments.text).splitlines() if line.strip()]
    assert bare == lines_of(without.text)


def test_lines_of_a_comment_are_indented_like_the_first() -> None:
    text = '<robot name="r">\n      <!-- one\n           two\n   three -->\n<link name="a"/></robot>'
    made = twinform.convert(text.encode(), to="sdf").text
    assert "    <!-- one\n         two\n   three -->\n" in made


def test_a_comment_between_text_and_an_element_stays_on_their_line() -> None:
    text = b'<sdf version="1.9"><model name="m">x<!-- a --><static>1</static><link name="l"/></model></sdf>'
    assert '<model name="m">x<!-- a --><static>1</static>\n' in twinform.convert(text, to="sdf").text


def test_comments_at_what_is_left_out_of_a_text_stay_near_it() -> None:
    visual = "<geometry/>\n<!-- new -->\n<visibility_flags>3</visibility_flags> <!-- flags -->\n"
    link = f'<link name="l"><visual name="v">{visual}</visual>\n<!-- light --><light name="i" type="point"/></link>'
    text = f'<sdf version="1.11"><model name="m">{link}</model></sdf>'
    loaded = read(text.encode(), LoadOptions(keep_comments=True))
    assert loaded.document is not None
    older, sink = loaded.document.copy(version="1.3"), DiagnosticSink()
    made = emit(older, sink, fit=True, comments=comments_of(loaded, older, "sdf", None))
    assert [entry.rule.name for entry in sink.entries] == ["older-version"] * 2
    assert "<visibility_flags>" not in made
    assert "<light" not in made
    assert comments(made) == comments(text)
    lines = lines_of(made)
    assert lines[lines.index("<!-- new -->") :][:3] == ["<!-- new -->", "<!-- flags -->", "</visual>"]


def test_hyphens_that_other_parsers_let_pass_are_fixed() -> None:
    text = b'<robot name="r"><!-- a -- b --><link name="a"/></robot>'
    assert "<!-- a - - b -->" in twinform.convert(text, to="sdf").text


def test_comments_for_us_stay_in_their_format() -> None:
    text = b'<robot name="r"><!-- twinform: allow massless --><link name="a"/></robot>'
    assert "twinform: allow" not in twinform.convert(text, to="sdf").text
    assert "<!-- twinform: allow massless -->" in twinform.convert(text, to="urdf").text


WORLD = """<sdf version="1.9">
  <world name="w">
    <!-- the light -->
    <light name="sun" type="point"/>
    <!-- the box -->
    <model name="box"><link name="a"><!-- in the box --></link></model>
    <!-- the ball -->
    <model name="ball"><link name="b"><!-- in the ball --></link></model>
  </world>
</sdf>"""


def test_comments_of_what_is_not_converted_are_in_the_ledger() -> None:
    made = twinform.convert(WORLD.encode(), to="urdf", model="ball")
    assert comments(made.text) == ["in the ball", "the ball"]
    left = [(each.message, each.location.line) for each in made.ledger.entries if each.rule.name == "left-comment"]
    assert left == [
        ("the comment 'the light' is about what is not converted", 3),
        ("the comment 'the box' is about what is not converted", 5),
        ("the comment 'in the box' is about what is not converted", 6),
    ]


def test_comments_go_with_parts_that_a_pass_has_renamed() -> None:
    text = b'<robot name="r">\n<!-- the base -->\n<link name="a"/></robot>'
    made = lines_of(twinform.convert(text, to="urdf", passes="rename{names=[a:b]}").text)
    assert made[made.index("<!-- the base -->") + 1] == '<link name="b"/>'


def test_comments_of_a_part_that_a_pass_has_dropped_stay() -> None:
    plugin = '<!-- all -->\n<gazebo><!-- in it --><plugin name="p" filename="p"/></gazebo>'
    text = f'<robot name="r"><link name="a"/>\n{plugin}</robot>'.encode()
    made = twinform.convert(text, to="urdf", passes="drop{plugins=p}").text
    assert comments(made) == ["all", "in it"]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_comments_in_other_encodings(encoding: str) -> None:
    text = '<robot name="r"><!-- ü \u2603 --><link name="a"/></robot>'
    assert "<!-- ü \u2603 -->" in twinform.convert(text.encode(encoding), to="sdf").text


def test_a_default_namespace() -> None:
    text = b'<robot xmlns="urn:x" name="r"><!-- a -->\n<!-- b -->\n<link name="a"/></robot>'
    assert '"r"> <!-- a -->\n  <!-- b -->\n  <link' in twinform.convert(text, to="urdf").text


@pytest.mark.parametrize("unit", ["<!---->", "<!---->\n", "<x/><!---->\n", "<link name='{}'/><!---->\n"])
def test_many_comments_at_one_place_take_no_more_time_each(unit: str) -> None:
    count = 7_000  # more than are placed; one by one from the first on, they take minutes
    body = "".join(unit.format(number) for number in range(count))
    text = f'<robot name="r"><link name="a"/><gazebo><plugin name="p" filename="p">{body}</plugin></gazebo></robot>'
    assert len(comments(twinform.convert(text.encode(), to="sdf").text)) == count
