from pathlib import Path

import pytest

import twinform
from twinform.compiler import CompileError

DANGLING = """<?xml version="1.0"{}?>
<robot name="r">
  <link name="a"/>
  <!-- twinform: allow dangling-link{} -->
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>
"""


def _rules(text: str | bytes) -> set[str]:
    found = twinform.check(text.encode() if isinstance(text, str) else text)
    return {each.rule.name for each in found.diagnostics}


def test_an_allowed_error_is_none_and_the_result_says_which_it_was() -> None:
    found = twinform.check(DANGLING.format("", " - mounted later").encode())
    assert found.accepted
    assert [each.rule.name for each in found.allowed] == ["dangling-link"]


def test_it_stops_no_conversion_and_is_an_error_for_everybody_else() -> None:
    source = DANGLING.format("", "").encode()
    assert "<child>b</child>" in twinform.convert(source, to="sdf").text
    with pytest.raises(CompileError, match="there is no such link"):
        twinform.loads(source)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "iso-8859-1"])
def test_any_encoding_and_line_end(encoding: str) -> None:
    text = DANGLING.format(f' encoding="{encoding}"', " - später").replace("\n", "\r\n")
    assert _rules(text.encode(encoding)) <= {"wide-encoding"}


def test_two_hyphens_before_the_reason_are_no_xml_and_allow_all_the_same() -> None:
    assert _rules(DANGLING.format("", " -- mounted later")) == {"repaired-xml"}


@pytest.mark.parametrize("joints", ["ab ba ac", "ab bc cb"], ids=["without-root", "below-root"])
def test_what_goes_round_is_allowed_by_check_and_cannot_be_converted(joints: str) -> None:
    listed = "".join(
        f'<joint name="{name}" type="fixed"><parent link="{name[0]}"/><child link="{name[1]}"/></joint>'
        for name in joints.split()
    )
    text = f"""<robot name="r">
      <!-- twinform: allow-file two-parents, kinematic-loop -->
      <link name="a"/><link name="b"/><link name="c"/>{listed}
    </robot>""".encode()
    assert twinform.check(text).accepted
    with pytest.raises(CompileError):
        twinform.convert(text, to="sdf")


def test_an_error_without_which_there_is_no_model_is_allowed_in_check_and_stays_in_a_conversion() -> None:
    source = b"""<robot name="r"><!-- twinform: allow-file invalid-value --><link name="a"/>
    <joint name="j" type="turning"><parent link="a"/><child link="b"/></joint></robot>"""
    checked = twinform.check(source)
    assert (checked.document, checked.accepted) == (None, False)
    assert [each.rule.name for each in checked.diagnostics if each.is_error] == ["dangling-link"]
    with pytest.raises(CompileError) as caught:
        twinform.convert(source, to="sdf")
    *_, found = [each for each in caught.value.diagnostics if each.is_error]
    assert found.rule.name == "invalid-value"
    assert "it is allowed, and stays: without this part there is no model" in (found.help or "")


def test_an_allowed_error_that_a_conversion_fails_of_is_named() -> None:
    source = b"""<sdf version="1.9"><model name="m"><link name="a"/>
      <!-- twinform: allow dangling-link -->
      <joint name="j" type="fixed"><parent>a</parent><child>nowhere</child></joint></model></sdf>"""
    assert twinform.check(source).accepted
    with pytest.raises(CompileError) as caught:
        twinform.convert(source, to="urdf")
    assert any(each.is_error for each in caught.value.diagnostics)


def test_findings_in_an_included_file_are_allowed_there(tmp_path: Path) -> None:
    (tmp_path / "crate.sdf").write_text(
        '<sdf version="1.9"><model name="crate">\n<!-- twinform: allow unknown-element, zero-axis -->\n'
        '<link name="a">\n<hue/>\n</link></model></sdf>'
    )
    world = tmp_path / "world.sdf"
    world.write_text('<sdf version="1.9"><world name="w"><include><uri>crate.sdf</uri></include></world></sdf>')
    with_it = twinform.check(world, expand_includes=True)
    assert "unknown-element" not in {each.rule.name for each in with_it.diagnostics}
    assert "unknown-element" in {each.rule.name for each in twinform.check(tmp_path / "crate.sdf").allowed}
    alone = {each.rule.name for each in twinform.check(tmp_path / "crate.sdf").diagnostics}
    assert alone == {"unused-suppression", "missing-inertial"}


def test_rules_can_be_allowed_by_the_caller_too() -> None:
    text = DANGLING.format("", "").replace("twinform:", "")
    assert not twinform.check(text.encode()).accepted
    assert twinform.check(text.encode(), allow=["dangling-link"]).accepted
    assert "<child>b</child>" in twinform.convert(text.encode(), to="sdf", allow=["dangling-link"]).text


def test_fatal_errors_stay() -> None:
    found = twinform.check(b"<!-- twinform: allow-file not-well-formed -->\n<robot name='r'><link", allow=["doctype"])
    assert found.unreadable
    assert [each.rule.name for each in found.diagnostics if each.is_error] == ["not-well-formed"]
    assert "not-well-formed" not in {each.rule.name for each in found.allowed}
