"""Rules about the structure of a file, which its schema decides. The schema reader reports them."""

from twinform.diagnostics.rule import Rule, Severity

UNKNOWN_ELEMENT = Rule(
    name="unknown-element",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An element that no version of the format has at this place, nor any dialect that is known here.",
    matters="Every reader ignores it silently, so a misspelt tag seems to work.",
    example="`<joint ...><limits lower='0' upper='1'/></joint>`: the tag is `<limit>`.",
    better="Correct the name, or move what belongs to another tool into a namespace of its own (`<my:limits "
    "xmlns:my=...>`).",
)
UNKNOWN_ATTRIBUTE = Rule(
    name="unknown-attribute",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An attribute that no version of the format has on this element.",
    matters="Every reader ignores it silently, so a misspelt attribute leaves its default in place.",
    example="`<limit min='0' max='1'/>`: the attributes are `lower` and `upper`.",
    better="Correct the name, or give it a namespace prefix.",
)
DIALECT = Rule(
    name="dialect",
    severity=Severity.INFO,
    strict=Severity.ERROR,
    finds="An element, attribute or value that is not in the format, and that is known from a program that reads it.",
    matters="That program acts on it, every other reader ignores it. It is kept as it is, and carried in a conversion.",
    example="`<contact>` in a link for Bullet, `<mujoco>` for MuJoCo, `<frame>` and all of `<drake:...>` for Drake, "
    "`<joint type='spherical'>`.",
    better="Nothing needs doing where that program is used; for others, write what they read as well.",
)
MISSING_ELEMENT = Rule(
    name="missing-element",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An element that the format requires, and that has no useful default, is not there.",
    matters="Readers fill the gap each in its own way: an error, a zero, or half of the link left out.",
    example="`<visual><origin xyz='0 0 1'/></visual>` has no `<geometry>`.",
    better="Write the element.",
)
MISSING_PART = Rule(
    name="missing-part",
    severity=Severity.ERROR,
    finds="An element without which the model has no meaning is not there, such as a joint's parent or child.",
    matters="Every reader refuses the file.",
    example="`<joint name='a' type='fixed'><child link='b'/></joint>` has no parent.",
    better="Write the element.",
)
MISSING_ATTRIBUTE = Rule(
    name="missing-attribute",
    severity=Severity.ERROR,
    finds="An attribute that the format requires is not there.",
    matters="Readers refuse the file, or drop the element and all that follows it in the link.",
    example="`<limit lower='0' upper='1'/>` in URDF 1.0 has neither effort nor velocity.",
    better="Write the attribute.",
)
DEFAULTED_ATTRIBUTE = Rule(
    name="defaulted-attribute",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An attribute that the format requires is not there; it has a default, or its element has no effect without "
    "it, so it is clear what is meant.",
    matters="Some readers refuse the file all the same, as libsdformat does with SDF.",
    example="`<light name='lamp'>` without `type`, which is `point` by default; `<texture/>` in URDF.",
    better="Write the attribute.",
    references="libsdformat: ATTRIBUTE_MISSING",
)
DEPRECATED_ELEMENT = Rule(
    name="deprecated-element",
    severity=Severity.INFO,
    finds="An element that this version of the format has, and one of the next will not.",
    matters="libsdformat warns of it; readers of a later version ignore it.",
    example="`<thread_pitch>` from SDF 1.10 on; `<screw_thread_pitch>` has taken its place.",
    better="Write what has taken its place.",
    references="libsdformat: ELEMENT_DEPRECATED",
)
REPEATED_ELEMENT = Rule(
    name="repeated-element",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An element that may stand once stands again.",
    matters="Readers take the first one, or the last one, and ignore the others silently.",
    example="A joint with two `<limit>` elements.",
    better="Keep the one that is meant.",
)
INVALID_VALUE = Rule(
    name="invalid-value",
    severity=Severity.ERROR,
    finds="Text that is not of the type that the format asks for.",
    matters="Readers refuse the file, or read the beginning of the text and ignore the rest.",
    example="`<origin xyz='0 0'/>`, `<mass>1.0kg</mass>`, `<limit effort='inf' .../>` in URDF, `1e400`.",
    better="Write a value of the type; vectors are separated by blanks, not commas.",
)
BLANK_VALUE = Rule(
    name="blank-value",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An element that is there to hold a value and holds none. A `<pose/>` is none of them: it may only name its "
    "frame.",
    matters="libsdformat refuses the file where the format asks for the element, and takes the default where it does "
    "not. Here the default is meant in both.",
    example="`<cylinder><radius/><length>1</length></cylinder>`",
    better="Write the value, or delete the element.",
)
SPLIT_VALUE = Rule(
    name="split-value",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A value with a comment in the middle.",
    matters="To XML, and here, the pieces are one text. libsdformat reads the first piece alone: a number that is cut "
    "in two is another number there, without a word.",
    example="`<mass>1<!-- about -->2.5</mass>` weighs 12.5 kg here and 1 kg in Gazebo.",
    better="Put the comment before or behind the value.",
)
TABBED_NUMBERS = Rule(
    name="tabbed-numbers",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="Numbers in an attribute of URDF that have a tab or a new line before, between or behind them.",
    matters="To XML, and here, they are blanks. urdfdom does not read a number with a tab as a number, "
    "and drops the rest of the link; of a joint, the whole file.",
    example="`<origin xyz='0 0` and `0.1'/>` on the next line.",
    better="Put blanks between the numbers, on one line.",
)
OUT_OF_RANGE = Rule(
    name="out-of-range",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A number below the least or above the greatest value that the format allows.",
    matters="libsdformat refuses some of them (colors above 1, negative friction); simulators replace others by a "
    "default or become unstable.",
    example="`<mass value='-1'/>`, `<cylinder radius='-0.1' .../>`.",
    better="Write a value in the range.",
)
STRAY_TEXT = Rule(
    name="stray-text",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="Text between elements, where the format has none.",
    matters="It is ignored; most often it is a comment or a tag that lost its brackets.",
    example="`<link name='a'> the base <visual>...`",
    better="Delete it, or make it a comment.",
)
OUTSIDE_VERSION = Rule(
    name="outside-version",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="An element, attribute or value that the format has, but not in the version that the file declares.",
    matters="Readers of that version ignore it; newer ones may read it in another way than it was meant.",
    example="`<capsule>` in an SDF 1.6 file: it came with 1.8. A joint of type `fixed` in SDF 1.4: it came with 1.5.",
    better="Declare the version that has it, or write what the declared version has.",
)
UNKNOWN_VERSION = Rule(
    name="unknown-version",
    severity=Severity.WARNING,
    strict=Severity.ERROR,
    finds="A version that the format does not have, or none where one is required.",
    matters="Readers guess: most take their newest version, some refuse the file.",
    example="`<sdf version='9.9'>`",
    better="Declare the version that the file was written for.",
)
SCHEMA_DISAGREEMENT = Rule(
    name="schema-disagreement",
    severity=Severity.ERROR,
    fatal=True,
    finds="The XSD refuses a file in which the schema reader finds nothing wrong.",
    matters="Both are made from one table, so this is a fault of this compiler and not of the file.",
    example="None is known.",
    better="Please report it with the file.",
)
