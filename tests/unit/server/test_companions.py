"""Companion files in the editor: names lead to the robot, follow when it changes, and findings are shown."""

import shutil
from pathlib import Path

import pytest

from tests.unit.server.test_navigation import opened, renamed
from twinform.server.checking import CheckJob, EditorSettings, check
from twinform.server.navigation import RenameRefusedError, definitions, prepare, rename

_ROBOTS = Path(__file__).parents[2] / "cases/companions"
_MOVEIT = "lifter_moveit_config/config"


@pytest.fixture
def lifter(tmp_path: Path) -> Path:
    shutil.copytree(_ROBOTS / "lifter", tmp_path / "lifter")
    return tmp_path / "lifter"


def _count(texts: dict[str, str], name: str) -> dict[str, int]:
    return {file: text.count(name) for file, text in texts.items()}


def test_srdf_and_parameters_follow_the_joint_of_a_robot(lifter: Path) -> None:
    session, document = opened(lifter / "lifter_description/urdf/lifter.urdf")
    texts = renamed(session, document, '<joint name="|raise" type', "elevate")
    assert _count(texts, "elevate") == {
        "lifter.urdf": 2,
        "lifter.srdf": 1,
        "joint_limits.yaml": 1,
        "moveit_controllers.yaml": 1,
        "ros2_controllers.yaml": 2,
    }
    for name, text in texts.items():
        before = next(lifter.rglob(name)).read_text(encoding="utf-8")
        assert text == before.replace("raise", "elevate"), name


def test_a_name_in_a_companion_file_leads_to_its_definition_and_renames_it(lifter: Path) -> None:
    for name, at in (("lifter.srdf", 'tip_link="tool_p|late"'), ("joint_limits.yaml", "  tu|rn:")):
        session, document = opened(lifter / _MOVEIT / name)
        offset = document.text.index(at.replace("|", "")) + at.index("|")
        (place,) = definitions(session, document, offset)
        assert place.document.path.name == "lifter.urdf"
        assert place.span.of(place.document.text) in {"tool_plate", "turn"}
        assert prepare(document, offset) is not None
        assert {"lifter.urdf", "lifter.srdf"} <= renamed(session, document, at, "another").keys()


def test_a_stale_name_and_one_of_another_robot_are_left(lifter: Path) -> None:
    path = lifter / _MOVEIT / "joint_limits.yaml"
    session, document = opened(path, "joint_limits:\n  pan: {max_velocity: 1}\n")
    with pytest.raises(RenameRefusedError, match="no robot is known that has 'pan'"):
        rename(session, document, document.text.index("pan"), "turn")
    other = lifter / "lifter_moveit_config/other.urdf"
    other.write_text('<robot name="other"><link name="pedestal"/></robot>', encoding="utf-8")
    session, document = opened(other)
    assert renamed(session, document, '<link name="|pedestal"', "foot").keys() == {"other.urdf"}
    session, document = opened(lifter / "lifter_description/urdf/lifter.urdf")
    assert renamed(session, document, '<link name="|pedestal"', "foot").keys() == {"lifter.urdf", "lifter.srdf"}


def test_files_that_srdf_includes_follow(tmp_path: Path) -> None:
    shutil.copytree(_ROBOTS / "probe", tmp_path / "probe")
    config = tmp_path / "probe/config"
    head = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
    text = (config / "probe.srdf.xacro").read_text(encoding="utf-8")
    macro = text[text.index("<xacro:macro") : text.index("</xacro:macro>") + len("</xacro:macro>")]
    (config / "looking.xacro").write_text(f"{head}{macro}</robot>", encoding="utf-8")
    include = '<xacro:include filename="looking.xacro"/>'
    (config / "probe.srdf.xacro").write_text(text.replace(macro, include), encoding="utf-8")
    session, document = opened(tmp_path / "probe/urdf/probe.urdf")
    texts = renamed(session, document, '<joint name="|neck"', "throat")
    assert _count(texts, "throat") == {
        "probe.urdf": 1,
        "probe.srdf.xacro": 1,
        "looking.xacro": 1,
        "controllers.yaml": 3,
    }


def test_findings_are_shown_for_the_text_in_the_editor(lifter: Path) -> None:
    path = lifter / _MOVEIT / "kinematics.yaml"
    text = b"arms:\n  kinematics_solver: some/Solver\n"
    checked = check(CheckJob(path, {str(path): text}, EditorSettings()))
    assert [(each.rule.name, each.location.line, each.location.column) for each in checked.diagnostics] == [
        ("stale-name", 1, 1)
    ]
    assert check(CheckJob(path, {str(path): b"a: [b\n"}, EditorSettings())).diagnostics == ()
