"""Options that several commands share and a configuration may have, and their values for each file."""

from collections.abc import Callable, Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack, cast

import click
from click.core import ParameterSource

from twinform.cli.command import Unusable, combine_options
from twinform.cli.completion import consumers, pipelines, sdf_versions
from twinform.cli.config_defaults import TYPED, Project, settings_of
from twinform.cli.config_file import ConfigError
from twinform.cli.flags import flags_of, group
from twinform.cli.inputs import load_options_of
from twinform.cli.nearest_projects import ContextByFile
from twinform.cli.rule_options import policy_of
from twinform.cli.settings_of_files import NO_OWN_SETTINGS, OwnSettings
from twinform.compiler import LoadOptions
from twinform.compiler.input.load_options import FileOptions, ReadingOptions
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import Policy
from twinform.option import declared_options
from twinform.request_options import RequestOptions, known_sdf_version
from twinform.schemas import parse_version

if TYPE_CHECKING:
    from twinform.passes import Pipeline
    from twinform.profiles import Profile


class ResolvedOptions(NamedTuple):
    """The options for one file: how it is read, the policy on its findings, the passes to run, what it becomes."""

    load_options: LoadOptions
    policy: Policy
    passes: "Pipeline | None"
    request: RequestOptions


@dataclass(slots=True)
class OptionsByFile:
    """Resolves the options for each file by its configuration; files share what is known of folders.

    `option` is the name of the option for the passes, and `asked` are the folders whose models are asked for, and
    `unsaved` has the texts of files that an editor has. `usual`
    are the options of a file without settings of its own.
    """

    ctx: click.Context
    arguments: Mapping[str, str]
    option: str = "passes"
    asked: "tuple[Path, ...]" = ()
    unsaved: Mapping[str, bytes] = field(default_factory=dict[str, bytes])
    usual: ResolvedOptions = field(init=False)
    _contexts: ContextByFile = field(init=False)
    _known: dict[click.Context, ResolvedOptions] = field(init=False)
    _searches: dict[SearchPath, SearchPath] = field(init=False)

    def __post_init__(self) -> None:
        self._contexts, self._known, self._searches = ContextByFile(self.ctx), {}, {}
        self.usual = self._usual_in(self.ctx)

    def of(self, name: str) -> ResolvedOptions:
        """Return the options for a file.

        Raises:
            ConfigError: its settings are wrong.
        """
        return self._resolve_in(self.context_of(name), name)

    def context_of(self, name: str) -> click.Context:
        """Return the context of the command with the settings of a file's project.

        Raises:
            ConfigError: they are wrong.
        """
        return self._contexts.of(name)

    def unless_wrong(self, name: str) -> tuple[ResolvedOptions, ConfigError | None]:
        """Return the options for a file, or those without any configuration where the nearest one is wrong.

        Raises:
            ConfigError: the configuration of the run is wrong.
        """
        try:
            return self.of(name), None
        except ConfigError as error:
            if error.file == settings_of(self.ctx).path:
                raise
            return self._usual_in(self._contexts.without_settings()), error

    def baseline_of(self, name: str) -> Path | None:
        """Return the baseline that the configuration of a file names; None if there is none, or it is wrong."""
        try:
            return settings_of(self._contexts.of(name)).baseline_file
        except ConfigError as error:
            if error.file == settings_of(self.ctx).path:
                raise
            return None

    def _resolve_in(self, ctx: click.Context, name: str) -> ResolvedOptions:
        usual, per_file = self._usual_in(ctx), settings_of(ctx).per_file
        own = per_file.of(name) if per_file else NO_OWN_SETTINGS
        return usual if own is NO_OWN_SETTINGS else self._apply(ctx, usual, own)

    def _usual_in(self, ctx: click.Context) -> ResolvedOptions:
        if ctx not in self._known:
            policy = policy_of(ctx)
            load_options = load_options_of(
                self.arguments,
                cast("FileOptions", params_of(ctx, FileOptions)),
                policy,
                ctx.params.get("profiles") or (),
                project=settings_of(ctx),
            )
            search = load_options.search
            if self.asked or self.unsaved:
                search = replace(search, asked=self.asked, unsaved=self.unsaved)
            robot = str(ctx.params.get("robot") or "")
            load_options = replace(load_options, robot=robot, search=self._searches.setdefault(search, search))
            request = cast("RequestOptions", params_of(ctx, RequestOptions))
            self._known[ctx] = ResolvedOptions(load_options, policy, ctx.params.get(self.option), request)
        return self._known[ctx]

    def _apply(self, ctx: click.Context, usual: ResolvedOptions, own: OwnSettings) -> ResolvedOptions:
        policy = policy_of(ctx, own.rules)
        load_options = replace(usual.load_options, arguments={**own.arguments, **self.arguments}, allow=policy.allow)
        if own.strict is not None and not self._is_typed("strict"):
            load_options = replace(load_options, strict=own.strict)
        if not self._is_typed("robot"):
            load_options = replace(load_options, robot=settings_of(ctx).robot_of(own))
        configured = own.check_passes if self.option == "check_passes" else own.passes
        passes = usual.passes
        if configured is not None and not self._is_typed(self.option):
            text, key = configured
            passes = configured_pipeline(settings_of(ctx), text, key) if text else None
        return usual._replace(load_options=load_options, policy=policy, passes=passes)

    def _is_typed(self, option: str) -> bool:
        return self.ctx.get_parameter_source(option) in TYPED


def params_of(ctx: click.Context, options: type) -> dict[str, Any]:
    """Return the values that a command has for the options of a typed dictionary."""
    return {name: ctx.params[name] for name in declared_options(options) if name in ctx.params}


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


consumers_option = click.option(
    "--for",
    "profiles",
    metavar="NAME,...",
    callback=_parse_consumers,
    shell_complete=consumers,
    help="Who reads the files, such as drake,mujoco, urdfdom@jazzy, or portable for all.",
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
request_options_of_many = group("request", dict, *flags_of(RequestOptions, without=["keep_paths"], passes=_PIPELINE))
"""Gives a command the same options for many files, whose results are a copy of their folder, with paths as they are."""
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
    group("request", dict, *flags_of(RequestOptions, without=["sdf_version", "keep_paths"], passes=_PIPELINE)),
)
"""Gives a command the same options, but for several versions of SDF."""


def whole_request(request: RequestOptions, reading: ReadingOptions, **more: Unpack[RequestOptions]) -> RequestOptions:
    """Complete the options of what a file becomes with those that a command has elsewhere."""
    return {**request, "expand_includes": reading.get("expand_includes") or False, **more}
