"""Rules about xacro, the macro language in which most URDF is written."""

from twinform.diagnostics.rule import Rule, Severity

XACRO_ERROR = Rule(
    name="xacro-error",
    severity=Severity.ERROR,
    fatal=True,
    finds="A xacro file that cannot be expanded: an undefined property, macro or argument, a missing include or "
    "package, a bad expression, macros that never end; or an expression or file that is refused, since a robot needs "
    "none of it: what leads to Python behind the expression, asks for too much, or lies outside of the folders of "
    "models and packages.",
    matters="There is no model before it is expanded.",
    example="`<link name='${prefix}_base'/>` where no property is called `prefix`.",
    better="Correct the line that the message names. Arguments come after the inputs, `prefix:=left`; packages are "
    "looked "
    "for in ROS_PACKAGE_PATH, AMENT_PREFIX_PATH, around the file, and in the folders of `--path DIR`. The page about "
    "working with xacro lists what expressions may use.",
)
XACRO_WARNING = Rule(
    name="xacro-warning",
    severity=Severity.WARNING,
    finds="A warning of xacro itself, or of the file that it expands.",
    matters="It is often a deprecated name, or a file that was not found and is left out.",
    example="`${radians(90)}` in place of `${math.radians(90)}`; `${xacro.warning('no gripper')}`.",
    better="Follow the message.",
)
XACRO_MESSAGE = Rule(
    name="xacro-message",
    severity=Severity.INFO,
    finds="A message that a xacro file writes while it is expanded.",
    matters="Its author wanted it to be seen.",
    example="`${xacro.message('two arms')}`",
    better="Nothing needs doing.",
)
XACRO_MISSING = Rule(
    name="xacro-missing",
    severity=Severity.ERROR,
    fatal=True,
    finds="A xacro file on a machine without xacro.",
    matters="It cannot be expanded.",
    example="`twinform check robot.urdf.xacro` after `pip install twinform`.",
    better="Run `pip install 'twinform[xacro]'`; no ROS is needed.",
)
XACRO_REFUSED = Rule(
    name="xacro-refused",
    severity=Severity.ERROR,
    fatal=True,
    finds="A xacro file where `--no-xacro` refuses them.",
    matters="Expanding one evaluates its expressions and reads files of its repository and packages that it names.",
    example="`twinform check --no-xacro robot.urdf.xacro`",
    better="Leave `--no-xacro` out for files that you trust, or expand them elsewhere.",
)
UNUSED_ARGUMENT = Rule(
    name="unused-argument",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An argument that was given and that the xacro file does not use.",
    matters="A misspelt name changes nothing, and xacro does not say so.",
    example="`twinform check robot.urdf.xacro prefx:=left`",
    better="Check the name against the `<xacro:arg>` elements.",
)
UNEXPANDED_XACRO = Rule(
    name="unexpanded-xacro",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="Elements of xacro in a file whose name does not end in `.xacro`; or expressions, `${...}`: an error in "
    "what describes the robot itself, a warning in `<ros2_control>` and `<transmission>`.",
    matters="The file is read without expanding them, so the robot is not the one that is meant.",
    example="`<xacro:wheel side='left'/>` or `<origin xyz='0 ${width/2} 0'/>` in `robot.urdf`.",
    better="Call the file `robot.urdf.xacro`, pass `--xacro`, or expand it first.",
)
