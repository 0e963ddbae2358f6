"""All rules by name, and where the project and its pages are to be found."""

from functools import cache

from twinform.diagnostics.diagnostic import Rule


@cache
def catalog() -> dict[str, Rule]:
    """Every rule of the compiler, sorted by name."""
    from twinform.diagnostics import rules  # noqa: PLC0415 - `import twinform` needs no rule

    return {rule.name: rule for rule in vars(rules).values() if isinstance(rule, Rule)}


HOME = ""
"""The address of the project's repository on the web; empty until there is one that the project owns."""


def rule_address(name: str) -> str | None:
    """The address of the page of a rule; None if the rule is not a built-in one, or the project has no address."""
    return f"{HOME}/blob/main/twinform/diagnostics/rules/{name}.md" if HOME and name in catalog() else None


def more_about(name: str) -> str:
    """Where more is said about a rule: its address, or the command that prints its page."""
    return rule_address(name) or f"twinform explain {name}"
