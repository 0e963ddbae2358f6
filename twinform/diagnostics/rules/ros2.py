"""Rules about packages of ROS 2: what their controllers, and Gazebo behind them, cannot do for a model."""

from twinform.diagnostics.rule import Rule, Severity

UNCONTROLLED_JOINT = Rule(
    name="uncontrolled-joint",
    severity=Severity.WARNING,
    finds="A joint, sensor or GPIO of `<ros2_control>` that no controller of the package commands or publishes, with "
    "the reason: the robot has no such joint, it mimics another one, or its interfaces mean nothing that is known.",
    matters="It stays where it is, or its values are not published, until somebody writes a controller for it. Since "
    "ROS 2 Jazzy, the controller manager stops where a joint that mimics another one has a `<command_interface>`.",
    example="`<joint name='elbow'><command_interface name='stiffness'/></joint>`",
    better="Correct the name of the joint, or add a controller for it to config/controllers.yaml. Take away the "
    "`<command_interface>` of a joint that mimics another one, or write `mimic='false'` at it. A sensor says by "
    "`<param name='frame_id'>` which link its values are for.",
    references="ros2_control, `hardware_interface`; ros2_controllers.",
)
NO_DIFFERENTIAL_DRIVE = Rule(
    name="no-differential-drive",
    severity=Severity.INFO,
    finds="Joints that turn without end and take velocities as wheels do, but are no differential drive, with the "
    "reason.",
    matters="Each gets its velocity as it is commanded; there is no controller that takes one for the robot.",
    example="Wheels whose axles do not point to the left, or that a steering joint turns.",
    better="Nothing needs doing for other kinds of drives: write their controller to config/controllers.yaml. An axle "
    "of a differential drive has `<axis xyz='0 1 0'/>` in the frame of the base, so that wheels turn forward.",
    references="ros2_controllers, `diff_drive_controller`.",
)
FOREIGN_HARDWARE = Rule(
    name="foreign-hardware",
    severity=Severity.WARNING,
    finds="A `<ros2_control>` whose hardware is not a plugin of the release of Gazebo that the package is for.",
    matters="Gazebo does not load it, so nothing moves its joints there. The package starts no controllers for it in "
    "Gazebo; they are written, and run with the hardware.",
    example="`<hardware><plugin>mock_components/GenericSystem</plugin></hardware>`",
    better="For Gazebo, write `gz_ros2_control/GazeboSimSystem`, or with Fortress `ign_ros2_control/IgnitionSystem`.",
    references="gz_ros2_control.",
)
REPLACED_CONTROLLERS_FILE = Rule(
    name="replaced-controllers-file",
    severity=Severity.WARNING,
    finds="A plugin of gz_ros2_control that names a file with the parameters of controllers. The package has such a "
    "file of its own, and the plugin gets that.",
    matters="What was set in the other file is not set in the package.",
    example="`<parameters>/home/me/arm/config/controllers.yaml</parameters>`",
    better="Copy what you need of the other file into config/controllers.yaml of the package.",
)
NO_JOINT_STATES = Rule(
    name="no-joint-states",
    severity=Severity.WARNING,
    finds="A robot with joints that move, in a package whose Gazebo publishes no positions of joints: the model has "
    "neither a `<ros2_control>` for Gazebo nor the system that publishes them.",
    matters="robot_state_publisher waits for them; until then, the links that move have no place in RViz and tf.",
    example="A URDF without a word about simulators.",
    better="Add the system with `--passes add-plugin{system=joint-state-publisher}`, or turn transmissions of ROS 1 "
    "into a `<ros2_control>` with `--passes ros2-control-from-transmissions`.",
)
FRAME_NOT_IN_TF = Rule(
    name="frame-not-in-tf",
    severity=Severity.WARNING,
    finds="A sensor on a joint, in a package of ROS 2, that does not say which frame its messages are in. Gazebo takes "
    "the names of model, joint and sensor for one. Sensors on links get a frame from the package.",
    matters="tf has no such frame, so RViz and navigation drop the messages: they know no place for them.",
    example="`<sensor name='wrist' type='force_torque'>` without a frame publishes in `arm/wrist_joint/wrist`.",
    better="Write the link that it measures in: `<gz_frame_id>hand</gz_frame_id>`, or with Fortress "
    "`<ignition_frame_id>`, and from Ionic on `<frame_id>`.",
    references="gz-sensors, `Sensor.cc`; ros_gz_bridge.",
)
FRAME_ELSEWHERE = Rule(
    name="frame-elsewhere",
    severity=Severity.WARNING,
    finds="A sensor with a pose of its own, in a package of ROS 2, that names its link as the frame of its messages.",
    matters="ROS takes what it measures for measured at the origin of the link: a scan is shifted and turned.",
    example="`<pose>0.3 0 0.1 0 0 0</pose><gz_frame_id>base_link</gz_frame_id>` on `base_link`.",
    better="Leave the frame out: `package --kind ros2` and `add-sensor` make a link where the sensor is, and for "
    "cameras one that looks along z. Or put the sensor on a link that is there, without a pose.",
    references="gz-sensors, `Sensor.cc`; REP 103.",
)
PACKAGE_NAME = Rule(
    name="package-name",
    severity=Severity.ERROR,
    finds="A package of ROS whose name is not one: it has lower case letters, digits and single underscores, begins "
    "with a letter and has at least two characters.",
    matters="catkin and colcon refuse other names, or warn about them, and nothing finds the package by another name.",
    example="`twinform package arm.urdf -o My-Arm --kind ros2`",
    better="Choose another folder, or `--name my_arm`.",
    references="REP 144.",
)
