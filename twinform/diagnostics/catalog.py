"""All rules by name."""

from functools import cache
from importlib import import_module

from twinform.diagnostics.rule import Rule

_PACKAGE = "twinform.diagnostics.rules"


@cache
def catalog() -> dict[str, Rule]:
    """Every rule of the compiler, sorted by name.

    Raises:
        ValueError: two rules share a name.
    """
    rules: dict[str, Rule] = {}
    for rule in sorted((rule for found in defined_rules().values() for rule in found), key=lambda rule: rule.name):
        if rule.name in rules:
            raise ValueError(f"two rules are called {rule.name!r}")
        rules[rule.name] = rule
    return rules


def defined_rules() -> dict[str, list[Rule]]:
    """The rules by the name of the module that they are written in."""
    from pkgutil import iter_modules  # noqa: PLC0415 - few commands need all rules

    names = [info.name for info in iter_modules(import_module(_PACKAGE).__path__)]
    return {name: rules_of(name) for name in names}


def rules_of(module: str) -> list[Rule]:
    """The rules that are written in a module."""
    return [value for value in vars(import_module(f"{_PACKAGE}.{module}")).values() if isinstance(value, Rule)]
