"""What <gazebo> sets for a link, joint or model that has it already."""

import twinform

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
