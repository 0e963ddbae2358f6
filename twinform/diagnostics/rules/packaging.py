"""Rules of `twinform package`: what could not be put into a package, and what its author has to fill in."""

from twinform.diagnostics.rule import Rule, Severity

UNPACKAGED_FILE = Rule(
    name="unpackaged-file",
    severity=Severity.ERROR,
    finds="A mesh, texture or script that the model names, or that one of its meshes names, and that cannot be put "
    "into the package: it is not found, is no kind of file that belongs there, or cannot be read.",
    matters="The package would not be complete: on another machine, the robot would lack what it looks like or "
    "collides with.",
    example="`<mesh filename='package://arm/meshes/elbow.stl'/>` where no folder holds a package `arm`.",
    better="Say where the file is with `--path DIR`, or correct the URI. `--allow-missing` makes the package without "
    "the file; its URI stays as it is.",
)
UNPACKAGED_INCLUDE = Rule(
    name="unpackaged-include",
    severity=Severity.ERROR,
    finds="An `<include>` with a path to a file that will not be in the package.",
    matters="The path leads nowhere from the folder of the package.",
    example="`<include><uri>../gripper/model.sdf</uri></include>`",
    better="Put the included model in its place with `--expand-includes`, or include it as `model://gripper`, which "
    "the package then depends on.",
)
UNPACKAGED_PARAMETER = Rule(
    name="unpackaged-parameter",
    severity=Severity.WARNING,
    finds="A parameter of a plugin that names a file by a URI. Parameters belong to their plugins, so they are left as "
    "they are, and the file is not in the package.",
    matters="The plugin looks for the file where it was.",
    example="`<plugin ...><parameters>package://arm_control/config/controllers.yaml</parameters></plugin>`",
    better="Nothing needs doing where the other package is installed too. Otherwise copy the file by hand, and write "
    "its new URI.",
)
PLACEHOLDER = Rule(
    name="placeholder",
    severity=Severity.WARNING,
    finds="A package whose maintainer, license or description was not given, and is not in a package.xml or "
    "model.config around the model either, so that TODO stands there.",
    matters="Who publishes the package needs them: catkin and ament refuse a package.xml without a maintainer with an "
    "email address and without a license.",
    example="`<license>TODO: License declaration</license>`",
    better="Give them: `--maintainer NAME --email ADDRESS --license Apache-2.0 --description TEXT`.",
)
NO_THUMBNAIL = Rule(
    name="no-thumbnail",
    severity=Severity.INFO,
    finds="A model folder without a picture of its model: nothing of it can be drawn, or the libraries for that are "
    "not installed.",
    matters="Gazebo and Fuel show the model without a picture.",
    example="A model without visuals; `twinform package` without the extra `thumbnails`.",
    better="Install `twinform[thumbnails]`, or put a picture into `thumbnails/`. `--no-thumbnail` asks for none.",
)
