"""Which rules count for a file: selected, left out, or made errors, by the settings, a preset and the command line."""

from collections.abc import Mapping, Sequence

import click

from twinform.cli.command import Unusable
from twinform.cli.completion import rules_and_groups
from twinform.cli.config_defaults import Project, settings_of
from twinform.cli.config_file import ConfigError
from twinform.cli.flags import group
from twinform.cli.presets import PRESETS, preset_of, preset_option
from twinform.cli.rule_settings import RuleSettings
from twinform.diagnostics import Policy
from twinform.diagnostics.diagnostic import GROUPS
from twinform.diagnostics.rule_registry import RuleRegistryError, find_rule
from twinform.diagnostics.rule_registry import rules as known_rules
from twinform.diagnostics.sink import WARNINGS


def policy_of(ctx: click.Context, own: Sequence[RuleSettings] = ()) -> Policy:
    """Return the policy for a file: typed rules win over its `own` settings, and these over those of the project.

    Raises:
        ConfigError: the configuration names an unknown rule.
    """
    project, preset = settings_of(ctx), preset_of(ctx)
    typed = RuleSettings()._replace(**{name: ctx.params.get(name) or () for name in _OPTIONS})
    policy = configured_policy(project, own, Policy() if preset is None else override_policy(Policy(), preset.rules))
    return _override_consistently(policy, typed)


def configured_policy(project: Project, own: Sequence[RuleSettings], before: Policy) -> Policy:
    """Return the policy that a configuration has for a file with some settings of its own.

    Raises:
        ConfigError: it names an unknown rule.
        click.UsageError: a rule is left out and made an error.
    """
    policy = override_policy(before, PRESETS[project.preset].rules) if project.preset else before
    for rules in (project.rules, *own):
        for option, name in rules.named():
            if project.path and (problem := _problem_of(name, option)):
                raise ConfigError(project.path, problem, key=f"{rules.key}.{option}".removeprefix("."))
        policy = _override_consistently(policy, rules)
    return policy


def _override_consistently(before: Policy, rules: RuleSettings) -> Policy:
    """Add rules to a policy, or raise a `UsageError` if one of them is both left out and asked for."""
    left_out = {*rules.allow, *rules.ignore}
    for names, word in ((rules.deny, "denied"), ((*rules.select, *rules.extend_select), "selected")):
        both = sorted(left_out.intersection(names))
        if both:
            raise click.UsageError(f"{both[0]} is allowed and {word}")
    return override_policy(before, rules)


def override_policy(before: Policy, rules: RuleSettings) -> Policy:
    """Add rules to a policy, in which they win over the rules that it has."""
    left_out, asked = (*rules.allow, *rules.ignore), (*rules.deny, *rules.select, *rules.extend_select)
    allow, deny = _rules_of(left_out, but=asked), _rules_of(rules.deny, but=left_out)
    more = _rules_of(rules.extend_select, but=left_out)
    if rules.select:
        before = Policy(_rules_but(_rules_of(rules.select, but=left_out)), before.deny)
    return Policy((before.allow - deny - more) | allow, (before.deny - allow) | deny)


def _rules_but(selected: frozenset[str]) -> frozenset[str]:
    """Return the rules that are not selected, but for those because of which a file cannot be read at all."""
    return frozenset(name for name, each in known_rules().items() if not each.rule.fatal) - selected


def _rules_of(names: Sequence[str], *, but: Sequence[str]) -> frozenset[str]:
    """Return rules that are named by themselves or by their groups; `but` are named otherwise, and win over groups."""
    groups = {*GROUPS}.intersection(names)
    if not groups:
        return frozenset(names)
    others = {name for name, each in known_rules().items() if each.rule.group in groups}
    return frozenset({*names, *others}) - groups - ({*but} - {*names})


def _check_rules(_ctx: click.Context, option: click.Parameter, names: tuple[str, ...]) -> tuple[str, ...]:
    for name in names:
        if problem := _problem_of(name, option.name or ""):
            raise click.BadParameter(problem)
    return names


def _problem_of(name: str, option: str) -> str:
    """Say what is wrong with the name of a rule in an option; empty if nothing is."""
    if name in GROUPS or (name == WARNINGS and option == "deny"):
        return ""
    try:
        found = find_rule(name)
        if found is None:
            from difflib import get_close_matches  # noqa: PLC0415 - most names are those of rules

            near = get_close_matches(name, [*GROUPS, *known_rules()], n=1)
            words = f"did you mean {near[0]}?" if near else "`twinform explain` lists the rules"
            return f"no rule is called {name}; {words}"
    except RuleRegistryError as error:
        raise Unusable(str(error)) from error
    return ""


_OPTIONS: Mapping[str, tuple[tuple[str, ...], str]] = {
    "select": ((), "Report a rule or group, and leave out what is not selected"),
    "extend_select": ((), "Report a rule or group too, whatever the configuration says"),
    "allow": (("--ignore",), "Leave out findings of a rule or group"),
    "deny": ((), f"Make findings of a rule or group errors, or with '{WARNINGS}' all warnings"),
}
"""The options, with other names of theirs and their help; a configuration has them too."""
_rule_flags = tuple(
    click.option(
        f"--{name.replace('_', '-')}",
        *others,
        name,
        metavar="RULE",
        multiple=True,
        help=f"{text}; repeatable.",
        callback=_check_rules,
        shell_complete=rules_and_groups,
    )
    for name, (others, text) in _OPTIONS.items()
)
policy_options = group("rules", RuleSettings, preset_option, *_rule_flags)
"""Gives a command `--preset`, `--select`, `--extend-select`, `--allow` and `--deny`, which win over a configuration."""
