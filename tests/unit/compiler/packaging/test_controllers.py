"""Rules: uncontrolled-joint, no-differential-drive."""

import pytest
import yaml

from twinform.compiler.packaging.controllers import Controller, controllers_of, controllers_yaml
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document

from .ros2_robots import interfaces, joint, link, robot, rover, system


def found(document: Document) -> tuple[dict[str, Controller], list[str]]:
    sink = DiagnosticSink()
    controllers = controllers_of(document, sink)
    return {each.name: each for each in controllers}, [f"{each.rule.name}: {each.message}" for each in sink.diagnostics]


def arm(*content: str, more: str = "") -> Document:
    return robot(link("a"), link("b"), joint("j1", "a"), joint("j2", "b", parent="a"), more, *content)


def test_a_robot_without_a_system_has_no_controllers() -> None:
    assert found(arm()) == ({}, [])


def test_positions_are_led_along_trajectories() -> None:
    controllers, messages = found(arm(system(interfaces("j1", "position") + interfaces("j2", "position velocity"))))
    assert list(controllers) == ["joint_state_broadcaster", "joint_trajectory_controller"]
    leading = controllers["joint_trajectory_controller"]
    assert leading.type == "joint_trajectory_controller/JointTrajectoryController"
    assert leading.parameters == {
        "joints": ["j1", "j2"],
        "command_interfaces": ["position"],
        "state_interfaces": ["position", "velocity"],
    }
    assert messages == []


def test_a_trajectory_knows_only_what_all_joints_tell() -> None:
    controllers, _ = found(arm(system(interfaces("j1", "position", "position") + interfaces("j2", "position"))))
    assert controllers["joint_trajectory_controller"].parameters["state_interfaces"] == ["position"]


def test_a_joint_that_does_not_tell_its_position_is_commanded_as_it_comes() -> None:
    controllers, _ = found(arm(system(interfaces("j1", "position", "velocity"))))
    forward = controllers["forward_position_controller"]
    assert forward.parameters == {"joints": ["j1"], "interface_name": "position"}


@pytest.mark.parametrize("command", ["velocity", "effort"])
def test_velocities_and_efforts_go_on_as_they_come(command: str) -> None:
    controllers, messages = found(arm(system(interfaces("j1", command) + interfaces("j2", command))))
    forward = controllers[f"forward_{command}_controller"]
    assert forward.type == "forward_command_controller/ForwardCommandController"
    assert forward.parameters == {"joints": ["j1", "j2"], "interface_name": command}
    assert messages == []


def test_each_of_several_systems_has_its_own() -> None:
    systems = (system(interfaces("j1", "position"), "left arm"), system(interfaces("j2", "position"), "2nd"))
    controllers, _ = found(arm(*systems))
    assert list(controllers)[1:] == ["left_arm_joint_trajectory_controller", "_2nd_joint_trajectory_controller"]


def test_single_actuators_are_led_together() -> None:
    systems = (system(interfaces(each, "position"), each, "actuator") for each in ("j1", "j2"))
    controllers, _ = found(arm(*systems))
    assert controllers["joint_trajectory_controller"].parameters["joints"] == ["j1", "j2"]


def test_names_that_become_one_get_a_number() -> None:
    systems = (system(interfaces("j1", "position"), "a b"), system(interfaces("j2", "position"), "a-b"))
    controllers, _ = found(arm(*systems))
    assert list(controllers)[1:] == ["a_b_joint_trajectory_controller", "a_b_joint_trajectory_controller_2"]


def test_what_cannot_be_controlled_is_reported() -> None:
    content = interfaces("nobody", "position") + interfaces("j1", "stiffness") + interfaces("lamp", "on", tag="gpio")
    controllers, messages = found(arm(system(content + interfaces("j2", ""))))
    assert list(controllers) == ["joint_state_broadcaster"]
    assert messages == [
        f"uncontrolled-joint: no controller is written for {each}"
        for each in (
            "joint 'nobody': the robot has no joint of this name that moves",
            "joint 'j1': its commands are stiffness, none of position, velocity and effort",
            "gpio 'lamp': what its values mean is not known",
        )
    ]


