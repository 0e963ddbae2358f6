"""All rules by name."""

from functools import cache

from twinform.diagnostics.rule import Rule


@cache
def catalog() -> dict[str, Rule]:
    """Every rule of the compiler, sorted by name."""
    from twinform.diagnostics import rules  # noqa: PLC0415 - `import twinform` needs no rule

    return {rule.name: rule for rule in vars(rules).values() if isinstance(rule, Rule)}
