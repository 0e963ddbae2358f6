"""`--allow` and `--deny`."""

from collections.abc import Callable
from typing import Any, TypeVar

import click

from twinform.cli.completion import rule_names
from twinform.cli.config import ConfigError, settings_of
from twinform.cli.failure import Unusable
from twinform.diagnostics import Policy
from twinform.diagnostics.registry import RuleRegistryError, find_rule, rules

Command = TypeVar("Command", bound=Callable[..., Any])


def policy_options(command: Command) -> Command:
    """Give a command `--allow` and `--deny`; what the configuration has comes in addition."""
    for name, text in (("deny", "Make findings of a rule errors"), ("allow", "Leave out findings of a rule")):
        more = "" if name == "deny" else ", if they are no errors"
        command = click.option(
            f"--{name}",
            metavar="RULE",
            multiple=True,
            help=f"{text}{more}; repeatable.",
            callback=_known,
            shell_complete=rule_names,
        )(command)
    return command


def policy_of(ctx: click.Context, allow: tuple[str, ...], deny: tuple[str, ...]) -> Policy:
    """The policy of a command: that of its options, and of the project where the options say nothing else.

    Raises:
        ConfigError: the configuration names a rule that there is not.
    """
    project = settings_of(ctx)
    for key, names in (("allow", project.allow), ("deny", project.deny)):
        for name in names:
            if project.path and (problem := _unknown(name)):
                raise ConfigError(project.path, problem, key=key)
    allowed, denied = frozenset(allow), frozenset(deny)
    both = sorted(allowed & denied) or sorted({*project.allow} & {*project.deny})
    if both:
        raise click.UsageError(f"{both[0]} is allowed and denied")
    return Policy(allowed | (frozenset(project.allow) - denied), denied | (frozenset(project.deny) - allowed))


def _known(_ctx: click.Context, _option: click.Parameter, names: tuple[str, ...]) -> tuple[str, ...]:
    for name in names:
        if problem := _unknown(name):
            raise click.BadParameter(problem)
    return names


def _unknown(name: str) -> str:
    """What is wrong with the name of a rule; empty where there is one."""
    from twinform.passes.framework.options import nearest  # noqa: PLC0415 - most names are those of rules

    try:
        return "" if find_rule(name) else f"no rule is called {name}{nearest(name, list(rules()))}"
    except RuleRegistryError as error:
        raise Unusable(str(error)) from error
