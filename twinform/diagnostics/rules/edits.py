"""Rules about changes to the structure of a model: names, joints, and models in models."""

from twinform.diagnostics.rule import Rule, Severity

NAME_CLASH = Rule(
    name="name-clash",
    severity=Severity.ERROR,
    finds="Two things that a pass would give one name.",
    matters="Links, joints and frames are found by their names; with two of one name a reference is ambiguous.",
    example="`rename{names=[left_arm:arm]}` on a robot that has another link called `arm`.",
    better="Choose another name, or a prefix that nothing has yet.",
    references="SDF specification, names of siblings; URDF: links and joints are unique by name.",
)
UNKNOWN_NAME = Rule(
    name="unknown-name",
    severity=Severity.ERROR,
    finds="A name in the options of a pass that nothing in the model has.",
    matters="The pass would do nothing, and a typing mistake would stay unseen.",
    example="`reroot{link=tool}` on a robot whose link is called `tool0`.",
    better="Correct the name; `twinform stats` lists what a model has.",
)
UNFOLLOWED_NAME = Rule(
    name="unfollowed-name",
    severity=Severity.INFO,
    finds="A text or attribute that is the old name of something that was renamed, where it is not "
    "known whether it refers to it.",
    matters="It may be a reference that now leads nowhere, or only a label that resembles one.",
    example="`<cameraName>wrist</cameraName>` in a plugin, after the link `wrist` was renamed.",
    better="Check it, and change it by hand where it is a reference.",
)
LINK_NOT_LUMPED = Rule(
    name="link-not-lumped",
    severity=Severity.INFO,
    finds="A link on a fixed joint that stays a body of its own, and why: a sensor on the joint, a plugin that names "
    "the link, other gravity than its parent has, a loop of fixed joints.",
    matters="Lumping it would change what the robot does.",
    example="A force and torque sensor on the joint between wrist and gripper.",
    better="Nothing has to be done. Remove what holds the link, if it is not needed.",
)
SHAPES_NOT_MOVED = Rule(
    name="shapes-not-moved",
    severity=Severity.INFO,
    finds="Shapes that stay with a link although its mass went to the parent, because `<gazebo>` tags set other "
    "friction or materials for the two links.",
    matters="In URDF such a tag applies to all shapes of a link, so in one link they would all be alike.",
    example="`<gazebo reference='foot'><mu1>0.9</mu1></gazebo>`, with another `mu1` for the shank.",
    better="Nothing has to be done: readers put the shapes where the link is. In SDF every shape has its own surface.",
)
LUMPED_AWAY = Rule(
    name="lumped-away",
    severity=Severity.WARNING,
    finds="What is lost when fixed joints are lumped as libsdformat does it: extensions of a joint that goes, "
    "surfaces and "
    "materials that would mix with those of the parent.",
    matters="It is lost in Gazebo too, silently; a force and torque sensor is the usual victim.",
    example="`<gazebo reference='fixed_joint'><sensor type='force_torque'>`.",
    better="Use `lump-fixed-joints` without `compat`, which keeps such joints, or name the joint in `keep`.",
    references="sdformat, parser_urdf.cc, ReduceSDFExtensionToParent; gazebo-classic issue 2732.",
)
NOT_FOR_FORMAT = Rule(
    name="not-for-format",
    severity=Severity.WARNING,
    finds="A pass, or an option of it, that has no effect in the format of the document.",
    matters="The document is left unchanged, which may not be what was wanted.",
    example="`lump-fixed-joints{compat=libsdformat}` on an SDF file: libsdformat lumps joints of URDF only.",
    better="Leave the option out, or run the pass on the other format.",
)
IRREVERSIBLE_JOINT = Rule(
    name="irreversible-joint",
    severity=Severity.ERROR,
    finds="A joint between the root and the link that is to become the root, whose motion has no exact reverse.",
    matters="Parent and child of a joint can be exchanged only if the same positions then mean the same motion.",
    example="A `planar` joint: it shifts and then turns, and its reverse turns and then shifts.",
    better="Choose a root on this side of the joint, or replace the joint by a chain of simple ones.",
)
ALREADY_HELD = Rule(
    name="already-held",
    severity=Severity.INFO,
    finds="A model that is to be fixed to the world and is so already.",
    matters="Nothing is changed, also not the pose.",
    example="A robot with a root link called `world`, a static model.",
    better="Edit the joint that holds it, or remove it first.",
)
UNREAD_DOCUMENT = Rule(
    name="unread-document",
    severity=Severity.ERROR,
    finds="Another model file that a pass needs and that cannot be had: it is not there, has errors, or holds no model "
    "that could be meant.",
    matters="The pass can do nothing without it.",
    example="`attach{file=gripper.urdf to=tool0}` where `gripper.urdf` is in another folder.",
    better="Paths are relative to the working directory; `package://` and `model://` are looked up with `--path`.",
)
NESTED_SETTING = Rule(
    name="nested-setting",
    severity=Severity.WARNING,
    finds="A setting of a nested model as a whole that differs from that of the model around it.",
    matters="After flattening there is one model, and its setting applies to all of it.",
    example="A nested model with `<static>true</static>` in one that moves.",
    better="Set it in the outer model, fix what has to stand still to the world, or leave the model nested.",
)
RAISED_VERSION = Rule(
    name="raised-version",
    severity=Severity.INFO,
    finds="An SDF file of a version before 1.8 that a pass on the structure of models has upgraded to SDF 1.8.",
    matters="Since 1.8, frames can be placed between any two parts of a model; the result has that version.",
    example="`lump-fixed-joints` on a file of SDF 1.4.",
    better="Nothing has to be done; `--sdf-version` writes an older one again.",
)
EDIT_CONFLICT = Rule(
    name="edit-conflict",
    severity=Severity.ERROR,
    finds="A part of a file that is to be changed in its place, and that says something else than what the change "
    "begins with.",
    matters="The change and what is written contradict each other; nothing is written, so that nobody's edit is lost.",
    example="Two `<mass>` in an `<inertial>`: the first counts, and a pass changes it; which of them is to change?",
    better="Mend that part of the file first, or write the result to another file with `-o`.",
)
