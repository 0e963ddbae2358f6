"""libsdformat sees the surfaces and colors that passes have set in URDF."""

import re
from pathlib import Path

import pytest

import twinform
from testbed.oracles import sdf_printing

ROBOT = """<robot name="r"><link name="a">
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><sphere radius="1"/></geometry></visual>
<collision><geometry><sphere radius="1"/></geometry></collision>
</link><gazebo reference="a"><material>Gazebo/Orange</material><mu2>0.25</mu2></gazebo></robot>"""


@pytest.mark.parametrize(
    ("passes", "expected"),
    [
        ("set-surface{mu=0.5 mu2=0.75}", {"mu": "0.5", "mu2": "0.75"}),
        (
            "set-surface{kp=1e5 kd=10 min-depth=0.001}",
            {"kp": "100000", "kd": "10", "min_depth": "0.001", "mu2": "0.25"},
        ),
        ("set-surface{restitution=0.5}", {"restitution_coefficient": "0.5", "mu2": "0.25"}),
        ("set-surface{slip1=0.5}", {"slip1": "0.5", "mu2": "0.25"}),
        ("materials", {"ambient": "1 0.5088 0.0468 1", "diffuse": "1 0.5088 0.0468 1"}),
        ("materials{pbr=true roughness=0.5}", {"roughness": "0.5", "metalness": "0", "mu2": "0.25"}),
    ],
)
def test_libsdformat_reads_what_was_set(passes: str, expected: dict[str, str], tmp_path: Path) -> None:
    if not sdf_printing.available():
        pytest.skip("libsdformat 12 is not installed")
    path = tmp_path / "robot.urdf"
    path.write_text(twinform.convert(ROBOT.encode(), to="urdf", passes=passes).text)
    seen = sdf_printing.printed(path) or ""
    found = {name: re.findall(f"<{name}>([^<]*)<", seen) for name in expected}
    assert found == {name: [value] for name, value in expected.items()}
