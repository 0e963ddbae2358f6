"""Rules about the other files that a model names: included models, packages, meshes."""

from twinform.diagnostics.rule import Rule, Severity

UNRESOLVED_URI = Rule(
    name="unresolved-uri",
    severity=Severity.ERROR,
    finds="A URI whose file or folder is in none of the places where it is looked for.",
    matters="What it names would be missing from the robot.",
    example="`<uri>model://gripper</uri>` where no folder of models holds a `gripper`.",
    better="Name the folder that holds it with `--path DIR`, or in GZ_SIM_RESOURCE_PATH or ROS_PACKAGE_PATH. Models of "
    "Fuel must be in its cache, since nothing is fetched: run `gz fuel download -u URI`.",
)
URI_LEAVES_FOLDER = Rule(
    name="uri-leaves-folder",
    severity=Severity.ERROR,
    fatal=True,
    finds="A `model://` or `package://` URI that leads out of the folders of models and packages, by `..` or by a "
    "symbolic link.",
    matters="A model from somebody else could have any file of this machine read.",
    example="`<uri>model://crate/../../secret.sdf</uri>`",
    better="Write a path inside the model or package. If a link is meant, name the folder that it leads to with "
    "`--path DIR`.",
)
BROKEN_MODEL_CONFIG = Rule(
    name="broken-model-config",
    severity=Severity.ERROR,
    finds="A `model.config` that is not XML, names no SDF file, or names one that is not there.",
    matters="The model in its folder cannot be found.",
    example="`<sdf version='1.9'>modle.sdf</sdf>`",
    better="Write `<sdf version='...'>model.sdf</sdf>` with the name of the file beside it.",
)
MISSING_MODEL_CONFIG = Rule(
    name="missing-model-config",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An included folder with a `model.sdf` and no `model.config` beside it.",
    matters="`model.sdf` is read instead; Gazebo refuses the folder.",
    example="`<uri>model://crate</uri>` where the folder `crate` has only `model.sdf`.",
    better="Write a model.config that names it, or include the file: `model://crate/model.sdf`.",
)
MISSING_FILE = Rule(
    name="missing-file",
    severity=Severity.WARNING,
    finds="A mesh, texture or included model whose file is not found. Nothing is reported about packages and models "
    "that are "
    "not on this machine at all: they may be installed where the robot is.",
    matters="The part cannot be seen or touched, or the file is refused.",
    example="`<mesh filename='package://arm/meshes/Elbow.STL'/>` where the file is called `elbow.stl`.",
    better="Correct the path; capitals count. Name a folder that holds models or packages with `--path DIR`.",
)
BACKSLASH_IN_PATH = Rule(
    name="backslash-in-path",
    severity=Severity.WARNING,
    finds="A backslash in the path or URI of a file.",
    matters="Only Windows reads it as a separator; everywhere else it is a part of the name, and no file is found.",
    example="`<mesh filename='meshes\\elbow.stl'/>`",
    better="Write slashes, which all systems read: `meshes/elbow.stl`.",
)
