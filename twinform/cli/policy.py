"""`--allow` and `--deny`."""

from collections.abc import Sequence

import click

from twinform.cli.completion import rule_names
from twinform.cli.config import ConfigError, Project, settings_of
from twinform.cli.config.per_file import NO_OWN_SETTINGS, OwnSettings, RuleSettings
from twinform.cli.failure import Unusable
from twinform.cli.flags import group
from twinform.diagnostics import Policy
from twinform.diagnostics.rule_registry import RuleRegistryError, find_rule
from twinform.diagnostics.rule_registry import rules as known_rules


def policy_of(ctx: click.Context, typed: RuleSettings, own: OwnSettings = NO_OWN_SETTINGS) -> Policy:
    """The policy for a file, whose `own` settings go before those of the project, and what is typed before both.

    Raises:
        ConfigError: the configuration names a rule that there is not, or allows a fatal one.
    """
    project = settings_of(ctx)
    policy = Policy()
    for rules in (RuleSettings(project.allow, project.deny), *own.rules):
        _require_known(project, rules)
        policy = _over(policy, rules.allow, rules.deny)
    return _over(policy, typed.allow, typed.deny)


def _require_known(project: Project, rules: RuleSettings) -> None:
    for option, names in (("allow", rules.allow), ("deny", rules.deny)):
        for name in names:
            if project.path and (problem := _problem(name, option)):
                raise ConfigError(project.path, problem, key=f"{rules.key}.{option}".removeprefix("."))


def _over(before: Policy, allowed: Sequence[str], denied: Sequence[str]) -> Policy:
    """The policy with more rules, which go before those that it has."""
    allow, deny = frozenset(allowed), frozenset(denied)
    both = sorted(allow & deny)
    if both:
        raise click.UsageError(f"{both[0]} is allowed and denied")
    return Policy((before.allow - deny) | allow, (before.deny - allow) | deny)


def _known(_ctx: click.Context, option: click.Parameter, names: tuple[str, ...]) -> tuple[str, ...]:
    for name in names:
        if problem := _problem(name, option.name or ""):
            raise click.BadParameter(problem)
    return names


def _problem(name: str, option: str) -> str:
    """What is wrong with a rule of an option; empty where nothing is."""
    from twinform.passes.framework.pass_options import nearest  # noqa: PLC0415 - most names are those of rules

    try:
        found = find_rule(name)
        if found is None:
            return f"no rule is called {name}{nearest(name, list(known_rules()))}"
    except RuleRegistryError as error:
        raise Unusable(str(error)) from error
    return f"{name} is fatal, and cannot be allowed" if option == "allow" and found.rule.fatal else ""


policy_options = group(
    "rules",
    RuleSettings,
    *(
        click.option(
            f"--{name}",
            metavar="RULE",
            multiple=True,
            help=f"{text}; repeatable.",
            callback=_known,
            shell_complete=rule_names,
        )
        for name, text in (("allow", "Leave out findings of a rule"), ("deny", "Make findings of a rule errors"))
    ),
)
"""Gives a command `--allow` and `--deny`; what the configuration has comes in addition."""
