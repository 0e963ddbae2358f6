"""Rules about transmissions of ROS 1 and ros2_control; the passes between them report these."""

from twinform.diagnostics.fix import Safety
from twinform.diagnostics.rule import Rule, Severity

CONVERTED_TRANSMISSION = Rule(
    name="converted-transmission",
    severity=Severity.INFO,
    finds="A transmission of ROS 1 that became a part of a `<ros2_control>` system.",
    matters="ROS 2 reads transmissions only inside of `<ros2_control>`. Interfaces and reduction are "
    "the same; the elements for them are not.",
    example="`<transmission>` with `hardware_interface/EffortJointInterface`.",
    better="Nothing needs doing. `keep=true` leaves the transmission in place for programs of ROS 1.",
    references="ros2_control, `hardware_interface` and `transmission_interface`.",
)
UNCONVERTED_TRANSMISSION = Rule(
    name="unconverted-transmission",
    severity=Severity.WARNING,
    finds="A transmission that is not converted, with the reason: its joint is missing, cannot move or is in a "
    "`<ros2_control>` already, or other programs read parts of it that ROS 2 does not have.",
    matters="ROS 2 does not see it; controllers for its joint find no interface.",
    example="A transmission of joint `hip` in a robot without such a joint; `<drake:rotor_inertia>` in an actuator.",
    better="Correct the name of the joint, or leave the transmission out.",
)
FOREIGN_TRANSMISSION = Rule(
    name="foreign-transmission",
    severity=Severity.WARNING,
    finds="A transmission of a type that does not come with ros_control or ros2_control.",
    matters="Only a package that brings a plugin of this name can load it. Simulators do not ask: they drive the joint "
    "itself.",
    example="`<type>hey5_transmissions/Hey5Reducer</type>`",
    better="Install a package with a plugin of this name for the real robot, or use one of the three that come along: "
    "simple, differential, four-bar linkage.",
    references="ros2_control, `transmission_interface`.",
)
FOREIGN_HARDWARE_INTERFACE = Rule(
    name="foreign-hardware-interface",
    severity=Severity.WARNING,
    finds="A hardware interface of a joint that has no command interface in ros2_control, or may not have one.",
    matters="The joint gets its state interfaces and no command for this interface.",
    example="`franka_hw/FrankaStateInterface`; a command for a joint that mimics another.",
    better="Write the command interfaces that the hardware component of ROS 2 offers.",
)
CONVERTED_ROS2_CONTROL = Rule(
    name="converted-ros2-control",
    severity=Severity.INFO,
    finds="A `<ros2_control>` whose joints became transmissions of ROS 1.",
    matters="ROS 1 reads no `<ros2_control>`. The interfaces and the reductions are the same; the elements are not.",
    example="`<ros2_control name='arm' type='system'>` with joints.",
    better="Nothing needs doing. `keep=true` leaves it in place for programs of ROS 2.",
)
UNSAYABLE_IN_TRANSMISSIONS = Rule(
    name="unsayable-in-transmissions",
    severity=Severity.WARNING,
    finds="A part of `<ros2_control>` that ROS 1 has no equivalent of: hardware and its parameters, limits of "
    "interfaces, "
    "sensors, inputs and outputs.",
    matters="In ROS 1 the driver is a program that is started beside the robot, with parameters of its own.",
    example="`<command_interface name='position'><param name='min'>-1</param></command_interface>`",
    better="Give the values to the driver in its configuration.",
)
UNKNOWN_DRIVEN_JOINT = Rule(
    name="unknown-driven-joint",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A transmission or `<ros2_control>` that names a joint which the robot does not have.",
    matters="The controller manager refuses to start, or leaves the joint without a drive.",
    example="`<transmission name='hip_drive'><joint name='hipp'>...` in a robot whose joint is called `hip`.",
    better="Correct the name.",
)
TRANSMISSION_WITHOUT_JOINT = Rule(
    name="transmission-without-joint",
    severity=Severity.WARNING,
    finds="A transmission in which no joint is named.",
    matters="It drives nothing; ros_control refuses it and does not load the others either.",
    example="`<transmission name='hip_drive'><type>...</type><actuator name='hip_motor'/></transmission>`",
    better="Write `<joint name='...'>` with its hardware interface into it.",
)

TIDIED_TRANSMISSION = Rule(
    name="tidied-transmission",
    severity=Severity.INFO,
    finds="A transmission that was completed, or left out because it has no joint of the robot or no actuator.",
    matters="Drake and urdf_parser_py refuse the file for a transmission that lacks a type, a joint or an interface.",
    example="`tidy-transmissions` on `<transmission name='t'><joint name='j'/><actuator name='m'/></transmission>`.",
    better="Write `<type>`, a joint with a `<hardwareInterface>`, and an actuator.",
)
