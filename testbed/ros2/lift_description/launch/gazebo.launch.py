# pyright: basic, reportMissingImports=false, reportAttributeAccessIssue=false
"""Put a robot into a Gazebo that runs: MODEL may be URDF, SDF or xacro, and is converted when the launch file is."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    """Describe what is started."""
    share = Path(get_package_share_directory("lift_description"))
    # what twinform says of a conversion goes to stderr, which stops a launch unless it is told otherwise
    description = Command(["twinform convert '", LaunchConfiguration("model"), "' --to urdf"], on_stderr="ignore")
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "model", default_value=str(share / "sdf" / "lift.sdf"), description="The model to put into Gazebo"
            ),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[
                    {"robot_description": ParameterValue(description, value_type=str)},
                    {"use_sim_time": True},
                ],
                output="screen",
            ),
            Node(
                package="ros_gz_sim",
                executable="create",
                arguments=["-name", "lift", "-topic", "robot_description"],
                output="screen",
            ),
        ]
    )
