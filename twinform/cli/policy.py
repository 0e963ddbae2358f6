"""`--allow` and `--deny`."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeVar

import click

from twinform.cli.config import ConfigError, Project, settings_of
from twinform.cli.config.per_file import NO_OWN_SETTINGS, OwnSettings
from twinform.cli.failure import Unusable
from twinform.diagnostics import Policy
from twinform.diagnostics.registry import RuleRegistryError, find_rule, rules

Command = TypeVar("Command", bound=Callable[..., Any])


def policy_options(command: Command) -> Command:
    """Give a command `--allow` and `--deny`; what the configuration has comes in addition."""
    for name, text in (("deny", "Make findings of a rule errors"), ("allow", "Leave out findings of a rule")):
        command = click.option(
            f"--{name}", metavar="RULE", multiple=True, help=f"{text}; repeatable.", callback=_known
        )(command)
    return command


def policy_of(
    ctx: click.Context, allow: Sequence[str], deny: Sequence[str], own: OwnSettings = NO_OWN_SETTINGS
) -> Policy:
    """The policy for a file, whose `own` settings go before those of the project, and options before both.

    Raises:
        ConfigError: the configuration names a rule that there is not, or allows a fatal one.
    """
    project = settings_of(ctx)
    configured = _Layer([(each, "allow") for each in project.allow], [(each, "deny") for each in project.deny])
    policy = Policy()
    for layer in (configured, _Layer(own.allow, own.deny)):
        layer.require_known(project)
        policy = _over(policy, layer.names)
    return _over(policy, (frozenset(allow), frozenset(deny)))


class _Layer(NamedTuple):
    """Rules of a configuration that are allowed and denied, each with its key."""

    allow: Sequence[tuple[str, str]]
    deny: Sequence[tuple[str, str]]

    @property
    def names(self) -> tuple[frozenset[str], frozenset[str]]:
        return frozenset(name for name, _ in self.allow), frozenset(name for name, _ in self.deny)

    def require_known(self, project: Project) -> None:
        for option, names in (("allow", self.allow), ("deny", self.deny)):
            for name, key in names:
                if project.path and (problem := _problem(name, option)):
                    raise ConfigError(project.path, problem, key=key)


def _over(before: Policy, names: tuple[frozenset[str], frozenset[str]]) -> Policy:
    """The policy with more rules, which go before those that it has."""
    allow, deny = names
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
    from twinform.passes.framework.options import nearest  # noqa: PLC0415 - most names are those of rules

    try:
        found = find_rule(name)
        if found is None:
            return f"no rule is called {name}{nearest(name, list(rules()))}"
    except RuleRegistryError as error:
        raise Unusable(str(error)) from error
    return f"{name} is fatal, and cannot be allowed" if option == "allow" and found.rule.fatal else ""
