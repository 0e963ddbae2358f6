"""Rules of conversions from SDF to URDF: what becomes of parts that URDF has no syntax for."""

from twinform.diagnostics.rule import Rule, Severity

SDF_ONLY = Rule(
    name="sdf-only",
    severity=Severity.INFO,
    finds="A part of an SDF file that has no equivalent in URDF nor in a `<gazebo>` element.",
    matters="ROS does not read it; a conversion back to SDF does.",
    example="`<transparency>` of a visual, `<dissipation>` of a joint limit, `thread_pitch`.",
    better="Nothing needs doing: it is kept in a carrier, which all other readers skip. `--no-carriers` leaves it out.",
)
MODEL_NOT_CHOSEN = Rule(
    name="model-not-chosen",
    severity=Severity.ERROR,
    finds="A file with several models, or none of the name that was asked for; a URDF file holds one robot.",
    matters="Choosing one by its place in the file would be a guess.",
    example="A world with a robot and a table.",
    better="Say which one: `--model NAME`, or `--split` for all of them.",
)
OUTSIDE_MODEL = Rule(
    name="outside-model",
    severity=Severity.INFO,
    finds="A part of the file around the model that becomes the robot: the world, its physics, other models.",
    matters="A URDF file holds one robot and nothing else.",
    example="`<physics>`, `<scene>` and the ground plane of a world.",
    better="Keep the world file, and let it include the robot.",
)
INCLUDE_NOT_EXPANDED = Rule(
    name="include-not-expanded",
    severity=Severity.ERROR,
    finds="An `<include>` inside the model whose file was not read.",
    matters="The links in it would be missing from the robot. SDF before 1.7, where a pose names no frame, cannot be "
    "written without knowing where they are.",
    example="`<include><uri>model://gripper</uri></include>` where no folder of models is known.",
    better="Say where its model is, so that it is put in its place.",
)
NESTED_MODEL = Rule(
    name="nested-model",
    severity=Severity.INFO,
    finds="A model inside the model.",
    matters="A URDF robot has one level: the links, joints and frames move up, called `inner::link`, and the inner "
    "model's own frame becomes a link.",
    example="`<model name='arm'><model name='hand'>...`",
    better="Nothing needs doing: settings of the inner model (`static`, plugins, ...) are kept in a carrier.",
)
FRAME_MADE_LINK = Rule(
    name="frame-made-link",
    severity=Severity.INFO,
    finds="A `<frame>`.",
    matters="URDF has no frames; a link without mass on a fixed joint takes its place.",
    example="`<frame name='tool' attached_to='hand'>`",
    better="Nothing needs doing: a conversion back to SDF makes it a frame again, and so does libsdformat.",
)
AUTOMATIC_INERTIA = Rule(
    name="automatic-inertia",
    severity=Severity.ERROR,
    finds="An inertial that asks the reader to compute it (`auto='true'`), in a link without collisions, or with one "
    "whose shape has no inside that is known: a plane, a heightmap, a mesh that is open or not found.",
    matters="URDF can only write the numbers.",
    example="`<inertial auto='true'/>` beside a `<collision>` that is a `<plane>`.",
    better="Use simple shapes for the collision, or say with `--path DIR` where the meshes are. To look into "
    "meshes needs `pip install 'twinform[meshes]'`.",
)
COMPUTED_INERTIA = Rule(
    name="computed-inertia",
    severity=Severity.INFO,
    finds="An inertial that asks the reader to compute it from the collisions (`auto='true'`).",
    matters="URDF can only write the numbers: they are those of the shapes, filled with their densities.",
    example="`<inertial auto='true'><density>2700</density></inertial>`",
    better="Nothing needs doing: a conversion back makes it automatic again, if its shapes still give the same "
    "numbers.",
)
UNFOLDED_JOINT = Rule(
    name="unfolded-joint",
    severity=Severity.WARNING,
    finds="A `ball`, `universal`, `revolute2` or `screw` joint of an SDF file that becomes URDF.",
    matters="In URDF it becomes a chain of joints with links between. Each weighs 2e-6 kg, where the joint is: "
    "Gazebo's "
    "own reader of URDF drops a link of 1e-6 kg or less, and all below it. The middle joint of the three of a ball "
    "loses a direction at 90 degrees, which the ball does not. Gazebo ignores mimics in URDF, so that a screw slides "
    "and turns there independently.",
    example="`<joint name='neck' type='universal'>` becomes `neck_axis` and `neck`.",
    better="Nothing for ROS, and a conversion back makes it one joint again. For Gazebo, keep the SDF file.",
)
GEARBOX = Rule(
    name="gearbox",
    severity=Severity.WARNING,
    finds="A `gearbox` joint of an SDF file that becomes URDF.",
    matters="It holds no link, it couples the angles of two other joints: one of them mimics the other in URDF. Gazebo "
    "reads the gearbox itself in a `<gazebo>` element. Where the two are not turning joints at the reference body, "
    "about the axes of the gearbox, only Gazebo couples them.",
    example="`<joint name='gears' type='gearbox'>` between `wheel` and `motor`, both of which turn on `frame`.",
    better="Let both ends turn on the `<gearbox_reference_body>`, about `<axis>` and `<axis2>`.",
)
JOINT_END = Rule(
    name="joint-end",
    severity=Severity.INFO,
    finds="A joint whose parent or child is a frame and not a link.",
    matters="Joints of URDF connect links.",
    example="`<child>hand::mount</child>` where `mount` is a frame.",
    better="Nothing needs doing: the joint keeps its place and connects the links that the frames move with.",
)
AXIS_FRAME = Rule(
    name="axis-frame",
    severity=Severity.INFO,
    finds="A joint axis that is expressed in another frame than the joint's.",
    matters="In URDF it is always the joint frame: the axis is turned into it.",
    example="`<xyz expressed_in='__model__'>`, `<use_parent_model_frame>`, every axis before SDF 1.5.",
    better="Nothing needs doing; the axis as it was written is kept in a carrier.",
)
MOVED_FRAME = Rule(
    name="moved-frame",
    severity=Severity.INFO,
    finds="A pose that is written with other numbers or in another frame than in the SDF file.",
    matters="In URDF a link's frame is its joint's, every pose is in the frame around it, and angles are in radians.",
    example="`<link name='arm'><pose>0 0 1 0 0 0</pose>` in the model frame becomes the origin of arm's joint.",
    better="Nothing needs doing: the robot is the same, and the pose as it was written is kept in a carrier.",
)
CUT_LOOP = Rule(
    name="cut-loop",
    severity=Severity.WARNING,
    finds="A joint that closes a loop, or gives a link a second parent where neither it nor what holds the link is "
    "reversible.",
    matters="URDF describes a tree. Gazebo closes the loop again by the `<joint>` in a `<gazebo>` element; to all "
    "other readers it is open.",
    example="The last joint of a four-bar linkage.",
    better="Close it in the other tools by their own means, such as a constraint.",
)
REVERSED_JOINT = Rule(
    name="reversed-joint",
    severity=Severity.INFO,
    finds="A joint whose parent and child are exchanged, since another joint has its child as the child too.",
    matters="In URDF a link hangs from one joint. The axis of the reversed joint points the other way, so that its "
    "positions, limits and motion are the same; the conversion back exchanges them again.",
    example="`base` is fixed to the world, and a joint with the parent `arm` has `base` as its child.",
    better="Write the joint with the link as its child that nothing else holds.",
)
HUNG_ROOT = Rule(
    name="hung-root",
    severity=Severity.INFO,
    finds="A link without a parent beside another one, or any link without a parent in a static model.",
    matters="A URDF robot has one root: the link is attached to it by a `floating` joint; in a static model the "
    "root is "
    "`world` and the joint `fixed`.",
    example="Two links and no joint.",
    better="Connect them by a joint if they belong together.",
)
UNSAYABLE_SHAPE = Rule(
    name="unsayable-shape",
    severity=Severity.WARNING,
    finds="A visual or collision with a shape that URDF does not have, or with none.",
    matters="ROS neither shows it nor plans around it.",
    example="`<plane>`, `<ellipsoid>`, `<cone>`, `<heightmap>`, `<polyline>`, one submesh of a mesh.",
    better="Use a mesh or one of box, cylinder and sphere. The shape is kept in a carrier.",
)
UNSAYABLE_NUMBER = Rule(
    name="unsayable-number",
    severity=Severity.ERROR,
    finds="A number that is infinite or none at all, where URDF needs one.",
    matters="Readers of URDF refuse the file.",
    example="`<ixx>nan</ixx>`",
    better="Write a finite number.",
)
UNBOUNDED_LIMIT = Rule(
    name="unbounded-limit",
    severity=Severity.INFO,
    finds="A limit of a revolute or prismatic joint that is infinite or not written.",
    matters="URDF asks for finite numbers: 1e16 stands for infinity, as it does in SDF before 1.10.",
    example="A prismatic joint without `<limit>`; `<effort>-1</effort>`.",
    better="Write the limit.",
)
COLORS = Rule(
    name="colours",
    severity=Severity.INFO,
    finds="Colors of a visual that are more than one color with alpha.",
    matters="A URDF material has one color: the diffuse one.",
    example="`<ambient>` unlike `<diffuse>`, or one of them alone.",
    better="Nothing needs doing: the colors as they were written are kept in a carrier.",
)

