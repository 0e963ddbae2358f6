"""Options that several commands share and a configuration may have: rules, pipelines, consumers, version, carriers."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, Unpack, cast

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

from twinform.cli.command import Unusable, combine_options
from twinform.cli.completion import pipelines, rule_names, sdf_versions
from twinform.cli.config_defaults import NO_OWN_SETTINGS, OwnSettings, Project, RuleSettings, settings_of
from twinform.cli.config_file import ConfigError
from twinform.cli.flags import flags_of, group
from twinform.cli.inputs import load_options_of
from twinform.compiler import LoadOptions
from twinform.compiler.input.load_options import FileOptions, ReadingOptions
from twinform.dataclass import dataclass
from twinform.diagnostics import Policy
from twinform.diagnostics.diagnostic import GROUPS
from twinform.diagnostics.rule_registry import RuleRegistryError, find_rule
from twinform.diagnostics.rule_registry import rules as known_rules
from twinform.request_options import RequestOptions, known_sdf_version
from twinform.schemas import parse_version

if TYPE_CHECKING:
    from twinform.passes import Pipeline
    from twinform.profiles import Profile


_TYPED = (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT)


class ResolvedOptions(NamedTuple):
    """The options for one file: how it is read, the policy on its findings, and the passes to run."""

    load_options: LoadOptions
    policy: Policy
    passes: "Pipeline | None"


@dataclass(slots=True)
class OptionsByFile:
    """Resolves the options for each file; all share the search path, with what it knows of folders.

    `option` is the name of the option for the passes. `profiles` are those of the consumers of the files. `asked` are
    the folders whose models are asked for. `usual` are the options of a file without settings of its own.
    """

    ctx: click.Context
    arguments: Mapping[str, str]
    reading: FileOptions
    rules: RuleSettings
    passes: "Pipeline | None"
    option: str = "passes"
    profiles: "tuple[Profile, ...]" = ()
    asked: "tuple[Path, ...]" = ()
    usual: ResolvedOptions = field(init=False)

    def __post_init__(self) -> None:
        policy = policy_of(self.ctx, self.rules)
        load_options = load_options_of(self.arguments, self.reading, policy, self.profiles)
        if self.asked:
            load_options = replace(load_options, search=replace(load_options.search, asked=self.asked))
        self.usual = ResolvedOptions(load_options, policy, self.passes)

    def of(self, name: str) -> ResolvedOptions:
        """Return the options for a file.

        Raises:
            ConfigError: its settings are wrong.
        """
        per_file = settings_of(self.ctx).per_file
        own = per_file.of(name) if per_file else NO_OWN_SETTINGS
        return self.usual if own is NO_OWN_SETTINGS else self._apply(own)

    def _apply(self, own: OwnSettings) -> ResolvedOptions:
        policy = policy_of(self.ctx, self.rules, own)
        load_options = replace(
            self.usual.load_options, arguments={**own.arguments, **self.arguments}, allow=policy.allow
        )
        if own.strict is not None and not self._is_typed("strict"):
            load_options = replace(load_options, strict=own.strict)
        configured = own.check_passes if self.option == "check_passes" else own.passes
        if configured is None or self._is_typed(self.option):
            return ResolvedOptions(load_options, policy, self.usual.passes)
        text, key = configured
        passes = configured_pipeline(settings_of(self.ctx), text, key) if text else None
        return ResolvedOptions(load_options, policy, passes)

    def _is_typed(self, option: str) -> bool:
        return self.ctx.get_parameter_source(option) in _TYPED


def policy_of(ctx: click.Context, typed: RuleSettings, own: OwnSettings = NO_OWN_SETTINGS) -> Policy:
    """Return the policy for a file: typed rules win over its `own` settings, and these over those of the project.

    Raises:
        ConfigError: the configuration names an unknown rule.
    """
    project = settings_of(ctx)
    policy = Policy()
    for rules in (RuleSettings(project.allow, project.deny), *own.rules):
        _require_known(project, rules)
        policy = _override_consistently(policy, rules)
    return _override_consistently(policy, typed)


def _override_consistently(before: Policy, rules: RuleSettings) -> Policy:
    """Add rules to a policy, or raise a `UsageError` if one of them is both allowed and denied."""
    both = sorted({*rules.allow} & {*rules.deny})
    if both:
        raise click.UsageError(f"{both[0]} is allowed and denied")
    return override_policy(before, rules)


def _require_known(project: Project, rules: RuleSettings) -> None:
    for option, names in (("allow", rules.allow), ("deny", rules.deny)):
        for name in names:
            if project.path and (problem := _rule_problem(name, option)):
                raise ConfigError(project.path, problem, key=f"{rules.key}.{option}".removeprefix("."))


def override_policy(before: Policy, rules: RuleSettings) -> Policy:
    """Add rules to a policy, in which they win over the rules that it has."""
    allow, deny = _rules_of(rules.allow, but=rules.deny), _rules_of(rules.deny, but=rules.allow)
    return Policy((before.allow - deny) | allow, (before.deny - allow) | deny)


def _rules_of(names: Sequence[str], *, but: Sequence[str]) -> frozenset[str]:
    """Return rules that are named by themselves or by their groups; `but` are named otherwise, and win over groups."""
    groups = {*GROUPS}.intersection(names)
    if not groups:
        return frozenset(names)
    others = {name for name, each in known_rules().items() if each.rule.group in groups}
    return frozenset({*names, *others}) - groups - ({*but} - {*names})


def _check_rules(_ctx: click.Context, option: click.Parameter, names: tuple[str, ...]) -> tuple[str, ...]:
    for name in names:
        if problem := _rule_problem(name, option.name or ""):
            raise click.BadParameter(problem)
    return names


def _rule_problem(name: str, option: str) -> str:
    """Say what is wrong with a rule in `allow` or `deny`; empty if nothing is."""
    if name in GROUPS:
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


_POLICIES = (
    (("--allow", "--ignore", "allow"), "Leave out findings of a rule or group"),
    (("--deny",), "Make findings of a rule or group errors"),
)
policy_options = group(
    "rules",
    RuleSettings,
    *(
        click.option(
            *names,
            metavar="RULE",
            multiple=True,
            help=f"{text}; repeatable.",
            callback=_check_rules,
            shell_complete=rule_names,
        )
        for names, text in _POLICIES
    ),
)
"""Gives a command `--allow` and `--deny`, which add to the rules of the configuration."""


def pipeline_option(key: str) -> "Callable[[click.Context, click.Parameter, str | None], Pipeline | None]":
    """Make the callback of an option that takes a pipeline, whose key in a configuration is `key`."""

    def parse(ctx: click.Context, option: click.Parameter, value: str | None) -> "Pipeline | None":
        return _parse_pipeline(ctx, option, value, key) if value else None  # without one, no pass is imported

    return parse


def configured_pipeline(project: Project, value: str, key: str) -> "Pipeline":
    """Parse the pipeline that a configuration has under a key.

    Raises:
        ConfigError: it is no pipeline, or must not come from this configuration.
    """
    from twinform.passes import PipelineError, RegistryError, parse_pipeline  # noqa: PLC0415 - few files have their own

    try:
        return project.confined(parse_pipeline(value, names=project.named), key)
    except PipelineError as error:
        raise ConfigError(project.path or Path(), str(error), key=key) from error
    except RegistryError as error:
        raise Unusable(str(error)) from error


def _parse_pipeline(ctx: click.Context, option: click.Parameter, value: str, key: str) -> "Pipeline":
    from twinform.passes import PipelineError, RegistryError, parse_pipeline  # noqa: PLC0415 - see above

    project = settings_of(ctx)
    if ctx.get_parameter_source(option.name or "") is ParameterSource.DEFAULT_MAP:
        return configured_pipeline(project, value, key)
    try:
        return parse_pipeline(value, names=project.named)
    except PipelineError as error:
        raise click.BadParameter(str(error)) from error
    except RegistryError as error:
        raise Unusable(str(error)) from error


def _parse_consumers(ctx: click.Context, option: click.Parameter, value: str | None) -> "tuple[Profile, ...]":
    """Return the profiles of consumers."""
    if not value:
        return ()
    from twinform.profiles import UnknownProfileError, parse  # noqa: PLC0415 - most files are for nobody by name

    try:
        # a consumer of the configuration that does not read a format is left out for it
        configured = ctx.get_parameter_source(option.name or "") is ParameterSource.DEFAULT_MAP
        return tuple(replace(each, named=each.named and not configured) for each in parse(value))
    except UnknownProfileError as error:
        raise click.BadParameter(str(error)) from error


def _complete_consumers(_ctx: click.Context, _option: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the last name in a list of consumers."""
    from twinform.profiles import names  # noqa: PLC0415 - only a shell that completes needs them

    before, comma, begun = incomplete.rpartition(",")
    return [CompletionItem(f"{before}{comma}{name}") for name in names() if name.startswith(begun)]


