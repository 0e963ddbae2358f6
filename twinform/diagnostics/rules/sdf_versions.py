"""Rules of the way from one version of SDF to another."""

from twinform.diagnostics.rule import Rule, Severity

OTHER_WORDS = Rule(
    name="other-words",
    severity=Severity.INFO,
    finds="Something that the SDF version asked for writes in another way than the file.",
    matters="It means the same, in other numbers or names: a pose in another frame, an infinite limit as 1e16.",
    example="`<pose relative_to='arm'>` in SDF 1.6, where a link is posed in the model.",
    better="Nothing needs doing: the original is kept in a carrier, and restored in a version that has it.",
)
GONE_FROM_SDF = Rule(
    name="gone-from-sdf",
    severity=Severity.INFO,
    finds="A part of an older version of SDF that the version asked for no longer has.",
    matters="Readers of the newer version do not look for it.",
    example="`<initial_position>` after 1.8, `<frame>` in a link after 1.6.",
    better="Nothing needs doing if nothing reads it: it is kept in a carrier.",
)
NAME_MADE = Rule(
    name="name-made",
    severity=Severity.INFO,
    finds="A plugin or light without a name, which needs one in the SDF version asked for.",
    matters="A program that looks for it by name finds it by this one.",
    example="`<plugin filename='libx.so'>`, whose name is optional since 1.10.",
    better="Name it.",
)
