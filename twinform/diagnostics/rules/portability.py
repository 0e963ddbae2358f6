"""Rules of portability: what is fine in general, and not for some consumer. Looked for only with `--for`."""

from twinform.diagnostics.rule import Rule, Severity

UNREAD_FORMAT = Rule(
    name="unread-format",
    severity=Severity.WARNING,
    finds="A file in a format that a consumer does not read at all.",
    matters="MuJoCo, Pinocchio and ROS read URDF alone.",
    example="`twinform check --for mujoco robot.sdf`",
    better="Convert it: `twinform convert robot.sdf --to urdf --for mujoco`.",
)
CHANGED_PHYSICS = Rule(
    name="changed-physics",
    severity=Severity.INFO,
    finds="A link or joint whose physics a pass has changed for the sake of a consumer (`--for`).",
    matters="It is in the ledger, value by value: masses, inertias, limits, shapes of collisions. An engine that took "
    "the model as it was computes another motion now.",
    example="`split-massless: link 'tip': inertial/mass was not written, is 0.001`",
    better="Write the right values yourself. `--keep-physics` refuses such changes.",
)
KEPT_PHYSICS = Rule(
    name="kept-physics",
    severity=Severity.ERROR,
    finds="A thing that a consumer minds, and that only a pass that changes the physics could mend, under "
    "`--keep-physics`.",
    matters="The consumer would refuse the model, or read another one.",
    example="A moving link without mass, under `--for mujoco --keep-physics`.",
    better="Write the right values yourself, or leave `--keep-physics` out.",
)
COLLADA_MESH = Rule(
    name="collada-mesh",
    severity=Severity.INFO,
    finds="A mesh in a COLLADA file (`.dae`).",
    matters="Not every consumer reads COLLADA: MuJoCo refuses a model with such a collision.",
    example="`<collision><geometry><mesh filename='package://arm/meshes/base.dae'/></geometry></collision>` under "
    "`--for mujoco`.",
    better="Convert the file to OBJ or STL: `--passes convert-meshes{for=mujoco}`, which `convert --for mujoco` runs.",
)

UNREAD_VALUE = Rule(
    name="unread-value",
    severity=Severity.INFO,
    finds="A value in a form that a consumer does not read.",
    matters="What is a number to one reader is none to another: urdfdom refuses `inf`, a tab between numbers and a "
    "blank behind one, Python reads `1_0`, Bullet reads the beginning and makes 0 of the rest.",
    example="`<limit effort='inf' velocity='1'/>` under `--for urdfdom`.",
    better="Write plain numbers, with single blanks between them.",
)
UNWRITTEN_PART = Rule(
    name="unwritten-part",
    severity=Severity.INFO,
    finds="An attribute or element that is not written, and that a consumer needs.",
    matters="What one reader has a default for, another refuses: a limit without an effort, an inertia without its "
    "products, a material without a name.",
    example="`<limit lower='0' upper='1'/>` under `--for urdfdom`.",
    better="Write it.",
)
UNREAD_PART = Rule(
    name="unread-part",
    severity=Severity.INFO,
    finds="An element or attribute that a consumer does not know.",
    matters="Some skip it with a line on the terminal, some without one, and some refuse the file: a capsule, a second "
    "`<limit>`, a tag of a simulator.",
    example="`<geometry><capsule radius='1' length='2'/></geometry>` under `--for urdfdom`.",
    better="Leave it out for this consumer, or write what it knows.",
)
UNTAKEN_TREE = Rule(
    name="untaken-tree",
    severity=Severity.INFO,
    finds="Names, references or a tree of links that a consumer does not take.",
    matters="Most want every name once and all links in one tree; some read the rest of it, and some crash.",
    example="A robot with two links that have no joint above them, under `--for pybullet`.",
    better="Give every part a name of its own, and join all links into one tree.",
)
UNREAD_TEXT = Rule(
    name="unread-text",
    severity=Severity.INFO,
    finds="A text that the XML parser of a consumer does not read, though others do.",
    matters="TinyXML-2 refuses `<?...?>` inside of the robot and a comment before the declaration, Python refuses a "
    "prefix that is not declared and `--` in a comment, and Bullet breaks lines of more than 8191 characters.",
    example="`<!-- made by hand --><?xml version='1.0'?><robot name='arm'/>` under `--for pinocchio`.",
    better="`twinform convert --to urdf` writes plain XML that all of them read.",
)
UNTAGGED_SHAPE = Rule(
    name="untagged-shape",
    severity=Severity.INFO,
    finds="A shape of URDF with a name under which Gazebo does not apply the `<gazebo>` tags of its link.",
    matters=(
        "Gazebo goes by names: a shape gets the tags of its link if its name begins with the link's, or if it has "
        "none. Any other one has no friction, contact or material of the tags, without a message. Where a link is "
        "lumped into another, only a shape without a name, or one called `LINK_collision...`, gets those of its link."
    ),
    example='`<collision name="ball">` in link `caster`, with `<gazebo reference="caster"><mu1>0</mu1></gazebo>`.',
    better="Leave out the name, or call it `caster_ball`; the pass `tag-shapes` does so.",
    references="sdformat, parser_urdf.cc, CreateCollision and InsertSDFExtensionCollision.",
)
RENAMED_COLLISION = Rule(
    name="renamed-collision",
    severity=Severity.INFO,
    finds="A contact sensor of URDF that names a collision by its name in the file, which is not that in Gazebo.",
    matters="Gazebo adds `_collision` and a number to names of URDF; the sensor finds no such collision and is silent.",
    example='`<collision>ball</collision>`, where `<collision name="ball">` of link `base` is '
    "`base_fixed_joint_lump__ball_collision` in Gazebo.",
    better="Write the name that Gazebo gives it; the pass `tag-shapes` does so.",
    references="sdformat, parser_urdf.cc, CreateCollisions.",
)
SHORTFALLS = {
    "value": UNREAD_VALUE,
    "absent": UNWRITTEN_PART,
    "unread": UNREAD_PART,
    "tree": UNTAKEN_TREE,
    "text": UNREAD_TEXT,
}
"""The rules about what a consumer's table of reads demands, by the kind of shortfall."""
