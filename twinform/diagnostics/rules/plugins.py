"""Rules about plugins and sensors of Gazebo, which the pass `check-plugins` reports."""

from twinform.diagnostics.fix import Safety
from twinform.diagnostics.rule import Rule, Severity

_SOURCES = "gz-sim, src/systems; docs/reference/plugins.md has what each release reads."

UNKNOWN_PLUGIN_PARAMETER = Rule(
    name="unknown-plugin-parameter",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.UNSAFE,
    finds="A parameter that the plugin does not read, or not in the chosen release.",
    matters="It is ignored silently, and the plugin goes on with its default.",
    example="`<odom_publisher_frequency>30</odom_publisher_frequency>` for DiffDrive, as the official ROS 2 migration "
    "tutorial has it: the odometry comes at 50 Hz.",
    better="Use the name that the source reads: `odom_publish_frequency`.",
    references=_SOURCES,
)
PLUGIN_PARAMETER_VALUE = Rule(
    name="plugin-parameter-value",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A parameter of a plugin with a value that is not of its type, or not among those that the plugin knows.",
    matters="The plugin takes its default or zero, with at most a line in the console.",
    example="`<wheel_radius>10 cm</wheel_radius>`, `<dimensions>4</dimensions>`",
    better="Write a value of the type that is read.",
    references=_SOURCES,
)
PLUGIN_PARAMETER_COUNT = Rule(
    name="plugin-parameter-count",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A parameter without which a plugin does not work and that is not there, or one that stands twice although "
    "only the first is read.",
    matters="Without it the plugin gives up when the simulation starts, and reports it only in the console.",
    example="A joint position controller without `<joint_name>`; DiffDrive with two `<wheel_radius>`.",
    better="Write it once.",
    references=_SOURCES,
)
PLUGIN_REFERENCE = Rule(
    name="plugin-reference",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.UNSAFE,
    finds="A plugin that names a joint or link which its model does not have.",
    matters="The plugin gives up, or waits for ever, when the simulation starts.",
    example="`<left_joint>left_wheel</left_joint>` where that is the link and the joint is `left_wheel_joint`.",
    better="Name a joint or link of the model that the plugin stands in.",
    references=_SOURCES,
)
WRONG_PLUGIN_CLASS = Rule(
    name="wrong-plugin-class",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.UNSAFE,
    finds="A plugin whose `name` is no class of its `filename`, or whose `filename` is not the one of its class.",
    matters="In gz-sim the name chooses the class: with a free name, as Gazebo Classic has it, nothing is loaded.",
    example="`<plugin filename='gz-sim-imu-system' name='imu'/>`",
    better="`<plugin filename='gz-sim-imu-system' name='gz::sim::systems::Imu'/>`",
    references="gz-sim, tutorials/migration_sdf.md",
)
IGNITION_PLUGIN_NAME = Rule(
    name="ignition-plugin-name",
    severity=Severity.INFO,
    fix=Safety.UNSAFE,
    finds="A plugin with a name from before Ignition became Gazebo, for a release after Fortress.",
    matters="gz-sim still loads it, with a warning, and may stop to.",
    example="`filename='ignition-gazebo-imu-system' name='ignition::gazebo::systems::Imu'`",
    better="`filename='gz-sim-imu-system' name='gz::sim::systems::Imu'`",
    references="gz-sim, src/SystemLoader.cc",
)
WRONG_PLUGIN_SCOPE = Rule(
    name="wrong-plugin-scope",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A plugin in an element that it does not work in: a system of the world in a model, one of a model in a "
    "sensor.",
    matters="It is not loaded, or looks for things in a place that has none and gives up. Some systems of the world "
    "work from a model too, and then there are two of them as soon as another model brings one.",
    example="`gz-sim-diff-drive-system` in a `<world>`; any system in a `<link>`.",
    better="Move it to the element that the message names.",
    references=_SOURCES,
)
PLUGIN_NOT_IN_RELEASE = Rule(
    name="plugin-not-in-release",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.UNSAFE,
    finds="A plugin that the chosen release of Gazebo does not have: of another release, of Gazebo Classic, or with a "
    "file name that is nearly right.",
    matters="Nothing is loaded. A library of Gazebo Classic that is found all the same can bring the simulator down.",
    example="`gz-sim-drive-to-pose-controller-system` before Ionic; `libgazebo_ros_diff_drive.so` in any.",
    better="Choose a system of that release; the pass `migrate-gazebo-classic` does it for those of Gazebo Classic.",
    references=_SOURCES,
)
UNSUPPORTED_SENSOR = Rule(
    name="unsupported-sensor",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A sensor of a type that the chosen release does not simulate.",
    matters="It is in the model and never publishes anything.",
    example="`<sensor type='ray'>`, which is a lidar on the CPU: gz-sim has only `gpu_lidar` so far; `multicamera`.",
    better="Use a type that is simulated.",
    references="gz-sim, src/SdfEntityCreator.cc; gz-sensors",
)
MISSING_WORLD_SYSTEM = Rule(
    name="missing-world-system",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.UNSAFE,
    finds="A sensor in a world that lacks the system, or the `<spherical_coordinates>`, which such sensors need.",
    matters="The sensor never publishes anything, without an error message.",
    example="An `imu` in a world without `gz-sim-imu-system`.",
    better="Add the system to the world; `add-sensor` does it for the sensors that it adds.",
    references="gz-sim, src/systems/sensors, src/systems/imu and others",
)
WORLD_SYSTEM_NEEDED = Rule(
    name="world-system-needed",
    severity=Severity.INFO,
    finds="A model whose sensors need systems in whatever world it is put into.",
    matters="A model file cannot bring them: one world has one of each, however many models need it.",
    example="A robot with a camera needs `gz-sim-sensors-system`.",
    better="Add the plugin to the world; `twinform convert --world FILE` writes a world that has all that is needed.",
    references="gz-sim, src/systems/sensors and others",
)
DEFAULT_SYSTEMS_OFF = Rule(
    name="default-systems-off",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A world that has plugins but not those which gz-sim adds to a world without any.",
    matters="One explicit plugin switches off all default systems: without physics nothing moves, without the scene "
    "broadcaster the GUI shows nothing, without user commands nothing can be spawned or moved.",
    example="A world with `gz-sim-imu-system` as its only plugin.",
    better="Add `gz-sim-physics-system`, `gz-sim-user-commands-system` and `gz-sim-scene-broadcaster-system`.",
    references="gz-sim, tutorials/server_config.md",
)
NOTHING_TO_ADD_TO = Rule(
    name="nothing-to-add-to",
    severity=Severity.ERROR,
    finds="A plugin or sensor that is to be added to a model, world, link, joint, sensor or visual which the document "
    "does not have, or of which it has several.",
    matters="Added somewhere else it would do something else.",
    example="`add-sensor{type=imu link=body}` for a robot whose link is called `base_link`; a system of the world for "
    "a file without a world.",
    better="Name the one that is meant: `model=`, `world=`, `link=`, `joint=`, `on=`.",
    references="docs/reference/passes.md",
)
WHEELS_NOT_MEASURED = Rule(
    name="wheels-not-measured",
    severity=Severity.ERROR,
    finds="A drive system whose wheel radius, separation or base is neither given nor to be read off the model.",
    matters="The system would take its own default, and the robot would drive and turn by the wrong distances.",
    example="Wheels whose only shapes are meshes.",
    better="Give the option, such as `wheel-radius=0.1`, or give the wheels a cylinder to collide with.",
    references="gz-sim, src/systems/diff_drive",
)
MEASURED_WHEELS = Rule(
    name="measured-wheels",
    severity=Severity.INFO,
    finds="Measures of wheels that were read off the model: joints at zero, the middle of the wheels' round shapes.",
    matters="The odometry is as good as these numbers are.",
    example="A differential drive from two joints with cylinders: separation 0.4 m, radius 0.1 m.",
    better="Nothing needs doing; give the option where a measured value is better.",
    references="gz-sim, src/systems/diff_drive",
)
ADDED_WORLD_SYSTEM = Rule(
    name="added-world-system",
    severity=Severity.INFO,
    finds="A world that was given systems: those that its sensors need, or the default ones beside another.",
    matters="Without its system a sensor never publishes anything, and one explicit plugin switches the default "
    "ones off.",
    example="`add-sensor{type=imu link=base}` in a world without `gz-sim-imu-system`.",
    better="Nothing needs doing.",
    references="gz-sim, src/systems/imu and others",
)
UNBRIDGED_TOPIC = Rule(
    name="unbridged-topic",
    severity=Severity.INFO,
    finds="A topic of Gazebo that the configuration of the bridge leaves out: ROS has no such message; or, as a "
    "warning, the name depends on a world that is not known, or Gazebo itself has no such topic. gz-transport refuses "
    "names with blanks, `@`, `~`, `//` and `:=`. Most systems remove these from a name; some do not, and publish "
    "nothing. A sensor on a fixed joint of URDF is left out with the joint.",
    matters="ROS does not see it.",
    example="An `air_speed` sensor; a joint state publisher without `<topic>` in a model file; the transforms of a "
    "differential drive in `<robot name='my robot'>`.",
    better="Give the sensor or plugin a topic of its own, say which world it is (`bridge-config{world=NAME ...}`), or "
    "choose names of letters, digits and underscores.",
    references="ros_gz_bridge, README.md; gz-transport, `TopicUtils.cc`",
)
