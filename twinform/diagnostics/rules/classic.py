"""Rules about the way from Gazebo Classic to gz-sim. The pass `migrate-gazebo-classic` reports them."""

from twinform.diagnostics.rule import Rule, Severity

_REFERENCES = "gz-sim, `tutorials/migration_plugins.md` and `tutorials/migration_sdf.md`"

MIGRATED_PLUGIN = Rule(
    name="migrated-plugin",
    severity=Severity.INFO,
    finds="A plugin of Gazebo Classic that became a system of gz-sim, or a part of a sensor or joint.",
    matters="The class, the names of parameters and some units are others; topics have the names that they had in ROS, "
    "and reach ROS through ros_gz_bridge only.",
    example="`libgazebo_ros_diff_drive.so` becomes `gz-sim-diff-drive-system`.",
    better="Nothing needs doing; try the robot in the simulator.",
    references=_REFERENCES,
)
PLUGIN_WITHOUT_COUNTERPART = Rule(
    name="plugin-without-counterpart",
    severity=Severity.WARNING,
    finds="A plugin of Gazebo Classic that has no counterpart in gz-sim, with the reason.",
    matters="gz-sim cannot load it. It is left out, or stays with the option `keep`.",
    example="`libgazebo_ros_vacuum_gripper.so`",
    better="Port it to a system of gz-sim, or follow the reason.",
    references=_REFERENCES,
)
PARAMETER_WITHOUT_COUNTERPART = Rule(
    name="parameter-without-counterpart",
    severity=Severity.WARNING,
    finds="A parameter of a migrated plugin that gz-sim has no counterpart for, with the reason.",
    matters="What it asked for does not happen any more, or happens in another way.",
    example="`<covariance_x>` of `libgazebo_ros_planar_move.so`",
    better="Follow the reason, or leave the parameter out of the source.",
    references=_REFERENCES,
)
UNKNOWN_PLUGIN = Rule(
    name="unknown-plugin",
    severity=Severity.WARNING,
    finds="A plugin that is neither of Gazebo Classic nor of gz-sim, nor of a package that is known here.",
    matters="It may be for either, and is kept unchanged; one that was built for Gazebo Classic does not load in "
    "gz-sim.",
    example="`<plugin name='mine' filename='libmy_plugin.so'/>`",
    better="Port it if it is for Gazebo Classic.",
)
MIGRATED_SENSOR = Rule(
    name="migrated-sensor",
    severity=Severity.INFO,
    finds="A sensor whose type has another name in gz-sim.",
    matters="gz-sim simulates lidars on the graphics card, and knows satellite receivers as `navsat`.",
    example="`<sensor type='ray'>` becomes `<sensor type='gpu_lidar'>`.",
    better="Nothing needs doing.",
    references=_REFERENCES,
)
SENSOR_WITHOUT_COUNTERPART = Rule(
    name="sensor-without-counterpart",
    severity=Severity.WARNING,
    finds="A sensor of a type that the release of gz-sim does not simulate.",
    matters="It is kept in the file, but measures nothing.",
    example="`<sensor type='sonar'>`",
    better="Use a sensor that comes near; the message names one.",
    references=_REFERENCES,
)
UNREAD_WORLD_PART = Rule(
    name="unread-world-part",
    severity=Severity.WARNING,
    finds="A part of a world that Gazebo Classic reads and gz-sim does not.",
    matters="It is kept in the file, but has no effect.",
    example="`<physics><ode>`, `<scene><fog>`, `<population>`",
    better="Leave it out, or follow the reason.",
    references=_REFERENCES,
)
SHIPPED_MODEL = Rule(
    name="shipped-model",
    severity=Severity.INFO,
    finds="An include of a model that came with Gazebo Classic and does not come with gz-sim.",
    matters="Without its file the world does not load; now it comes from Fuel.",
    example="`<uri>model://sun</uri>`",
    better="Nothing needs doing where the simulator has a network; else write light and ground into the world.",
)
IGNITION_NAME = Rule(
    name="ignition-name",
    severity=Severity.INFO,
    finds="A name from when Gazebo was called Ignition.",
    matters="gz-sim still reads most of these names with a warning, and will not for ever.",
    example="`libignition-gazebo-imu-system.so`, `ignition::gazebo::systems::Imu`",
    better="Nothing needs doing; the current names are written.",
)
INCOMPLETE_MIGRATION = Rule(
    name="incomplete-migration",
    severity=Severity.WARNING,
    finds="Something that was migrated and needs a value which the source did not have.",
    matters="The plugin of Gazebo Classic took the value from elsewhere, or had no need of it; the system takes a "
    "default that hardly fits.",
    example="`libLinearBatteryPlugin.so` knows no `voltage`, which `LinearBatteryPlugin` of gz-sim needs.",
    better="Write the value that the message names.",
    references=_REFERENCES,
)
