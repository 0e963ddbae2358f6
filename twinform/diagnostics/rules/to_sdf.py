"""Rules of conversions from URDF to SDF: what becomes of parts that SDF has no syntax for."""

from twinform.diagnostics.rule import Rule, Severity

URDF_ONLY = Rule(
    name="urdf-only",
    severity=Severity.INFO,
    finds="A part of a URDF file that SDF has no equivalent of: transmissions, ros2_control, safety limits, "
    "calibration, elements of other tools.",
    matters="Gazebo does not read it; ROS does, and so does a conversion back to URDF.",
    example="`<transmission>`, `<safety_controller>`, `<calibration>`.",
    better="Nothing needs doing: it is kept in a carrier, which every other reader skips. `--no-carriers` leaves it "
    "out.",
)
SCOPED_ELEMENT = Rule(
    name="scoped-element",
    severity=Severity.INFO,
    finds="An element that SDF does not know, with `::` in its name, on the way into SDF 1.8 or newer.",
    matters="libsdformat looks at the name of every element, and refuses the whole file for such a one.",
    example="`<api name='ati::Sensor'/>` in a sensor of a `<gazebo>` element.",
    better="Nothing needs doing: it is kept in a carrier, which every other reader skips. `--no-carriers` leaves it "
    "out.",
)
MATERIAL_NAME = Rule(
    name="material-name",
    severity=Severity.INFO,
    finds="The name of a URDF material, or a shared material that no visual uses.",
    matters="Materials of SDF have colors but no names.",
    example="`<material name='blue'>`",
    better="Nothing needs doing: the colors are written into every visual and the name is kept in a carrier.",
)
WORLD_LINK = Rule(
    name="world-link",
    severity=Severity.WARNING,
    finds="A root link called `world` that has a body: mass, shapes or sensors.",
    matters="The link becomes SDF's own world, which has none of these; libsdformat drops them silently.",
    example="`<link name='world'><visual>...</visual></link>`",
    better="Put the shapes on a link of their own that is fixed to `world`.",
)
MASSLESS_LINK = Rule(
    name="massless-link",
    severity=Severity.WARNING,
    finds="A link without mass that moves by itself: it is neither fixed to another nor carries anything that has "
    "mass.",
    matters="Simulators divide by its mass. libsdformat drops it with everything below it.",
    example="A wheel without `<inertial>` on a continuous joint.",
    better="Give it an inertia; `fill-inertia` can do that from its shapes.",
    references="sdformat issue 199",
)
TOKEN_MASS = Rule(
    name="tiny-mass",
    severity=Severity.INFO,
    finds="A link of URDF without mass that stays a link in SDF, such as a root, or one that moves.",
    matters="Zero is no mass for the engines of Gazebo: DART aborts where such a link moves, and Bullet holds it where "
    "it is, with the robot on it. 1e-12 kg and 1e-14 kg m^2 make no difference to the robot.",
    example="`base_footprint`, the root of many mobile robots.",
    better="Nothing needs doing for a link that carries others; one at the end of a chain should have the mass that it "
    "has in reality.",
)
FRAME_LINK = Rule(
    name="frame-link",
    severity=Severity.INFO,
    finds="A link without mass on a fixed joint.",
    matters="SDF has `<frame>` for this; as a link, a simulator would give it a mass of its own.",
    example="A camera's optical frame, a tool center point.",
    better="Nothing needs doing: link and joint become frames of the same names, the shapes and sensors move to the "
    "parent at the same place.",
)
RENAMED = Rule(
    name="renamed",
    severity=Severity.WARNING,
    finds="A thing whose name had to change, because all names of an SDF model share one scope, SDF keeps the name for "
    "itself, or blanks are around it, which libsdformat drops.",
    matters="Plugins and programs that use the old name must use the new one.",
    example="A joint and a link that are both called `arm`: the joint becomes `arm_joint`.",
    better="Choose different names in the URDF.",
)
SHAPE_NAME = Rule(
    name="shape-name",
    severity=Severity.INFO,
    finds="A visual or collision without a name, or with the name of another one of its link.",
    matters="In SDF they must have one each.",
    example="`<visual>` in link `base` becomes `base_visual`, the second one `base_visual_1`.",
    better="Name them in the URDF if plugins or sensors refer to them.",
)
NO_JOINT = Rule(
    name="no-joint",
    severity=Severity.INFO,
    finds="A `floating` joint.",
    matters="In SDF two links that may move freely simply have no joint between them.",
    example="`<joint name='free' type='floating'>`",
    better="Nothing needs doing: the child keeps its place, the joint's name is kept in a carrier.",
)
JOINT_TYPE_UNSUPPORTED = Rule(
    name="joint-type-unsupported",
    severity=Severity.ERROR,
    finds="A joint that the target does not have and that cannot be built from several others.",
    matters="Left out or replaced, the robot would move in another way.",
    example="`piston` of SDF before 1.5; a `screw` with a `<thread_pitch>` of 0 rad/m.",
    better="Write the joint as a chain of revolute and prismatic ones.",
)
JOINT_CHAIN = Rule(
    name="joint-chain",
    severity=Severity.INFO,
    finds="A joint that the target describes by several joints with links between them: a `planar` one.",
    matters="It moves the same way, but has three coordinates by three names. The links between have no mass, which "
    "engines with one body for each link do not like.",
    example="`<joint name='base' type='planar'>` becomes `base_x`, `base_y` and `base`.",
    better="Nothing needs doing: a conversion back to URDF makes it one joint again.",
)
GAZEBO_TAG_WITHOUT_TARGET = Rule(
    name="gazebo-tag-without-target",
    severity=Severity.WARNING,
    finds="A tag in a `<gazebo>` element that has no effect for what the element refers to.",
    matters="libsdformat ignores it silently.",
    example="`<mu1>` in a `<gazebo>` for the whole model or for a joint; `<static>` for a link.",
    better="Refer to the link or joint that is meant.",
)
GAZEBO_CONFLICT = Rule(
    name="gazebo-conflict",
    severity=Severity.WARNING,
    finds="A `<gazebo>` element that sets again what the model, link or joint sets already.",
    matters="libsdformat writes both, and then reads one of them.",
    example="Two `<gazebo reference='arm'>` with a different `<gravity>`; an `<inertial>` for a link that has one.",
    better="Keep one of the two.",
)
OLDER_VERSION = Rule(
    name="older-version",
    severity=Severity.WARNING,
    finds="Something that the SDF version asked for does not have.",
    matters="Readers of that version would not see it.",
    example="`mimic` before 1.11, `capsule` before 1.8.",
    better="Ask for a newer `--sdf-version` if the simulator reads it.",
)
LUMPED_NAME = Rule(
    name="lumped-name",
    severity=Severity.INFO,
    finds="The name of a collision as libsdformat calls it when it lumps the robot, in a contact sensor or plugin.",
    matters="We lump nothing unless asked, and the collision keeps its own name: the sensor names it by that.",
    example="`<collision>base_link_fixed_joint_lump__pad_collision_1</collision>` becomes `pad_collision`.",
    better="Nothing needs doing.",
    references="sdformat, parser_urdf.cc, ReduceCollisionToParent.",
)
LUMPED_FLAG = Rule(
    name="lumped-flag",
    severity=Severity.WARNING,
    finds="A `<gazebo>` flag, such as `turnGravityOff`, of one of several links that are fixed to each other.",
    matters="Gazebo makes one body of links that fixed joints hold together when it reads URDF, and such a flag is "
    "about all of it. In SDF the links stay, and the flag is about the one that it is written for.",
    example="`<turnGravityOff>` for a sensor on the robot's base lets the whole base float in Gazebo, and in SDF the "
    "sensor alone.",
    better="Set the flag for all links that are fixed to each other, or for none of them.",
    references="sdformat, parser_urdf.cc, ReduceSDFExtensionToParent and InsertSDFExtensionLink.",
)
UNREACHED_SHAPE = Rule(
    name="unreached-shape",
    severity=Severity.WARNING,
    finds="A visual or collision that Gazebo applies other `<gazebo>` tags to than those of its link.",
    matters="When Gazebo reads URDF, a shape whose name does not begin with that of its link gets no `mu1`, `kp`, "
    "`material`, ... In SDF it has them, as the author wrote it, so that the two differ in Gazebo.",
    example='`<collision name="ball">` of link `caster`, for which `<gazebo reference="caster">` sets `mu1`.',
    better="Begin the names of shapes with that of their link, or leave them out: then Gazebo does as the tag says.",
    references="sdformat, parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision.",
)
SHARED_INERTIA = Rule(
    name="shared-inertia",
    severity=Severity.WARNING,
    finds="A link with an inertia that no body has, in a body of fixed links that is possible as a whole.",
    matters="Gazebo puts fixed links together before it looks at their inertia when it reads URDF; it refuses an SDF "
    "file with such a link. The link gets the nearest inertia that a body can have, and another link of the same body "
    "gives it what is missing, so that the body moves as before.",
    example="A root of 1e-6 kg in which all nine elements of the inertia are 1e-6.",
    better="Correct the inertia, or let `--passes balance-inertia` do it.",
)
UNSEEN_COLLISION = Rule(
    name="unseen-collision",
    severity=Severity.WARNING,
    finds="A contact sensor that names a collision of another link, which libsdformat would have lumped into its own.",
    matters="A contact sensor of Gazebo reports only collisions of its own link, so this one reports none.",
    example="A sensor on `base_link` with `base_link_fixed_joint_lump__pad_collision_1`, where `pad` has a mass.",
    better="Lump the robot as libsdformat does, `--passes 'lump-fixed-joints{compat=libsdformat}'`, or put the sensor "
    "on the link that has the collision.",
)