GAZEBO_MATERIAL = Rule(
    name="gazebo-material",
    severity=Severity.INFO,
    finds="A color or texture that Gazebo shows in another way where it reads the URDF, not the SDF: for a conversion "
    "to SDF, the first one of the robot.",
    matters=(
        "Gazebo divides the color of a URDF material by 0.8, so that it is brighter there than in the SDF, and makes "
        "a material black that has a texture alone."
    ),
    example="`<diffuse>0.4 0.4 0.4 1</diffuse>` is 0.4 in URDF, and 0.5 where Gazebo reads that.",
    better="Load the SDF in Gazebo; other readers of the URDF, and a conversion back, have the material as it was.",
    references="sdformat, parser_urdf.cc, CreateVisual.",
)
UNSHARED_SURFACE = Rule(
    name="unshared-surface",
    severity=Severity.WARNING,
    finds="A surface, `<max_contacts>` or `<laser_retro>` of SDF that other collisions of the link do not have.",
    matters=(
        "A `<gazebo>` element is about all collisions of a link, so there is none for one of them: where Gazebo reads "
        "the URDF, they all have the usual friction. It is kept in a carrier, and a conversion back to SDF has it."
    ),
    example="A chassis with a caster of `<mu>0</mu>` among its collisions.",
    better="Give Gazebo the SDF, or move the caster to a link of its own that is fixed to the chassis.",
    references="sdformat, parser_urdf.cc, InsertSDFExtensionCollision.",
)
GAZEBO_SHAPE_NAME = Rule(
    name="gazebo-shape-name",
    severity=Severity.INFO,
    finds="A shape of SDF with a name under which Gazebo would not apply the `<gazebo>` tags of its link.",
    matters=(
        "When Gazebo reads URDF, it tells by the name of a shape which tags it gets: one whose name does not begin "
        "with that of its link gets none, and loses its friction, its material and so on without a message."
    ),
    example='`<collision name="ball">` of link `caster` is called `caster_ball` in URDF.',
    better="Nothing needs doing: the old name is kept in an annotation, and a conversion back to SDF restores it.",
    references="sdformat, parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision.",
)

STALE_CARRIER = Rule(
    name="stale-carrier",
    severity=Severity.WARNING,
    finds=(
        "A carrier (an element of `tf:`) that no longer fits the model around it: what it belongs to was "
        "deleted, renamed or edited, or the carrier itself was edited so that it is invalid."
    ),
    matters=(
        "The rest of the file is used. A carrier holds only what the format lacks, so this one is dropped, and what "
        "it held is lost: a second color, a name, the frame that a pose was written in. The robot is the one that the "
        "file describes. Of a file that an early version of twinform wrote, all that it kept about its source "
        "(`<tf:source>` and the like) is ignored, with one warning."
    ),
    example=(
        "A visual of URDF has `<color rgba='0 1 0 1'/>` and `<tf:colors ambient='0.1 0 0 1' of='1 0 0 1'/>`: its color "
        "was red when its ambient one was 0.1 0 0 1, and has been changed since."
    ),
    better="Nothing, if the edit was meant. Delete the carrier to be rid of the warning.",
)
