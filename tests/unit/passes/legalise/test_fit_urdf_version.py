"""Limits in other versions of URDF."""

import pytest

import twinform
from twinform.diagnostics import Fate
from twinform.request_options import UrdfVersion

ROBOT = """<robot name="r" version="{version}"><link name="a"/><link name="b"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="{effort}" velocity="{velocity}"/></joint></robot>"""


@pytest.mark.parametrize(("effort", "velocity", "gone"), [("-1", "2", {"effort"}), ("0", "-0.5", {"velocity"})])
def test_a_negative_limit_is_none_in_1_2_which_refuses_it(effort: str, velocity: str, gone: set[str]) -> None:
    source = ROBOT.format(version="1.1", effort=effort, velocity=velocity)
    made = twinform.convert(source.encode(), to="urdf", urdf_version="1.2")
    limit = made.document.models[0].joints[0].axis
    assert limit is not None
    assert limit.limit is not None
    assert {name for name in ("effort", "velocity") if getattr(limit.limit, name) is None} == gone
    (entry,) = (each for each in made.ledger.entries if each.rule.name == "unbounded-limit")
    assert (entry.fate, entry.location.path.rpartition("/@")[2]) == (Fate.APPROXIMATED, *gone)
    assert all(f" {name}=" not in made.text for name in gone)


@pytest.mark.parametrize("version", ["1.0", "1.1"])
def test_a_negative_limit_stays_in_versions_that_read_it(version: UrdfVersion) -> None:
    source = ROBOT.format(version="1.0", effort="-1", velocity="2").encode()
    assert ' effort="-1"' in twinform.convert(source, to="urdf", urdf_version=version).text
