"""What the shell is offered to complete: files, rules, passes, pipelines, versions, and who reads a file."""

import os
from collections.abc import Callable, Iterable, Iterator

import click
from click.shell_completion import CompletionItem


def files(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete files, which the shell knows."""
    return [CompletionItem(incomplete, type="file")]


def rule_names(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete rules, with what they find."""
    from twinform.diagnostics.rule_registry import rules  # noqa: PLC0415 - it reads entry points

    known = {name: each.rule.finds for name, each in rules().items() if name.startswith(incomplete)}
    return [CompletionItem(name, help=finds.partition(". ")[0]) for name, finds in known.items()]


def rules_and_groups(ctx: click.Context, parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete rules and their groups."""
    from twinform.diagnostics.diagnostic import GROUPS  # noqa: PLC0415 - as in `rule_names`

    found = [CompletionItem(each, help=f"All rules of the group {each}") for each in GROUPS]
    return [*(each for each in found if each.value.startswith(incomplete)), *rule_names(ctx, parameter, incomplete)]


def pass_names(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete passes."""
    from twinform.passes import registered_passes  # noqa: PLC0415 - it reads entry points

    return [CompletionItem(name) for name in registered_passes() if name.startswith(incomplete)]


def pipelines(ctx: click.Context, parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the last pass of a pipeline, or a pipeline that the configuration names."""
    from twinform.cli.config_defaults import settings_of  # noqa: PLC0415 - few calls complete a pipeline

    def last_steps(last: str) -> Iterator[str]:
        yield from (str(each.value) for each in pass_names(ctx, parameter, last))
        yield from (f"@{name}" for name in settings_of(ctx).pipelines)

    return _last_of_list(incomplete, last_steps)


def consumers(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the last name in a list of consumers, and after `@` its release."""
    from twinform.profiles import names  # noqa: PLC0415 - only a shell that completes needs them
    from twinform.profiles.profile import PORTABLE, releases_of  # noqa: PLC0415 - see above

    def last_names(last: str) -> Iterator[str]:
        consumer, at, _ = last.partition("@")
        if not at or consumer == PORTABLE or consumer not in names():
            return iter(names())
        return (f"{consumer}@{name}" for each in releases_of(consumer) for name in each.names)

    return _last_of_list(incomplete, last_names)


def _last_of_list(incomplete: str, proposals: Callable[[str], Iterable[str]]) -> list[CompletionItem]:
    """Complete the last of words with commas between, given all that may begin as it does."""
    before, comma, last = incomplete.rpartition(",")
    if comma and os.environ.get("_TWINFORM_COMPLETE") == "fish_complete":
        return []  # click's script for fish ends a word at a comma
    return [CompletionItem(before + comma + each) for each in proposals(last) if each.startswith(last)]


def sdf_versions(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete versions of SDF."""
    from twinform.schemas import versions_of  # noqa: PLC0415 - it reads the tables

    return [CompletionItem(each) for each in versions_of("sdf") if each.startswith(incomplete)]
