"""`--config`: the settings of a project become the defaults of options."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from twinform.cli.config.config_error import ConfigError
from twinform.cli.config.config_file import Table, find, section

if TYPE_CHECKING:
    from twinform.cli.config.per_file import PerFile
    from twinform.cli.config.settings import ProjectSettings
    from twinform.passes import Names, Pipeline

Command = TypeVar("Command", bound=Callable[..., Any])
_KEY = f"{__name__}.project"
_TRUSTED = f"{__name__}.trusted"


@dataclass(frozen=True, slots=True)
class Project:
    """The settings that are in force, the file that they come from, and the pipelines that it names.

    What is not `trusted` must not lead out of the folder of the file. Nothing here needs passes or Pydantic where there
    is no such file.
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
        """The folders to look in.

        Raises:
            ConfigError: one leads out of that of the file.
        """
        if self.path is None or self.trusted or not self.paths:
            return self.paths
        from twinform.cli.config.trust import require_inside  # noqa: PLC0415 - few projects name folders

        for folder in self.paths:
            require_inside(self.path, Path(folder), "paths")
        return self.paths

    @property
    def variables(self) -> Sequence[str]:
        """The environment variables that xacro files may read.

        Only a trusted file names any: it may have come with the xacro files, and name a secret for them.
        """
        # Ownership proves nothing here: whoever unpacks an archive owns all that is in it.
        return self.env if self.trusted else ()

    @property
    def baseline_file(self) -> Path | None:
        """The file of the baseline, if there is one.

        Raises:
            ConfigError: it leads out of the folder of the file.
        """
        if self.path is None or self.baseline is None:
            return None
        file = self.path.parent / self.baseline
        if not self.trusted:
            from twinform.cli.config.trust import require_inside  # noqa: PLC0415 - few projects have one

            require_inside(self.path, file, "baseline")
        return file

    @property
    def names(self) -> "Names":
        """Knows the pipelines, whoever may run them."""
        from twinform.passes.framework.pipeline_text import no_names  # noqa: PLC0415 - few commands have pipelines

        return self.known or no_names

    def named(self, name: str) -> "Pipeline":
        """The pipeline of a name, to be run.

        Raises:
            UnknownPipelineError: there is none.
            ConfigError: the text in the file is no pipeline, or none that may come from it.
        """
        return self.confined(self.names(name), f"pipelines.{name}")

    def confined(self, pipeline: "Pipeline", key: str) -> "Pipeline":
        """A pipeline that the file has under a key, to be run.

        Raises:
            ConfigError: it must not come from this file.
        """
        if self.path is None or self.trusted:
            return pipeline
        from twinform.cli.config.trust import confined  # noqa: PLC0415 - few commands have pipelines

        return confined(self.path, pipeline, key)


def config_options(command: Command) -> Command:
    """Give a command `--config FILE`, `--no-config` and `--trust-config`."""
    command = click.option(
        "--trust-config",
        is_flag=True,
        is_eager=True,
        expose_value=False,
        callback=_trust,
        help="Let the configuration name other folders, variables, and passes that write files, and raise limits.",
    )(command)
    command = click.option(
        "--no-config", is_flag=True, is_eager=True, expose_value=False, callback=_none, help="Use no configuration."
    )(command)
    return click.option(
        "--config",
        type=click.Path(exists=True, dir_okay=False, path_type=Path),
        is_eager=True,
        expose_value=False,
        callback=_load,
        help="The configuration; else the nearest twinform.toml, or pyproject.toml with [tool.twinform].",
    )(command)


def settings_of(ctx: click.Context) -> Project:
    """The project of a command that has these options."""
    found = ctx.meta.get(_KEY)
    project = found if isinstance(found, Project) else Project()
    return replace(project, trusted=bool(ctx.meta.get(_TRUSTED)))


def hold_limit(ctx: click.Context, option: click.Parameter, value: int, usual: int) -> int:
    """The value of an option that is a limit, which a configuration may lower.

    Raises:
        ConfigError: it comes from a configuration that raises it.
    """
    project = settings_of(ctx)
    configured = ctx.get_parameter_source(option.name or "") is click.core.ParameterSource.DEFAULT_MAP
    # A file that is too large and a configuration that allows it come in one download. This is an
    # error and no warning: what would follow is an error about the model that does not say why.
    if configured and project.path is not None and not project.trusted:
        from twinform.cli.config.trust import require_lower  # noqa: PLC0415 - few projects have limits

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
    from twinform.cli.config.per_file import PerFile  # noqa: PLC0415 - few projects have such tables

    return PerFile(path, settings.files)


def _none(ctx: click.Context, _option: click.Parameter, value: bool) -> None:
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
    from twinform.cli.config.pipelines import NamedPipelines  # noqa: PLC0415 - many projects have no settings
    from twinform.cli.config.settings import parse_settings  # noqa: PLC0415 - see above

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
