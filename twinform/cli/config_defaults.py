"""The settings of a project as defaults of options."""

from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from twinform.cli.command import combine_options
from twinform.cli.config_file import ConfigError, Searched, Table, section
from twinform.cli.presets import with_preset
from twinform.cli.rule_settings import RuleSettings
from twinform.cli.settings_of_files import OwnSettings, PerFile, parse_patterns
from twinform.dataclass import dataclass

if TYPE_CHECKING:
    from twinform.cli.presets import PresetName
    from twinform.passes import Names, Pipeline


_KEY = f"{__name__}.project"
_TRUSTED = f"{__name__}.trusted"
_NAMED = f"{__name__}.named"
TYPED = (ParameterSource.COMMANDLINE, ParameterSource.ENVIRONMENT)
"""Where the values of options come from that win over those of any configuration."""


@dataclass(frozen=True, slots=True)
class Project:
    """The settings of a project, and the file that they come from.

    Settings that are not `trusted` must not lead out of the folder of the file. Without a file, neither passes nor
    Pydantic are imported.
    """

    path: Path | None = None
    paths: Sequence[str] = ()
    rules: RuleSettings = RuleSettings()
    preset: "PresetName | None" = None
    pipelines: Sequence[str] = ()
    known: "Names | None" = None
    trusted: bool = False
    exclude: Sequence[str] | None = None
    extend_exclude: Sequence[str] = ()
    baseline: str | None = None
    per_file: PerFile | None = None
    sync: Mapping[str, Sequence[str]] = field(default_factory=dict[str, Sequence[str]])
    env: Sequence[str] = ()
    defaults: Mapping[str, object] = field(default_factory=dict[str, object])

    @classmethod
    def of(cls, path: Path, table: Table) -> "Project":
        """Make a project of the settings in a file.

        Raises:
            ConfigError: a key is unknown, or has a wrong value.
        """
        from twinform.cli.config_settings import NamedPipelines, parse_settings  # noqa: PLC0415 - many have no settings

        settings = parse_settings(path, table)
        for key, patterns in (("exclude", settings.exclude), ("extend-exclude", settings.extend_exclude)):
            if patterns:
                parse_patterns(path, patterns, key)
        return cls(
            path,
            settings.paths,
            settings.rules(),
            settings.preset,
            tuple(settings.pipelines),
            NamedPipelines(path, settings.pipelines),
            exclude=settings.exclude,
            extend_exclude=settings.extend_exclude,
            baseline=settings.baseline,
            per_file=PerFile(path, settings.files) if settings.files else None,
            sync=settings.sync,
            env=settings.env,
            defaults=settings.defaults,
        )

    @property
    def folders(self) -> Sequence[str]:
        """The folders in which models and packages are looked up.

        Raises:
            ConfigError: a folder is outside of the folder of the file.
        """
        if self.path is None or self.trusted or not self.paths:
            return self.paths
        from twinform.cli.config_trust import require_inside  # noqa: PLC0415 - few projects name folders

        for folder in self.paths:
            require_inside(self.path, Path(folder), "paths")
        return self.paths

    def robot_of(self, own: OwnSettings) -> str:
        """Return the file of the robot that a file is for; empty where its settings name none.

        Raises:
            ConfigError: it is outside of the folder of the configuration.
        """
        if self.path is None or own.robot is None:
            return ""
        name, key = own.robot
        if not self.trusted:
            from twinform.cli.config_trust import require_inside  # noqa: PLC0415 - few files name one

            require_inside(self.path, self.path.parent / name, key)
        return str(self.path.parent / name)

    @property
    def variables(self) -> Sequence[str]:
        """The environment variables that xacro files may read; only a trusted configuration names any."""
        # A configuration may have come with the xacro files, and name a secret for them. Ownership
        # proves nothing here: whoever unpacks an archive owns all that is in it.
        return self.env if self.trusted else ()

    @property
    def baseline_file(self) -> Path | None:
        """The file of the baseline, if there is one.

        Raises:
            ConfigError: it is outside of the folder of the configuration.
        """
        if self.path is None or self.baseline is None:
            return None
        file = self.path.parent / self.baseline
        if not self.trusted:
            from twinform.cli.config_trust import require_inside  # noqa: PLC0415 - few projects have one

            require_inside(self.path, file, "baseline")
        return file

    @property
    def synced(self) -> Mapping[str, Sequence[Path]]:
        """The files of each robot that are kept the same, the source first, by the names of the groups.

        Raises:
            ConfigError: a file is outside of the folder of the configuration.
        """
        if self.path is None or not self.sync:
            return {}
        folder = self.path.parent
        found = {name: [folder / each for each in files] for name, files in self.sync.items()}
        if not self.trusted:
            from twinform.cli.config_trust import require_inside  # noqa: PLC0415 - few projects have any

            for name, files in found.items():
                for file in files:
                    require_inside(self.path, file, f"sync.{name}")
        return found

    @property
    def names(self) -> "Names":
        """Returns a pipeline by its name, without asking whether it may be run."""
        from twinform.passes.framework.pipeline_text import no_names  # noqa: PLC0415 - few commands have pipelines

        return self.known or no_names

    def named(self, name: str) -> "Pipeline":
        """Return the pipeline of a name to run it.

        Raises:
            UnknownPipelineError: there is no such pipeline.
            ConfigError: it is wrong, or must not come from this file.
        """
        return self.confined(self.names(name), f"pipelines.{name}")

    def confined(self, pipeline: "Pipeline", key: str) -> "Pipeline":
        """Keep a pipeline that the file has under a key from reading other files, unless the file is trusted.

        Raises:
            ConfigError: the pipeline must not come from this file.
        """
        if self.path is None or self.trusted:
            return pipeline
        from twinform.cli.config_trust import confined  # noqa: PLC0415 - few commands have pipelines

        return confined(self.path, pipeline, key)


