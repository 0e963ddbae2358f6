"""All rules by name."""

from functools import cache
from importlib import import_module
from pkgutil import iter_modules

from twinform.diagnostics.rule import Rule


@cache
def catalog() -> dict[str, Rule]:
    """Every rule of the compiler, sorted by name.

    Raises:
        ValueError: two rules share a name.
    """
    rules: dict[str, Rule] = {}
    for rule in sorted(_defined(), key=lambda rule: rule.name):
        if rule.name in rules:
            raise ValueError(f"two rules are called {rule.name!r}")
        rules[rule.name] = rule
    return rules


def _defined() -> list[Rule]:
    package = import_module("twinform.diagnostics.rules")
    modules = [import_module(f"{package.__name__}.{info.name}") for info in iter_modules(package.__path__)]
    return [value for module in modules for value in vars(module).values() if isinstance(value, Rule)]
