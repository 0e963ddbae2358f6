"""Rules of the passes that change how models look and touch, and where their files are."""

from twinform.diagnostics.rule import Rule, Severity

UNSET_SURFACE = Rule(
    name="unset-surface",
    severity=Severity.WARNING,
    finds="A collision of URDF that was to get a surface of its own, unlike others of its link.",
    matters="The `<gazebo>` tags of URDF are about all collisions of a link, so the surface was not set.",
    example="`set-surface{mu=0.9 collisions=toe}` on a link with the collisions `toe` and `heel`.",
    better="Put the collision on a link of its own, or convert to SDF first and set the surface there.",
)
UNKNOWN_SCRIPT = Rule(
    name="unknown-script",
    severity=Severity.WARNING,
    finds="A material script of Gazebo Classic whose colors are not known: it is none of Classic's own, or one that "
    "only a shader paints.",
    matters="Newer Gazebo has no material scripts: it shows what has no other color in grey.",
    example="`<material>MyRobot/Carbon</material>`, `Gazebo/RedTransparent`.",
    better="Write the colors or the texture.",
)
TEXTURED_SCRIPT = Rule(
    name="textured-script",
    severity=Severity.INFO,
    finds="A material script of Gazebo Classic that also has an image, of which the colors alone were taken.",
    matters="The image is among Classic's own media, which newer Gazebo does not have.",
    example="`Gazebo/WoodFloor`",
    better="Copy the image beside the model and name it as the albedo map.",
)
UNMAPPED_URI = Rule(
    name="unmapped-uri",
    severity=Severity.WARNING,
    finds="A URI that `rewrite-uris` cannot write in the scheme that was asked for: its file is not found, or it lies "
    "in no package or model.",
    matters="The URI is left unchanged, so readers look for the file by its old URI.",
    example="`file:///home/me/arm.dae` to `package://`, where no folder above has a package.xml.",
    better="Say where files are with `--path DIR`, or name the folder: `roots=['arm=/home/me']`.",
)
NOTHING_MATCHED = Rule(
    name="nothing-matched",
    severity=Severity.WARNING,
    finds="A pattern in the options of a pass that nothing in the document matches.",
    matters="The pass did nothing, and a typing mistake would stay unseen.",
    example="`drop{sensors='*_camra'}`",
    better="Correct the pattern.",
)
DROPPED_REFERENCE = Rule(
    name="dropped-reference",
    severity=Severity.WARNING,
    finds="A plugin that names something which `drop` has taken out.",
    matters="The plugin will not find what it names, and few plugins report that.",
    example="`<plugin ...><sensor_name>lidar</sensor_name>` after `drop{sensors=lidar}`.",
    better="Drop the plugin as well, or correct its parameter.",
)
PBR_TOO_OLD = Rule(
    name="pbr-too-old",
    severity=Severity.WARNING,
    finds="A document of SDF before 1.6 whose colors were to become PBR materials.",
    matters="These versions have no PBR materials, so the colors are left unchanged.",
    example="`materials{pbr=true}` on `<sdf version='1.5'>`.",
    better="Write a newer version first: `--sdf-version 1.9`, and run the pass on that.",
    references="SDF specification 1.6, `material/pbr`.",
)

TIDIED_MATERIAL = Rule(
    name="tidied-material",
    severity=Severity.INFO,
    finds="A material of URDF that got a name, a name of its own, or its color, or that went because it has nothing.",
    matters="Readers differ about materials without a name, with two colors, or that are defined nowhere.",
    example="`tidy-materials` on `<material><color rgba='1 0 0 1'/></material>`.",
    better="Give every material one name and one color, before it is used.",
)
REPLACED_SHAPE = Rule(
    name="replaced-shape",
    severity=Severity.INFO,
    finds="A shape that most readers of URDF do not know, and that was made of those that they know, or left out.",
    matters="URDF has boxes, cylinders, spheres and meshes; what else stands there, some readers refuse.",
    example="`tidy-shapes` on `<capsule radius='0.1' length='0.4'/>`.",
    better="Write the shapes of URDF, with sizes above zero.",
)