def settings_of(ctx: click.Context) -> Project:
    """Return the project of a command."""
    found = ctx.meta.get(_KEY)
    project = found if isinstance(found, Project) else Project()
    return replace(project, trusted=bool(ctx.meta.get(_TRUSTED)))


def counts_for_all(ctx: click.Context) -> bool:
    """Whether the command line says which configuration counts, so that those beside the files do not."""
    return bool(ctx.meta.get(_NAMED))


def context_for(ctx: click.Context, project: Project) -> click.Context:
    """Return the context that a command would have with another configuration, which nobody has said to trust.

    Raises:
        ConfigError: an option cannot have the value that the configuration gives it.
    """
    made = click.Context(ctx.command, info_name=ctx.info_name)
    made.meta.update(ctx.meta)
    made.meta[_KEY], made.meta[_TRUSTED] = project, False
    made.default_map = with_preset(ctx, project.defaults)
    for parameter in ctx.command.params:
        name = parameter.name or ""
        if name not in ctx.params:
            continue
        source = ctx.get_parameter_source(name)
        if source is not None and source in TYPED:
            made.params[name] = ctx.params[name]
            made.set_parameter_source(name, source)
            continue
        try:
            parameter.handle_parse_result(made, {}, [])
        except click.UsageError as error:
            raise ConfigError(project.path or Path(), error.message, key=name.replace("_", "-")) from error
    return made


def hold_limit(ctx: click.Context, option: click.Parameter, value: int, usual: int) -> int:
    """Return the value of a limit, which a configuration may only lower.

    Raises:
        ConfigError: a configuration that is not trusted raises it.
    """
    project = settings_of(ctx)
    configured = ctx.get_parameter_source(option.name or "") is ParameterSource.DEFAULT_MAP
    # A file that is too large may come with a configuration that allows it. This is an error, not a
    # warning: otherwise an error about the model would follow that does not say why.
    if configured and project.path is not None and not project.trusted:
        from twinform.cli.config_trust import require_lower  # noqa: PLC0415 - few projects have limits

        require_lower(project.path, (option.name or "").replace("_", "-"), value, usual)
    return value


def _section(path: Path) -> Table:
    found = section(path)
    if found is None:
        raise ConfigError(path, "there is no such table")
    return found


def _nearest() -> tuple[Path, Table] | None:
    try:
        return Searched().find(Path.cwd())
    except FileNotFoundError:
        return None  # the current folder is gone


def _use_none(ctx: click.Context, _option: click.Parameter, value: bool) -> None:
    if value:
        ctx.meta[_KEY], ctx.meta[_NAMED] = Project(), True
        ctx.default_map = with_preset(ctx, {})


def _trust(ctx: click.Context, _option: click.Parameter, value: bool) -> None:
    ctx.meta[_TRUSTED] = value


def _load(ctx: click.Context, _option: click.Parameter, value: Path | None) -> None:
    if _KEY in ctx.meta:
        if value is not None:
            raise click.UsageError("--config and --no-config contradict each other")
        return
    ctx.meta[_NAMED] = value is not None
    found = (value, _section(value)) if value is not None else _nearest()
    if found is None:
        return
    project = Project.of(*found)
    ctx.meta[_KEY] = project
    # Settings are defaults of options and nothing else, so whatever is given on the command line
    # wins. The Python API reads no configuration: a library whose results depend on the current
    # folder is a trap.
    ctx.default_map = with_preset(ctx, project.defaults)


config_options = combine_options(
    click.option(
        "--config",
        type=click.Path(exists=True, dir_okay=False, path_type=Path),
        is_eager=True,
        expose_value=False,
        callback=_load,
        help="The configuration of all files; else the nearest twinform.toml, or pyproject.toml with [tool.twinform].",
    ),
    click.option(
        "--no-config", is_flag=True, is_eager=True, expose_value=False, callback=_use_none, help="Use no configuration."
    ),
    click.option(
        "--trust-config",
        is_flag=True,
        is_eager=True,
        expose_value=False,
        callback=_trust,
        help="Let the configuration name other folders, variables, and passes that write files, and raise limits.",
    ),
)
"""Gives a command `--config FILE`, `--no-config` and `--trust-config`."""
