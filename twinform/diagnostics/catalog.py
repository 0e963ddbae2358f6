"""All rules by name, and where the project and its pages are to be found."""

from functools import cache

from twinform.diagnostics.diagnostic import Rule


@cache
def catalog() -> dict[str, Rule]:
    """Every rule of the compiler, sorted by name."""
    from twinform.diagnostics import rules  # noqa: PLC0415 - `import twinform` needs no rule

    return {rule.name: rule for rule in vars(rules).values() if isinstance(rule, Rule)}


HOME = "https://github.com/twinform/twinform"
RULE_PAGES = f"{HOME}/blob/main/twinform/diagnostics/rules"


def rule_address(name: str) -> str:
    """The address of the page of a built-in rule."""
    return f"{RULE_PAGES}/{name}.md"
