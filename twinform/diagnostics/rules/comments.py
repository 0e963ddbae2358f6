"""Rules about comments of the source that a conversion cannot place."""

from twinform.diagnostics.rule import Rule, Severity

LEFT_COMMENT = Rule(
    name="left-comment",
    severity=Severity.INFO,
    finds="A comment about a part of the file that is not converted, such as another model of a world.",
    matters="It is not in the result. Only the ledger has it.",
    example="`<!-- the shelf -->` before a model, where `--model` takes another one out of the world.",
    better="Nothing needs doing.",
)
