"""What <gazebo> sets for a link, joint or model that has it already."""

# pyright: reportPrivateUsage=false
from contextlib import nullcontext
from typing import Any

import pytest

import twinform
from twinform.compiler import conversion
from twinform.passes.legalise.folded_parts import FoldedPart
from twinform.passes.legalise.to_sdf import fold_gazebo

ROBOT = b"""<robot name="r">
  <link name="a">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
  <gazebo reference="a"><inertial auto="true"/></gazebo>
</robot>"""


def test_what_is_repeated_is_carried_and_comes_back():
    there = twinform.convert(ROBOT, to="sdf")
    assert "gazebo-conflict" in {found.rule.name for found in there.diagnostics}
    assert [str(entry.fate) for entry in there.ledger.entries if entry.rule.name == "gazebo-conflict"] == ["carried"]
    back = twinform.convert(there.text.encode(), to="urdf").text
    assert '<gazebo reference="a">\n    <inertial auto="true"/>\n  </gazebo>' in back


ARM = b"""<robot name="r">
  <link name="a"><collision><geometry><sphere radius="1"/></geometry></collision></link>
  <link name="b"><collision><geometry><sphere radius="1"/></geometry></collision></link>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit effort="1" velocity="1"/></joint>
  <gazebo reference="a"><mu1>0.5</mu1><mu1>0.6</mu1><sensor name="s" type="imu"/></gazebo>
  <gazebo reference="j"><springStiffness>2</springStiffness><nonsense/></gazebo>
</robot>"""


def test_a_conversion_folds_into_a_part_once(monkeypatch: pytest.MonkeyPatch):
    folded: list[str] = []

    def counted(self: fold_gazebo._Fold, fold: Any, node: Any, extensions: Any) -> FoldedPart:
        folded.append(node.name)
        return apart(self, fold, node, extensions)

    apart = fold_gazebo._Fold._apart
    monkeypatch.setattr(fold_gazebo._Fold, "_apart", counted)
    twinform.convert(ARM, to="sdf")
    assert folded == ["a", "j"]


@pytest.mark.parametrize("passes", ["", "rename{names=[a:c]}", "set-surface{mu=0.3}", "drop{sensors=[s]}"])
@pytest.mark.parametrize("carriers", [True, False])
@pytest.mark.parametrize("source", [ROBOT, ARM], ids=["inertial", "arm"])
def test_what_is_kept_of_reading_is_what_would_be_folded_again(
    monkeypatch: pytest.MonkeyPatch, source: bytes, carriers: bool, passes: str
):
    def answer() -> object:
        try:
            made = twinform.convert(source, to="sdf", passes=passes, carriers=carriers)
        except twinform.CompileError as error:
            return [str(each) for each in error.diagnostics]
        return made.text, [str(each) for each in made.diagnostics], [str(each) for each in made.ledger.entries]

    kept = answer()
    monkeypatch.setattr(conversion, "each_folded_once", nullcontext)
    assert kept == answer()
