"""Texts as consumers read them: each XML parser, each kind of shortfall, and nothing where all is well."""

import pytest

import twinform.profiles.xml_parsers as tiny
from twinform.diagnostics import rules
from twinform.ir import Format
from twinform.profiles import ConsumerVerdict, ProfiledFile, assess, load
from twinform.profiles.nodes import UnparsedError
from twinform.profiles.reads_tables import reads
from twinform.profiles.walking import read_as

INERTIAL = (
    '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'  # one line
)
ROBOT = f"""<?xml version="1.0"?>
<robot name="r">
<link name="a">{INERTIAL}</link>
<link name="b">{INERTIAL}</link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>"""
CONSUMERS = ("urdfdom", "pinocchio", "pybullet", "yourdfpy", "urdf-parser-py")


@pytest.mark.parametrize("consumer", CONSUMERS)
def test_a_plain_robot_has_no_shortfalls(consumer: str) -> None:
    assert list(read_as(consumer, ROBOT.encode())) == []


@pytest.mark.parametrize(
    ("find", "write", "consumer", "kind", "effect", "line"),
    [
        ('effort="1"', 'effort="inf"', "urdfdom", "value", "refuses", 6),
        ('<mass value="1"/>', '<mass value="1,5"/>', "urdfdom", "value", "drops", 3),
        ('<mass value="1"/>', '<mass value="1_0"/>', "urdfdom", "value", "drops", 3),
        ('xyz="0 0 1"', 'xyz="0\t0\t1"', "urdfdom", "value", "refuses", 5),
        ('xyz="0 0 1"', 'xyz="0,0,1"', "pybullet", "value", "refuses", 5),
        (' effort="1"', "", "yourdfpy", "absent", "warns", 6),
        (' effort="1"', "", "urdf-parser-py", "absent", "refuses", 6),
        ("</robot>", "<odd/></robot>", "urdf-parser-py", "unread", "warns", 7),
        ("</robot>", "<loop_joint/></robot>", "mujoco", "unread", "drops", 7),
        ("</robot>", "<constraint/></robot>", "drake", "unread", "drops", 7),
        ("</robot>", "<gazebo><joint/></gazebo></robot>", "urdfdom", "unread", "drops", 7),
        ("</robot>", "<link name='c'/></robot>", "urdfdom", "tree", "refuses", 7),
        ("</robot>", "<?odd?></robot>", "pinocchio", "text", "refuses", 7),
        ("</robot>", "<x:odd/></robot>", "urdf-parser-py", "text", "refuses", 7),
        ("</robot>", "<x:odd/></robot>", "yourdfpy", "text", "misreads", 0),
        (INERTIAL, "", "pybullet", "tree", "misreads", 3),
    ],
)
def test_what_a_consumer_cannot_read(find: str, write: str, consumer: str, kind: str, effect: str, line: int) -> None:
    (found, *_) = read_as(consumer, ROBOT.replace(find, write, 1).encode())
    assert (found.kind, found.effect, found.line) == (kind, effect, line), found


@pytest.mark.parametrize("consumer", CONSUMERS)
@pytest.mark.parametrize(
    "text", [b"", b" ", b"\0", b"<", b"<robot", b"\xff\xfe<", b"<a/>", b"<robot/>", b"<!--", b"]]>"]
)
def test_nothing_at_all_is_refused(consumer: str, text: bytes) -> None:
    assert "refuses" in {each.effect for each in read_as(consumer, text)}


def test_tinyxml_takes_what_is_no_xml_and_its_successor_does_not() -> None:
    unquoted, late = b"<robot name=r/>", b"<robot><?odd?></robot>"
    for text in (unquoted, late):
        assert tiny.parse_with_tinyxml(text, tiny.TINYXML)[0].tag == "robot"
        with pytest.raises(UnparsedError):
            tiny.parse_with_tinyxml(text, tiny.TINYXML_2)
    for text in (b"<a><b></a>", b"<a b='1' b='2'/>", b"<a", b"<a><!-- </a>"):
        with pytest.raises(UnparsedError):
            tiny.parse_with_tinyxml(text, tiny.TINYXML)


def test_bullet_breaks_long_lines_and_cuts_them_at_odd_ends() -> None:
    assert tiny.split_as_bullet(b"a" * 8192 + b"\nb\rc\n") == b"a" * 8191 + b"\na\nb\n"


def test_values_stay_as_they_are_written() -> None:
    (root,) = tiny.parse_with_tinyxml(b"<a b='1\t2&#10;&lt;&odd;'>x</a>", tiny.TINYXML)
    assert root.attributes == {"b": "1\t2\n<&odd;"}
    assert root.text == "x"


