"""Names of ros_control interfaces and transmission types in ros2_control.

Facts from ros_control's `hardware_interface` and `transmission_interface`, `pr2_mechanism_model`, and from
ros2_control's packages of the same names.
"""

STATES = ("position", "velocity", "effort")
"""What a joint of ros_control tells: `JointStateHandle` has all three."""

COMMANDS: dict[str, tuple[str, ...]] = {
    "PositionJointInterface": ("position",),
    "VelocityJointInterface": ("velocity",),
    "EffortJointInterface": ("effort",),
    "PosVelJointInterface": ("position", "velocity"),
    "PosVelAccJointInterface": ("position", "velocity", "acceleration"),
    "JointStateInterface": (),
}
"""The command interfaces that an interface of ros_control stands for."""

CLASSES: dict[str, str] = {
    "position": "hardware_interface/PositionJointInterface",
    "velocity": "hardware_interface/VelocityJointInterface",
    "effort": "hardware_interface/EffortJointInterface",
}
"""The class of ros_control for one command interface."""

STATE_CLASS = "hardware_interface/JointStateInterface"

SIMPLE = "transmission_interface/SimpleTransmission"
PLUGINS = frozenset({
    SIMPLE,
    "transmission_interface/DifferentialTransmission",
    "transmission_interface/FourBarLinkageTransmission",
})  # fmt: skip
"""The transmissions that come with ros2_control; they have the same names in ros_control."""

OLDER_TYPES: dict[str, str] = {
    "SimpleTransmission": SIMPLE,
    "pr2_mechanism_model/SimpleTransmission": SIMPLE,
}
"""What older files call the same transmissions."""

COMMANDED_BY_TYPE: dict[str, str] = {"pr2_mechanism_model/SimpleTransmission": "EffortJointInterface"}
"""The interface that goes without saying: the mechanism of the PR2 commands efforts and nothing else."""


def commands_of(interface: str) -> tuple[str, ...] | None:
    """The command interfaces of an interface of ros_control; `None` where it is none of its own."""
    package, _, name = interface.rpartition("/")
    return COMMANDS.get(name) if package in {"", "hardware_interface"} else None
