"""Rules about `<include>` elements that are expanded."""

from twinform.diagnostics.rule import Rule, Severity

INCLUDE_CYCLE = Rule(
    name="include-cycle",
    severity=Severity.ERROR,
    unsound=True,
    finds="A file that includes itself, directly or through others.",
    matters="The expansion would never end.",
    example="`a.sdf` includes `b.sdf`, and `b.sdf` includes `a.sdf`.",
    better="Take one of the includes out.",
)
TOO_MANY_INCLUDES = Rule(
    name="too-many-includes",
    severity=Severity.ERROR,
    finds="Includes that are nested more than 32 deep, or that make more than 10,000 models in all.",
    matters="A few hostile files can make more models than any memory holds.",
    example="Ten files, each of which includes the next one ten times.",
    better="Split the world, or write out what is meant.",
)
INCLUDE_WITHOUT_MODEL = Rule(
    name="include-without-model",
    severity=Severity.ERROR,
    finds="An included file that contains no model, or nothing that is allowed where the include is.",
    matters="A model would be missing from the robot or the world.",
    example="A file with a `<world>`; a light that is included into a model.",
    better="Include a file with one model; into a world also one with a light or an actor.",
)
INCLUDE_TAKES_FIRST = Rule(
    name="include-takes-first",
    severity=Severity.WARNING,
    finds="An included file with several models.",
    matters="An include stands for one model: the first one is taken, as by libsdformat.",
    example="A file with a robot and a table.",
    better="Give each model a file of its own.",
)
INCLUDE_PARAMETERS = Rule(
    name="include-parameters",
    severity=Severity.ERROR,
    finds="`<experimental:params>` in an include that is to be expanded.",
    matters="They change the included model, and applying them is not supported: the result would be another robot.",
    example="`<experimental:params><link element_id='a' action='remove'/></experimental:params>`",
    better="Leave the include as it is, which keeps them, or write the changed model out.",
)
PLACEMENT_WITHOUT_POSE = Rule(
    name="placement-without-pose",
    severity=Severity.ERROR,
    finds="An include with a `placement_frame` and no `pose`.",
    matters="The pose places that frame; without a pose it has no effect, and libsdformat refuses the file.",
    example="`<include><uri>model://arm</uri><placement_frame>flange</placement_frame></include>`",
    better="Write the pose, or leave the placement frame out.",
)
UNMERGEABLE_INCLUDE = Rule(
    name="unmergeable-include",
    severity=Severity.ERROR,
    finds="An include with `merge='true'` that cannot be merged: at the root of a file, or with links into a world.",
    matters="Its contents have no place there.",
    example="`<world><include merge='true'><uri>model://robot</uri></include></world>`",
    better="Leave `merge` out.",
)
MERGED_AWAY = Rule(
    name="merged-away",
    severity=Severity.INFO,
    finds="A setting of an included model as a whole, which is merged into another model.",
    matters="The setting of the model around it is used.",
    example="`<static>true</static>` in a model that is included with `merge='true'`.",
    better="Write it in the model around it.",
)
INCLUDE_LEFTOVER = Rule(
    name="include-leftover",
    severity=Severity.WARNING,
    finds="Something in an include that an expanded model has no place for, such as its URI, for the ledger.",
    matters="It is left out, because the included model replaces the include.",
    example="An unknown element inside `<include>`.",
    better="Write it into the included model.",
)