def test_a_table_is_like_another_one_but_for_what_it_says() -> None:
    demands, base = reads("pinocchio@3").demands, reads("urdfdom@4.0").demands
    assert base == demands[: len(base)]
    assert len(base) < len(demands)
    silent = {each for each in reads("urdfdom@6.0").demands if each.effect == "warns"}
    assert not silent & set(reads("pinocchio@4").demands)
    demands, base = reads("gazebo").demands, reads("urdfdom@4.0").demands
    kept = tuple(each for each in base if each.item != "<joint>")  # in <gazebo>, which it reads
    assert kept == demands[: len(kept)]


LATE = '<origin rpy="0 0 0" quat_xyzw="0 0 0 1"/>'


@pytest.mark.parametrize(
    ("version", "inside", "effects"),
    [
        ("1.0", '<limit effort="1" velocity="1"/>', []),
        ("1.2", '<limit effort="1" velocity="1"/>', ["refuses", "refuses"]),
        ("1.1", '<limit lower="0" upper="1"/>', ["refuses", "refuses"]),
        ("1.2", '<limit lower="0" upper="1"/>', []),
        ("+1.02", '<limit lower="0" upper="1"/>', []),
        ("1.1", '<limit effort="-1" velocity="1" jerk="x"/>', ["warns"]),
        ("1.2", '<limit lower="0" upper="1" effort="-1" jerk="x"/>', ["refuses", "refuses"]),
        ("1.2", '<limit lower="2" upper="1"/>', ["refuses"]),
        ("1.0", f'{LATE}<limit effort="1" velocity="1"/>', ["warns"]),
        ("1.1", f'{LATE}<limit effort="1" velocity="1"/>', ["refuses"]),
    ],
)
def test_a_line_is_about_the_version_that_the_file_declares(version: str, inside: str, effects: list[str]) -> None:
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    text = ROBOT.replace('name="r"', f'name="r" version="{version}"').replace(limit, inside)
    assert [each.effect for each in read_as("urdfdom@rolling", text.encode())] == effects


@pytest.mark.parametrize(
    ("version", "size", "effects"),
    [("1.0", "1", ["drops", "drops"]), ("1.1", "1", []), ("1.1", "0", []), ("1.2", "1", []), ("1.2", "0", ["drops"])],
)
def test_a_capsule_is_one_since_the_version_that_has_it(version: str, size: str, effects: list[str]) -> None:
    capsule = f'<visual><geometry><capsule radius="{size}" length="1"/></geometry></visual>'
    text = ROBOT.replace('name="r"', f'name="r" version="{version}"').replace('name="a">', f'name="a">{capsule}', 1)
    assert [each.effect for each in read_as("urdfdom@rolling", text.encode())] == effects


def test_a_line_is_about_releases() -> None:
    assert (reads("urdfdom@humble").parser, reads("urdfdom").parser) == ("tinyxml", "tinyxml2")
    versions = {
        name: [each.form for each in reads(f"urdfdom@{name}").demands if each.item == "@version"]
        for name in ("humble", "kilted", "5.1", "rolling")
    }
    assert versions == {"humble": ["urdf-1.0"], "kilted": ["urdf-1.0"], "5.1": ["urdf-1.1"], "rolling": ["urdf-1.2"]}


@pytest.mark.parametrize(
    ("find", "write", "rule"),
    [
        ('effort="1"', 'effort="inf"', rules.UNREAD_VALUE),
        (' effort="1"', "", rules.UNWRITTEN_PART),
        ('<axis xyz="0 0 1"/>', '<axis xyz="0 0 1"/><odd/>', rules.UNREAD_PART),
        ("</robot>", "<link name='c'/></robot>", rules.UNTAKEN_TREE),
        ("</robot>", "<?odd?></robot>", rules.UNREAD_TEXT),
    ],
    ids=["unread-value", "unwritten-part", "unread-part", "untaken-tree", "unread-text"],
)
def test_a_profile_reports_shortfalls_by_rules(find: str, write: str, rule: object) -> None:
    profiles = tuple(profile for name in CONSUMERS for profile in load(name))
    content = ROBOT.replace(find, write).encode()
    found = assess(ProfiledFile("robot.urdf", Format.URDF, content=content), profiles)
    assert {judgment.finding.rule for each in found for judgment in each.judgments} >= {rule}
    same = [judgment.finding for each in found for judgment in each.judgments if judgment.finding.rule is rule]
    assert len({id(each) for each in same}) < len(same) or len(same) == 1 or rule is rules.UNREAD_TEXT
    clean = assess(ProfiledFile("robot.urdf", Format.URDF, content=ROBOT.encode()), profiles)
    assert {each.verdict for each in clean} == {ConsumerVerdict.ACCEPTS}