consumers_option = click.option(
    "--for",
    "profiles",
    metavar="NAME,...",
    callback=_parse_consumers,
    shell_complete=_complete_consumers,
    help="Who reads the files, such as drake,mujoco, gazebo@harmonic, or portable for all.",
)
keep_physics_option = click.option(
    "--keep-physics", is_flag=True, help="With --for: refuse passes that change masses, inertias, joints or limits."
)


def _known_versions(ctx: click.Context, _option: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...]:
    """Return the versions that are asked for, the newest first, or else the version of the configuration."""
    configured = (ctx.default_map or {}).get("sdf_version")
    values = values or ((str(configured),) if configured else ())
    try:
        values = tuple(map(known_sdf_version, values))
    except ValueError as error:
        raise click.BadParameter(str(error)) from error
    return tuple(sorted(set(values), key=parse_version, reverse=True))


_PIPELINE = {"callback": pipeline_option("passes"), "shell_complete": pipelines}

request_options = group("request", dict, *flags_of(RequestOptions, passes=_PIPELINE))
"""Gives a command the options of what a file becomes."""
request_options_of_versions = combine_options(
    click.option(
        "--sdf-version",
        "sdf_versions",
        metavar="V",
        multiple=True,
        callback=_known_versions,
        shell_complete=sdf_versions,
        help="A version of SDF to write; repeatable.",
    ),
    group("request", dict, *flags_of(RequestOptions, without=["sdf_version"], passes=_PIPELINE)),
)
"""Gives a command the same options, but for several versions of SDF."""


def passes_of(request: RequestOptions) -> "Pipeline | None":
    """Return the pipeline of a request, which the command line has parsed."""
    return cast("Pipeline | None", request.get("passes"))


def whole_request(request: RequestOptions, reading: ReadingOptions, **more: Unpack[RequestOptions]) -> RequestOptions:
    """Complete the options of what a file becomes with those that a command has elsewhere."""
    return {**request, "expand_includes": reading.get("expand_includes") or False, **more}
