"""The driver: what may be fixed on the way, and what the whole reports."""

import pytest

import twinform
from twinform.compiler import check, plan
from twinform.diagnostics import Severity
from twinform.passes.framework.hooks import Statistics

_LIMITLESS = b"""<robot name="r">
  <link name="a"/><link name="b"/><link name="c"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>
  <joint name="k" type="prismatic"><parent link="b"/><child link="c"/><limit lower="0" upper="1"/></joint>
</robot>"""


def test_a_pass_may_fill_limits_that_are_missing() -> None:
    made = twinform.convert(_LIMITLESS, to="urdf", passes="fill-limits{effort=5 velocity=2}")
    assert made.text.count('effort="5" velocity="2"') == 2
    assert not [each for each in made.diagnostics if each.is_error]
    assert check(made.text.encode()).accepted


@pytest.mark.parametrize(
    ("passes", "rules"),
    [
        (None, {"missing-attribute", "missing-limit"}),
        ("check-inertia", {"missing-limit", "partial-limit"}),
        ("fill-limits{effort=5}", {"partial-limit"}),
    ],
)
def test_limits_that_stay_missing_are_errors(passes: str | None, rules: set[str]) -> None:
    with pytest.raises(twinform.CompileError) as caught:
        twinform.convert(_LIMITLESS, to="urdf", passes=passes)
    assert {each.rule.name for each in caught.value.diagnostics if each.is_error} == rules


def test_other_errors_are_never_fixed() -> None:
    with pytest.raises(twinform.CompileError):
        twinform.convert(_LIMITLESS.replace(b'"c"/>', b'"d"/>', 1), to="sdf", passes="fill-limits{effort=5 velocity=2}")


def test_the_plan_is_what_runs() -> None:
    statistics = Statistics()
    text = b'<robot name="r"><link name="a"/></robot>'
    made = twinform.convert(text, to="sdf", passes="check-inertia", instrumentation=statistics)
    ran = [each.name for each in statistics.records]
    assert made.document.version == "1.11"
    document = twinform.loads(text)
    assert [each.name for each in plan(document, to="sdf", passes="check-inertia")] == ran


def test_every_part_of_the_source_is_counted_once() -> None:
    text = b'<robot name="r"><link name="a"/><transmission name="t"><type>x</type></transmission></robot>'
    ledger = twinform.convert(text, to="sdf").ledger
    lost = sum(entry.weight for entry in ledger.entries)
    assert (ledger.expressed, lost) == (4, 3)


def test_without_carriers_parts_are_dropped() -> None:
    text = b'<robot name="r"><link name="a"/><transmission name="t"/></robot>'
    made = twinform.convert(text, to="sdf", carriers=False)
    assert [str(entry.fate) for entry in made.ledger.entries] == ["dropped", "approximated"]  # the mass of nothing
    assert "urn:twinform" not in made.text


@pytest.mark.parametrize("version", ["1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12"])
def test_sdf_is_written_in_the_version_that_is_asked_for(version: str) -> None:
    text = b"""<robot name="r"><link name="a"/><link name="b"/>
      <joint name="j" type="continuous">
        <parent link="a"/><child link="b"/><origin xyz="1 2 3" rpy="0 0 1"/>
      </joint></robot>"""
    made = twinform.convert(text, to="sdf", sdf_version=version).text
    assert twinform.loads(made).version == version
    found = check(made.encode(), strict=True).diagnostics
    assert [each.message for each in found if each.severity > Severity.INFO] == []


def test_an_undeclared_prefix_in_an_otherwise_plain_element_is_not_lost() -> None:
    text = """<robot name="r"><link name="a"><collision><geometry>
      <mesh filename="package://r/a.obj"><drake:declare_convex/></mesh></geometry></collision></link></robot>"""
    assert "<drake:declare_convex/>" in twinform.convert(text.encode(), to="urdf").text


def test_a_prefix_declared_in_utf_16_is_not_lost() -> None:
    text = """<?xml version="1.0" encoding="UTF-16"?>
      <robot name="r" xmlns:my="urn:mine"><link name="a"><collision><geometry>
      <mesh filename="package://r/a.obj"><my:part/></mesh></geometry></collision></link></robot>"""
    assert "<my:part/>" in twinform.convert(text.encode("utf-16"), to="urdf").text


@pytest.mark.parametrize("version", ["1.0", "9.9", "1.110", "newest", ""])
def test_a_version_that_sdf_does_not_have_is_refused(version: str) -> None:
    robot = b'<robot name="r"><link name="a"/></robot>'
    with pytest.raises(ValueError, match=f"SDF has no version '{version}'; it has 1.2, .*, 1.12$"):
        twinform.convert(robot, to="sdf", sdf_version=version)
    with pytest.raises(ValueError, match="SDF has no version"):
        plan(twinform.loads(robot), to="sdf", sdf_version=version)
