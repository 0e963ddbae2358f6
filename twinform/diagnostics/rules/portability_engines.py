"""Rules of portability for physics engines: what is good SDF, and frozen, left out or fatal in some engine."""

from twinform.diagnostics.rule import Rule, Severity

RARE_JOINT_TYPE = Rule(
    name="rare-joint-type",
    severity=Severity.INFO,
    finds="A joint of a type that not every engine of Gazebo has: all but `revolute` and `fixed`.",
    matters="DART holds `continuous`, `revolute2` and `gearbox` joints fast, Bullet Featherstone all but revolute, "
    "prismatic and ball joints, and Bullet in Fortress leaves out what is not revolute or fixed.",
    example="`<joint name='steering' type='revolute2'>` under `--for gazebo`.",
    better="Write `revolute` without limits for `continuous`, and two revolute joints with a light link between them "
    "for `revolute2`.",
)
EMPTY_ATTRIBUTE = Rule(
    name="empty-attribute",
    severity=Severity.INFO,
    finds="An attribute of another namespace without a value, in an element of SDF.",
    matters="libsdformat takes every such attribute for one that has to have a value, and refuses the file.",
    example="`<link name='base' mine:note=''>`",
    better="Write a value, or leave the attribute out.",
)
FLAT_COLLISION = Rule(
    name="flat-collision",
    severity=Severity.INFO,
    finds="A collision with a size that is zero, negative or no number.",
    matters="Gazebo ends where DART is given a sphere, box, cylinder or capsule without an extent.",
    example="`<collision name='c'><geometry><sphere><radius>0</radius></sphere></geometry></collision>`.",
    better="Leave the collision out, or give it a size; `drop-flat-shapes` leaves all of them out.",
)
UNCERTAIN_INERTIA = Rule(
    name="uncertain-inertia",
    severity=Severity.INFO,
    finds="An inertia with products of which eight digits do not say whether a body can have it.",
    matters="Readers find its axes first, and round: libsdformat takes one such inertia and refuses the next.",
    example="The inertia of a thin rod that is not parallel to an axis of its frame.",
    better="Give the body some extent along every axis; `balance-inertia` does so.",
)
WEIGHTLESS_MOVER = Rule(
    name="weightless-mover",
    severity=Severity.INFO,
    finds="A body, which is what fixed joints hold together, that moves and has no mass or no inertia.",
    matters="An engine divides by both: DART ends in an assertion in the first step where nothing hangs on the body.",
    example="A link with `<mass>0</mass>` at the end of a revolute joint.",
    better="Give it a mass and an inertia; `split-massless` and `balance-inertia` do so.",
)
NESTED_IN_ENGINE = Rule(
    name="nested-in-engine",
    severity=Severity.INFO,
    finds="A model in a model.",
    matters="The Bullet of Gazebo Fortress has no nested models: their links, and the joints to them, are left out.",
    example="`<model name='arm'><model name='hand'>...</model></model>` under `--for gazebo@fortress`.",
    better="Use DART, or bring the parts of the nested model up into the other with `flatten-models`.",
)
THREADLESS_SCREW = Rule(
    name="threadless-screw",
    severity=Severity.INFO,
    finds="A screw joint with a thread pitch of zero.",
    matters="Gazebo ends where it builds such a joint for DART.",
    example="`<thread_pitch>0</thread_pitch>`.",
    better="Give the screw a pitch, or make the joint revolute.",
)
LATE_SENSOR = Rule(
    name="late-sensor",
    severity=Severity.INFO,
    finds="A sensor of a type that libsdformat 12 does not know.",
    matters="Gazebo Fortress refuses the whole file.",
    example="`<sensor name='pitot' type='air_speed'>` under `--for gazebo@fortress`.",
    better="Leave the sensor out for Fortress: `drop{sensors=pitot}`.",
)
NARROW_VIEW = Rule(
    name="narrow-view",
    severity=Severity.INFO,
    finds="A camera whose horizontal field of view is below 0.1 rad.",
    matters="libsdformat 12 refuses the whole file; newer ones take views from 0.001 rad.",
    example="`<horizontal_fov>0.088</horizontal_fov>` under `--for gazebo@fortress`.",
    better="Write 0.1 for Fortress, or leave the sensor out: `drop{sensors=flow}`.",
)
MODEL_JOINT_END = Rule(
    name="model-joint-end",
    severity=Severity.INFO,
    finds="A joint with `__model__` as its parent or child: the frame of a model in place of a link.",
    matters="libsdformat 12 does not find it and refuses the file.",
    example="`<parent>__model__</parent>` under `--for gazebo@fortress`.",
    better="Name the link that is meant.",
)
UNUSABLE_AXIS = Rule(
    name="unusable-axis",
    severity=Severity.INFO,
    finds="An axis of SDF with a lower limit above the upper one, a limit of NaN, or negative damping or friction.",
    matters="Gazebo ends with such an axis in DART.",
    example="`<limit><lower>1</lower><upper>-1</upper></limit>` under `--for gazebo`.",
    better="Write the limits that are meant; `order-limits` swaps them, and makes damping and friction zero.",
)
BARE_SCRIPT = Rule(
    name="bare-script",
    severity=Severity.INFO,
    finds="A `<script>` of a material without a `<name>` or without a `<uri>`.",
    matters="libsdformat refuses the whole file, although newer Gazebo reads no scripts at all.",
    example="`<material><script>Gazebo/Grey</script></material>` under `--for gazebo`.",
    better="Write colors; `drop-bare-scripts` leaves such a script out.",
)
DROPPED_BARE_SCRIPT = Rule(
    name="dropped-bare-script",
    severity=Severity.WARNING,
    finds="A `<script>` of a material that `drop-bare-scripts` left out, as it has no name or no URI.",
    matters="libsdformat refuses files with such a script; what has no other color is grey in Gazebo.",
    example="`<script><name>Gazebo/Grey</name></script>`.",
    better="Write the colors, or the URI too: `file://media/materials/scripts/gazebo.material`.",
)
DROPPED_FLAT_SHAPE = Rule(
    name="dropped-flat-shape",
    severity=Severity.WARNING,
    finds="A visual or collision that `drop-flat-shapes` left out, as it has no extent.",
    matters="Nothing can be seen of it or touch it, and some readers refuse it.",
    example="`<sphere radius='0'/>`.",
    better="Give the shape a size if it was meant to be there.",
)
ORDERED_LIMITS = Rule(
    name="ordered-limits",
    severity=Severity.WARNING,
    finds="Limits of a joint that `order-limits` put the other way round, and damping or friction that it set to zero.",
    matters="What is written has no meaning: libsdformat turns such limits of URDF around, DART ends with them.",
    example="`<limit lower='1' upper='-1' effort='10' velocity='1'/>`.",
    better="Write the limits that were meant.",
)
