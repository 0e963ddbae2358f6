"""Small robots with `<ros2_control>`."""

import twinform
from twinform.ir import Document

GAZEBO = "gz_ros2_control/GazeboSimSystem"
_LINK = (
    '<link name="{name}">'
    '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    '<collision><origin rpy="1.5707963267948966 0 0"/><geometry><cylinder radius="{radius}" length="0.1"/></geometry>'
    "</collision></link>"
)


def link(name: str, radius: float = 0.2) -> str:
    """A link with a cylinder about y."""
    return _LINK.format(name=name, radius=radius)


def joint(
    name: str, child: str, kind: str = "revolute", *, parent: str = "base", y: float = 0.0, axis: str = "0 1 0"
) -> str:
    """A joint of a robot."""
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>' if kind in {"revolute", "prismatic"} else ""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="0 {y} 0"/>'
        f'<axis xyz="{axis}"/>{limit}</joint>'
    )


def interfaces(name: str, commands: str, states: str = "position velocity", tag: str = "joint", rest: str = "") -> str:
    """A joint of a system with its interfaces."""
    inner = "".join(f'<command_interface name="{each}"/>' for each in commands.split())
    inner += "".join(f'<state_interface name="{each}"/>' for each in states.split())
    return f'<{tag} name="{name}">{inner}{rest}</{tag}>'


def system(content: str, name: str = "main", kind: str = "system", hardware: str = GAZEBO) -> str:
    """A `<ros2_control>`."""
    return (
        f'<ros2_control name="{name}" type="{kind}"><hardware><plugin>{hardware}</plugin></hardware>'
        f"{content}</ros2_control>"
    )


def robot(*parts: str) -> Document:
    """A URDF with a base and these parts."""
    return twinform.loads(f'<robot name="r">{link("base", 0.1)}{"".join(parts)}</robot>')


def rover(*more: str, axis: str = "0 1 0", radius: float = 0.2, commands: str = "velocity") -> Document:
    """A robot with two wheels that are driven."""
    wheels = [
        link("left", radius),
        link("right"),
        joint("left_joint", "left", "continuous", y=0.3, axis=axis),
        joint("right_joint", "right", "continuous", y=-0.3),
    ]
    return robot(
        *wheels, *more, system(interfaces("left_joint", commands) + interfaces("right_joint", commands), name="wheels")
    )
