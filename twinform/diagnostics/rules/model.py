"""Rules about names, references and the tree, which a schema cannot see whole. `twinform.ir.verify` reports them."""

from twinform.diagnostics.rule import Rule, Severity

DUPLICATE_NAME = Rule(
    name="duplicate-name",
    severity=Severity.ERROR,
    finds="Two things of one kind in one scope with one name.",
    matters="A reference to the name means either of them; readers refuse the file.",
    example="Two `<link name='arm'>` in one robot.",
    better="Rename one of them.",
)
SHARED_NAME = Rule(
    name="shared-name",
    severity=Severity.ERROR,
    finds="Two things of different kinds in one SDF model, such as a link and a joint, with one name. For a visual and "
    "a collision of one link this is an info: only `gz sdf --check` minds.",
    matters="From SDF 1.7 on every one of them is a frame, and a reference to the name means either.",
    example="`<link name='arm'/>` and `<joint name='arm' ...>` in an SDF model. In URDF it is legal.",
    better="Rename one of them; from URDF, the compiler renames the joint.",
    references="SDF 1.7, proposal on frame semantics",
)
RESERVED_NAME = Rule(
    name="reserved-name",
    severity=Severity.ERROR,
    finds="A name that SDF keeps for itself: `world`, one that begins and ends with two underscores, or from 1.8 on "
    "one with `::` in it. Before that, one with nothing on one side of the `::`.",
    matters="References to it mean the world, the model, or something inside of a model, never the thing that has the "
    "name.",
    example="`<link name='world'/>` in an SDF model, `<visual name='arm::shell'>`.",
    better="Choose another name.",
    references="SDF 1.7, proposal on frame semantics",
)
EMPTY_NAME = Rule(
    name="empty-name",
    severity=Severity.ERROR,
    finds="A link, joint, model or frame, or in SDF a world, visual, collision, sensor or light, whose name is empty "
    "or made of blanks. For a robot in URDF it is a warning.",
    matters="Nothing can refer to it. libsdformat drops the blanks around a name, and refuses the file where nothing "
    "is left.",
    example="`<link name=''/>`, `<collision name=' '>`",
    better="Give it a name.",
)
UNPRINTABLE_NAME = Rule(
    name="unprintable-name",
    severity=Severity.ERROR,
    finds="A name with a character that cannot be seen: a line break, a tab, a command to a terminal, a character that "
    "turns the direction of writing, a space of another width.",
    matters="No topic or frame of ROS can have the name, logs and scripts that print it break or lie, and two names "
    "that look the same are not.",
    example="`<link name='arm&#10;base'/>`",
    better="Write the name in letters, digits and underscores.",
)
DANGLING_LINK = Rule(
    name="dangling-link",
    severity=Severity.ERROR,
    finds="A joint whose parent or child does not exist.",
    matters="The robot cannot be put together; readers refuse the file.",
    example="`<parent link='bse_link'/>` where the link is called `base_link`.",
    better="Correct the name.",
)
SELF_JOINT = Rule(
    name="self-joint",
    severity=Severity.ERROR,
    unsound=True,
    finds="A joint that connects a link to itself, directly or by way of a frame on it, or is one of its own ends.",
    matters="It constrains nothing and has no place in a tree; readers refuse it.",
    example="`<parent link='a'/><child link='a'/>`",
    better="Name the other link.",
)
WORLD_CHILD = Rule(
    name="world-child",
    severity=Severity.ERROR,
    finds="An SDF joint whose child is the world.",
    matters="The world does not move; it can only be a parent.",
    example="`<child>world</child>`",
    better="Exchange parent and child.",
)
NO_LINKS = Rule(
    name="no-links",
    severity=Severity.ERROR,
    finds="A URDF robot without a link.",
    matters="There is nothing to see, move or simulate; urdfdom refuses it.",
    example="`<robot name='r'/>`",
    better="Write a link.",
)
SEVERAL_ROOTS = Rule(
    name="several-roots",
    severity=Severity.ERROR,
    finds="A URDF robot in which more than one link is no joint's child.",
    matters="URDF describes one tree; urdfdom refuses the file.",
    example="Two links and no joint.",
    better="Connect the pieces by joints, `floating` ones where they move freely, or write one file for each.",
)
KINEMATIC_LOOP = Rule(
    name="kinematic-loop",
    severity=Severity.ERROR,
    unsound=True,
    finds="Joints that go round in a circle: each link is the child of the next one's joint. In SDF it is an info.",
    matters="URDF describes a tree; such a robot has no root to begin with. In SDF it is allowed and may be meant, but "
    "not every physics engine can close it.",
    example="a is b's parent and b is a's.",
    better="Cut the loop; in a `<gazebo>` element a `<joint>` can close it for Gazebo.",
)
TWO_PARENTS = Rule(
    name="two-parents",
    severity=Severity.ERROR,
    unsound=True,
    finds="A link that is the child of more than one joint. In SDF it is an info: that is how a loop is closed.",
    matters="URDF describes a tree: readers keep one of the joints, and not the same one. Of the engines behind SDF, "
    "not every one can close a loop.",
    example="Both rods of a four-bar linkage end in the same coupler link.",
    better="Keep one joint in the tree; in a `<gazebo>` element a `<joint>` can close the loop for Gazebo.",
)
MISSING_LIMIT = Rule(
    name="missing-limit",
    severity=Severity.ERROR,
    finds="A revolute or prismatic joint of URDF without `<limit>`.",
    matters="urdfdom refuses the file; a controller would not know how far the joint may go.",
    example="`<joint name='elbow' type='revolute'>` with parent, child and axis only.",
    better="Write the limits, or make the joint `continuous`.",
)
PARTIAL_LIMIT = Rule(
    name="partial-limit",
    severity=Severity.ERROR,
    finds="A joint of URDF 1.0 or 1.1 whose `<limit>` has no effort or no velocity, after passes have run.",
    matters="urdfdom refuses the file. In a file that is read, the missing attribute itself is reported.",
    example="`--passes 'fill-limits{effort=100}'` for a joint that lacks the velocity as well.",
    better="Fill both.",
)
LOWER_ABOVE_UPPER = Rule(
    name="lower-above-upper",
    severity=Severity.WARNING,
    finds="A joint whose lower limit is above its upper one.",
    matters="No position is allowed; libsdformat exchanges the two, other readers lock the joint or fail.",
    example="`<limit lower='1' upper='-1' .../>`",
    better="Exchange them.",
)
ZERO_AXIS = Rule(
    name="zero-axis",
    severity=Severity.ERROR,
    finds="A joint that moves along or about an axis of length zero.",
    matters="The direction is not defined; simulators divide by its length.",
    example="`<axis xyz='0 0 0'/>`",
    better="Write a direction.",
)
UNKNOWN_LEADER = Rule(
    name="unknown-leader",
    severity=Severity.WARNING,
    finds="A mimic joint whose leader does not exist, has no axis, or is the joint itself.",
    matters="The joint follows nothing: libsdformat refuses the model, other readers leave the joint free.",
    example="`<mimic joint='left_finger'/>` where no joint is called so.",
    better="Correct the name.",
)
UNKNOWN_REFERENCE = Rule(
    name="unknown-reference",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A `<gazebo reference='...'>` that names neither a link nor a joint.",
    matters="libsdformat drops its content silently: the sensor, friction or color is simply not there.",
    example="`<gazebo reference='bse_link'>` where the link is called `base_link`.",
    better="Correct the name.",
    references="sdformat issue 1372",
)
UNKNOWN_MATERIAL = Rule(
    name="unknown-material",
    severity=Severity.WARNING,
    finds="A visual that names a material which is defined nowhere and has no color or texture itself.",
    matters="The visual is drawn in a default color.",
    example="`<material name='blu'/>` where the material is called `blue`.",
    better="Correct the name, or write the color in the visual.",
)
EMPTY_MODEL = Rule(
    name="empty-model",
    severity=Severity.WARNING,
    finds="An SDF model that is not static and has no link, nested model or include.",
    matters="It has no frame that could move; libsdformat refuses it from SDF 1.7 on.",
    example="`<model name='m'/>`",
    better="Write a link, or make the model static.",
)
SEVERAL_AT_TOP = Rule(
    name="several-at-top",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An SDF file with more than one model, light or actor outside of a world.",
    matters="libsdformat reads the first and reports that there are others; Gazebo spawns only that one.",
    example="`<sdf ...><model name='a'>...</model><model name='b'>...</model></sdf>`",
    better="Put them into a world, or into files of their own.",
    references="libsdformat: ELEMENT_INCORRECT_TYPE",
)
