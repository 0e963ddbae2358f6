"""Settings of a project as defaults of options, and settings of single files in it."""

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import click

from twinform.cli.command import combine_options
from twinform.cli.config_file import ConfigError, Table, find, section
from twinform.dataclass import dataclass

if TYPE_CHECKING:
    from twinform.cli.config_settings import ProjectSettings
    from twinform.passes import Names, Pipeline


_KEY = f"{__name__}.project"
_TRUSTED = f"{__name__}.trusted"


@dataclass(frozen=True, slots=True)
class Project:
    """The settings of a project, and the file that they come from.

    Settings that are not `trusted` must not lead out of the folder of the file. Without a file, neither passes nor
    Pydantic are imported.
    """

    path: Path | None = None
    paths: Sequence[str] = ()
    allow: Sequence[str] = ()
    deny: Sequence[str] = ()
    pipelines: Sequence[str] = ()
    known: "Names | None" = None
    trusted: bool = False
    exclude: Sequence[str] | None = None
    extend_exclude: Sequence[str] = ()
    baseline: str | None = None
    per_file: "PerFile | None" = None
    env: Sequence[str] = ()

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


def hold_limit(ctx: click.Context, option: click.Parameter, value: int, usual: int) -> int:
    """Return the value of a limit, which a configuration may only lower.

    Raises:
        ConfigError: a configuration that is not trusted raises it.
    """
    project = settings_of(ctx)
    configured = ctx.get_parameter_source(option.name or "") is click.core.ParameterSource.DEFAULT_MAP
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
        return find(Path.cwd())
    except FileNotFoundError:
        return None  # the current folder is gone


def _per_file(path: Path, settings: "ProjectSettings") -> "PerFile | None":
    if not settings.files:
        return None

    return PerFile(path, settings.files)


def _use_none(ctx: click.Context, _option: click.Parameter, value: bool) -> None:
    if value:
        ctx.meta[_KEY] = Project()
        ctx.default_map = {}


def _trust(ctx: click.Context, _option: click.Parameter, value: bool) -> None:
    ctx.meta[_TRUSTED] = value


def _load(ctx: click.Context, _option: click.Parameter, value: Path | None) -> None:
    if _KEY in ctx.meta:
        if value is not None:
            raise click.UsageError("--config and --no-config contradict each other")
        return
    found = (value, _section(value)) if value is not None else _nearest()
    if found is None:
        return
    from twinform.cli.config_settings import NamedPipelines, parse_settings  # noqa: PLC0415 - many have no settings

    path, table = found
    settings = parse_settings(path, table)
    names = NamedPipelines(path, settings.pipelines)
    ctx.meta[_KEY] = Project(
        path,
        settings.paths,
        settings.allow,
        settings.deny,
        tuple(settings.pipelines),
        names,
        exclude=settings.exclude,
        extend_exclude=settings.extend_exclude,
        baseline=settings.baseline,
        per_file=_per_file(path, settings),
        env=settings.env,
    )
    # Settings are defaults of options and nothing else, so whatever is given on the command line
    # wins. The Python API reads no configuration: a library whose results depend on the current
    # folder is a trap.
    ctx.default_map = dict(settings.defaults)


config_options = combine_options(
    click.option(
        "--config",
        type=click.Path(exists=True, dir_okay=False, path_type=Path),
        is_eager=True,
        expose_value=False,
        callback=_load,
        help="The configuration; else the nearest twinform.toml, or pyproject.toml with [tool.twinform].",
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


Value = TypeVar("Value")

if TYPE_CHECKING:
    from twinform.cli.config_settings import FileSettings


class RuleSettings(NamedTuple):
    """The rules that a table of the configuration allows and denies, and the key of the table."""

    allow: Sequence[str]
    deny: Sequence[str]
    key: str = ""


@dataclass(frozen=True, slots=True)
class OwnSettings:
    """The settings of one file beyond those of the project; None if a setting is not given.

    Pipelines have the key that they come from, and rules are listed table by table.
    """

    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    strict: bool | None = None
    passes: tuple[str, str] | None = None
    check_passes: tuple[str, str] | None = None
    rules: Sequence[RuleSettings] = ()


NO_OWN_SETTINGS = OwnSettings()


class PerFile:
    """The tables `[[files]]` of a configuration; of several that fit a file, the last one wins."""

    def __init__(self, path: Path, tables: Sequence["FileSettings"]) -> None:
        """Take the tables of the configuration at a path.

        Raises:
            ConfigError: a pattern is invalid.
        """
        from twinform.cli.path_patterns import PathPatterns, PatternError  # noqa: PLC0415 - few projects have tables

        self.tables: list[tuple[str, PathPatterns, FileSettings]] = []
        for number, table in enumerate(tables):
            key = f"files[{number}]"
            try:
                self.tables.append((key, PathPatterns.of(path.parent, table.match), table))
            except PatternError as error:
                raise ConfigError(path, str(error), key=f"{key}.match") from error

    def of(self, name: str) -> OwnSettings:
        """Return the settings of a file."""
        path = os.path.abspath(name)  # noqa: PTH100 - links stay links
        fitting = [(key, table) for key, patterns, table in self.tables if patterns.match(path)]
        if not fitting:
            return NO_OWN_SETTINGS
        return OwnSettings(
            arguments={name: _xacro_text(value) for _, table in fitting for name, value in table.arguments.items()},
            strict=_last_given(table.strict for _, table in fitting),
            passes=_last_given((table.passes, f"{key}.passes") for key, table in fitting if table.passes is not None),
            check_passes=_last_given(
                (table.check_passes, f"{key}.check-passes") for key, table in fitting if table.check_passes is not None
            ),
            rules=[RuleSettings(table.allow, table.deny, key) for key, table in fitting],
        )


def _last_given(values: Iterable[Value | None]) -> Value | None:
    """Return the last value that is set; None if none is."""
    return next((each for each in reversed([*values]) if each is not None), None)


def _xacro_text(value: str | float | bool) -> str:
    """Write a value as xacro does."""
    return str(value).lower() if isinstance(value, bool) else str(value)