def test_sensors_are_published_for_their_frame() -> None:
    frame = '<param name="frame_id">b</param>'
    content = interfaces("a", "", "orientation.x angular_velocity.z", "sensor")
    content += interfaces("wrist", "", "force.x torque.z", "sensor", frame)
    content += interfaces("other", "", "force.x", "sensor") + interfaces("b", "", "humidity", "sensor")
    controllers, messages = found(arm(system(content)))
    motion, force = controllers["a_broadcaster"], controllers["wrist_broadcaster"]
    assert motion.type == "imu_sensor_broadcaster/IMUSensorBroadcaster"
    assert motion.parameters == {"sensor_name": "a", "frame_id": "a"}
    assert force.type == "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster"
    assert force.parameters == {"sensor_name": "wrist", "frame_id": "b"}
    assert messages == [
        "uncontrolled-joint: no broadcaster is written for sensor 'other': it names no frame",
        "uncontrolled-joint: no broadcaster is written for sensor 'b': its values are those of no sensor known",
    ]


def test_wheels_on_both_sides_are_a_drive() -> None:
    controllers, messages = found(rover())
    assert list(controllers) == ["joint_state_broadcaster", "diff_drive_controller"]
    assert controllers["diff_drive_controller"].parameters == {
        "left_wheel_names": ("left_joint",),
        "right_wheel_names": ("right_joint",),
        "wheel_separation": 0.6,
        "wheel_radius": 0.2,
        "odom_frame_id": "odom",
        "base_frame_id": "base",
    }
    assert messages == []


def test_wheels_that_are_no_drive_are_commanded_one_by_one() -> None:
    controllers, messages = found(rover(axis="0 -1 0"))
    assert controllers["forward_velocity_controller"].parameters["joints"] == ["left_joint", "right_joint"]
    (message,) = messages
    assert message.startswith("no-differential-drive: joints 'left_joint', 'right_joint' get no differential drive: ")
    assert message.endswith("the axle of joint 'left_joint' does not point to the left, along y")


def test_an_arm_on_wheels_has_both() -> None:
    more = (link("a"), joint("j1", "a"), system(interfaces("j1", "position"), "arm"))
    controllers, _ = found(rover(*more))
    assert list(controllers)[1:] == ["diff_drive_controller", "arm_joint_trajectory_controller"]


def test_the_file_is_one_of_parameters() -> None:
    controllers, _ = found(rover())
    read = yaml.safe_load(controllers_yaml(tuple(controllers.values())))
    manager = read["controller_manager"]["ros__parameters"]
    assert manager["update_rate"] == 100
    assert manager["diff_drive_controller"] == {"type": "diff_drive_controller/DiffDriveController"}
    drive = read["diff_drive_controller"]["ros__parameters"]
    assert (drive["left_wheel_names"], drive["wheel_radius"]) == (["left_joint"], 0.2)


FINGERS = (
    link("left"), link("right"), joint("left_joint", "left", "prismatic"),
    joint("right_joint", "right", "prismatic").replace("</joint>", '<mimic joint="left_joint"/></joint>'),
)  # fmt: skip


def test_a_joint_that_mimics_another_takes_no_commands() -> None:
    both = interfaces("left_joint", "position") + interfaces("right_joint", "position")
    controllers, said = found(robot(*FINGERS, system(both)))
    assert controllers["joint_trajectory_controller"].parameters["joints"] == ["left_joint"]
    (message,) = said
    assert message.startswith(
        "uncontrolled-joint: no controller is written for joint 'right_joint': it mimics another one"
    )


def test_a_mimic_that_is_lifted_takes_commands_and_so_does_one_of_humble() -> None:
    both = interfaces("left_joint", "position") + interfaces("right_joint", "position")
    lifted = robot(*FINGERS, system(both.replace('"right_joint"', '"right_joint" mimic="false"')))
    for document, release in ((lifted, "jetty"), (robot(*FINGERS, system(both)), "fortress")):
        sink = DiagnosticSink()
        (_, controller) = controllers_of(document, sink, release)
        assert controller.parameters["joints"] == ["left_joint", "right_joint"]
        assert not sink.diagnostics
