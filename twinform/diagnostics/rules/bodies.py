"""Rules about what is on a link: shapes, materials and sensors."""

from twinform.diagnostics.fix import Safety
from twinform.diagnostics.rule import Rule, Severity

MISSING_SHAPE = Rule(
    name="missing-shape",
    severity=Severity.WARNING,
    finds="A visual or collision whose geometry is not there or has no shape.",
    matters="There is nothing to see or touch. urdfdom drops the rest of the link with it; libsdformat puts an empty "
    "shape there.",
    example="`<collision name='c'><geometry/></collision>`",
    better="Write the shape or delete the visual or collision; in SDF `<empty/>` means that none is meant.",
)
ZERO_SIZE = Rule(
    name="zero-size",
    severity=Severity.INFO,
    finds="A shape with a size, radius, length or scale of zero, or a plane with a normal of length zero.",
    matters="It has no extent in that direction: some physics engines refuse it, others never report a contact.",
    example="`<box size='1 1 0'/>`",
    better="Write the thickness, however small.",
)
BARE_MATERIAL = Rule(
    name="bare-material",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.SAFE,
    finds="A shared `<material>` of URDF with neither a color nor a texture.",
    matters="It defines nothing, and urdfdom refuses the whole file for it.",
    example="`<robot ...><material name='blue'/>`",
    better="Give it a color, or delete it.",
)
UNNAMED_MATERIAL = Rule(
    name="unnamed-material",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    fix=Safety.SAFE,
    finds="A material of URDF without a name.",
    matters="urdfdom refuses the visual and drops the rest of the link with it, or the whole file where the material "
    "is a shared one.",
    example="`<visual>...<material><color rgba='1 0 0 1'/></material></visual>`",
    better="Give it a name; an empty one will do.",
)
CONFLICTING_MATERIAL = Rule(
    name="conflicting-material",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A material of URDF that is defined again with another color or texture.",
    matters="Materials are shared by name: urdfdom and libsdformat show the first definition everywhere. Here each "
    "visual keeps the color that stands in it.",
    example="Two visuals with a `<material name='paint'>` of their own, one red and one blue.",
    better="Give the second one another name.",
)
SENSOR_MISMATCH = Rule(
    name="sensor-mismatch",
    severity=Severity.WARNING,
    finds="A sensor with parameters for another type of sensor.",
    matters="Readers look for the element of the type and take defaults where it is not there.",
    example="`<sensor type='imu'><camera>...`",
    better="Correct the type, or write the element that belongs to it.",
)
MISPLACED_SENSOR = Rule(
    name="misplaced-sensor",
    severity=Severity.WARNING,
    finds="A sensor of force and torque on a link.",
    matters="It measures what a joint transmits; Gazebo ignores it on a link.",
    example="`<link name='tool'><sensor name='ft' type='force_torque'/></link>`",
    better="Move it into the joint.",
)
UNKNOWN_COLLISION = Rule(
    name="unknown-collision",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A contact sensor that names a collision which does not exist.",
    matters="It never reports a contact, and no reader reports why.",
    example="`<contact><collision>foot</collision></contact>` where the collision is called `foot_collision`.",
    better="Correct the name.",
)
UNKNOWN_GRIPPER_LINK = Rule(
    name="unknown-gripper-link",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A gripper whose palm or finger is no link of the model.",
    matters="Gazebo Classic ignores the gripper; nothing is ever grasped.",
    example="`<palm_link>palm</palm_link>` where the link is called `hand_palm`.",
    better="Correct the name.",
)
