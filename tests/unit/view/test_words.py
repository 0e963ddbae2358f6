"""What the panel says, as HTML: names do nothing in it, and nothing of a robot is left out of its tree."""

from pathlib import Path

import twinform
from tests.unit.report.models import EVIL, hostile
from twinform.compiler import LoadOptions
from twinform.compiler.graph.graph import shortened
from twinform.diagnostics import Location
from twinform.diagnostics.ledger import LedgerEntry
from twinform.view import ViewSubject, read_subject
from twinform.view.words import Mark, part, tree, verdict

LOOP = """<sdf version="1.11"><model name="loop"><link name="a"/><link name="b"/><link name="c"/>
  <joint name="ab" type="fixed"><parent>a</parent><child>b</child></joint>
  <joint name="bc" type="fixed"><parent>b</parent><child>c</child></joint>
  <joint name="ac" type="fixed"><parent>a</parent><child>c</child></joint>
</model></sdf>"""


def _subject(text: str) -> ViewSubject:
    subject, _ = read_subject(text.encode(), LoadOptions())
    assert subject is not None
    return subject


def test_hostile_names_are_text():
    subject = _subject(hostile())
    for shown in (tree(subject.scene, {EVIL: [Mark(EVIL, "red", EVIL)]}), part(EVIL, subject), verdict([subject])):
        assert "<script" not in shown
        assert 'onclick="' not in shown


def test_a_part_has_its_numbers_and_its_findings():
    text = """<robot name="r"><link name="base"><inertial><origin xyz="0 0 0.5"/><mass value="2"/>
      <inertia ixx="9" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""
    shown = part("base", _subject(text))
    assert "<td>2 kg</td>" in shown
    assert "0 0 0.5 m" in shown
    assert "violate the triangle inequality" in shown
    assert part("none", _subject(text)) == ""


def test_a_finding_is_on_the_link_that_a_joint_moves():
    subject = _subject(twinform.dumps(twinform.loads(LOOP)))
    paths = {joint.name: joint.where.path for joint in subject.scene.joints}
    assert subject.links_at(Location("", path=f"{paths['ab']}/axis[1]/limit[1]")) == ("b",)
    assert subject.links_at(Location("", path="")) == ()
    assert subject.links_at(Location("", path="/elsewhere[1]")) == ()


WORLD = """<sdf version="1.11"><world name="w">
  <model name="one"><link name="base"/><link name="tip"/>
    <joint name="j" type="ball"><parent>base</parent><child>tip</child></joint></model>
  <model name="two"><link name="base"/></model>
  <model name="around"><link name="base"/><model name="inner"><link name="base"/><link name="tip"/>
    <joint name="j" type="ball"><parent>base</parent><child>tip</child></joint></model></model>
</world></sdf>"""


def test_what_becomes_of_a_part_is_said_in_worlds_and_models_in_models():
    subject = _subject(WORLD)
    fates = {
        link: [each.message for each in about if isinstance(each, LedgerEntry)] for link, about in subject.about.items()
    }
    assert any("ball" in each for each in fates["one::tip"])
    assert any("ball" in each for each in fates["around::inner::tip"])
    assert "<th>carried</th>" in part("one::tip", subject)
    assert not any("ball" in each for each in fates.get("two::base", ()))


def test_a_model_that_cannot_be_converted_says_why_it_has_no_ledger():
    subject = _subject("""<sdf version="1.11"><model name="m"><link name="a"/>
      <model name="in"><link name="b"/><frame name="f"/></model><frame name="g" attached_to="in::f"/>
      <joint name="j" type="ball"><parent>g</parent><child>in::f</child></joint></model></sdf>""")
    assert not subject.entries
    assert "no ledger, as it cannot be converted: it has errors" in verdict([subject])


def test_a_model_that_is_included_twice_has_its_findings_on_both(tmp_path: Path):
    (tmp_path / "part").mkdir()
    (tmp_path / "part" / "model.sdf").write_text(LOOP.replace('name="loop"', 'name="part"'))
    world = """<sdf version="1.11"><world name="w"><include><uri>part</uri><name>x</name></include>
      <include><uri>part</uri><name>y</name></include></world></sdf>"""
    (tmp_path / "world.sdf").write_text(world)
    subject, loaded = read_subject(tmp_path / "world.sdf", LoadOptions())
    assert subject is not None, loaded.diagnostics
    place = next(link.where for link in subject.scene.links if link.name == "x::b")
    assert subject.links_at(place) == ("x::b", "y::b")


def test_names_fit_into_a_line():
    assert shortened("a\nb\u202ec") == "a\\nb\\u202ec"
    assert len(shortened("x" * 10_000)) == 60
    assert shortened("Gelenk ö 中") == "Gelenk ö 中"
