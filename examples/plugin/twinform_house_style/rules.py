"""What our passes find."""

from twinform.diagnostics import Rule, Safety, Severity

UNUSUAL_NAME = Rule(
    name="unusual-name",
    severity=Severity.WARNING,
    fix=Safety.UNSAFE,
    finds="A link or joint whose name is not of the form that the house has agreed on.",
    matters="Scripts of the house find links and joints by their names.",
    example="`<link name='Base Link'/>`",
    better="`<link name='base_link'/>`",
)
