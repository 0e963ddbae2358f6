"""What the panel says, as HTML: names do nothing in it, and nothing of a robot is left out of its tree."""

import re

import twinform
from tests.unit.report.models import EVIL, hostile
from twinform.compiler import LoadOptions
from twinform.view import Subject, read_subject
from twinform.view.names import shortened
from twinform.view.words import part, tree, verdict

LOOP = """<sdf version="1.11"><model name="loop"><link name="a"/><link name="b"/><link name="c"/>
  <joint name="ab" type="fixed"><parent>a</parent><child>b</child></joint>
  <joint name="bc" type="fixed"><parent>b</parent><child>c</child></joint>
  <joint name="ac" type="fixed"><parent>a</parent><child>c</child></joint>
</model></sdf>"""


def _subject(text: str) -> Subject:
    subject, _ = read_subject(text.encode(), LoadOptions())
    assert subject is not None
    return subject


def _words(html: str) -> list[str]:
    return re.findall(r"<div style=\"padding-left:(\d+)em\">([^<]*)", html)


def test_a_joint_that_closes_a_loop_is_listed_where_it_closes_it():
    shown = tree(_subject(LOOP).scene)
    assert [name for _, name in _words(shown)].count("c ") + [name for _, name in _words(shown)].count("c") == 2
    assert all(f"fixed {joint}" in shown for joint in ("ab", "bc", "ac"))


def test_a_chain_of_a_thousand_links_is_listed_whole():
    links = "".join(f'<link name="l{i}"/>' for i in range(1000))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i - 1}"/><child link="l{i}"/></joint>' for i in range(1, 1000)
    )
    rows = _words(tree(_subject(f'<robot name="r">{links}{joints}</robot>').scene))
    assert len(rows) == 1000
    assert max(int(depth) for depth, _ in rows) <= 60


def test_hostile_names_are_text():
    subject = _subject(hostile())
    for shown in (tree(subject.scene), part(EVIL, subject), verdict([subject])):
        assert "<script" not in shown
        assert 'onclick="' not in shown


def test_a_part_has_its_numbers_and_its_findings():
    text = """<robot name="r"><link name="base"><inertial><origin xyz="0 0 0.5"/><mass value="2"/>
      <inertia ixx="9" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""
    shown = part("base", _subject(text))
    assert "<td>2 kg</td>" in shown
    assert "0 0 0.5 m" in shown
    assert "the last exceeds the sum of the others" in shown
    assert part("none", _subject(text)) == ""


def test_a_finding_is_on_the_link_that_a_joint_moves():
    subject = _subject(twinform.dumps(twinform.loads(LOOP)))
    paths = {joint.name: joint.where.path for joint in subject.scene.joints}
    assert subject.link_at(f"{paths['ab']}/axis[1]/limit[1]") == "b"
    assert subject.link_at("") is None
    assert subject.link_at("/elsewhere[1]") is None


def test_names_fit_into_a_line():
    assert shortened("a\nb\u202ec") == "a\N{REPLACEMENT CHARACTER}b\N{REPLACEMENT CHARACTER}c"
    assert len(shortened("x" * 10_000)) == 80
    assert shortened("Gelenk ö 中") == "Gelenk ö 中"
