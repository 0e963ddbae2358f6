"""Options that take a pipeline of passes."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from twinform.cli.config import ConfigError, Project, settings_of
from twinform.cli.failure import Unusable

if TYPE_CHECKING:
    from twinform.passes import Pipeline


def pipeline_option(key: str) -> "Callable[[click.Context, click.Parameter, str | None], Pipeline | None]":
    """The callback of an option that takes a pipeline, which is `key` in a configuration; None where none is asked for.

    Where none is, nothing of passes is imported.
    """

    def parse(ctx: click.Context, option: click.Parameter, value: str | None) -> "Pipeline | None":
        return _parsed(ctx, option, value, key) if value else None

    return parse


def configured_pipeline(project: Project, value: str, key: str) -> "Pipeline":
    """The pipeline that a configuration has under a key.

    Raises:
        ConfigError: it is none, or must not come from there.
    """
    from twinform.passes import PipelineError, RegistryError, parse_pipeline  # noqa: PLC0415 - few files have their own

    try:
        return project.confined(parse_pipeline(value, names=project.named), key)
    except PipelineError as error:
        raise ConfigError(project.path or Path(), str(error), key=key) from error
    except RegistryError as error:
        raise Unusable(str(error)) from error


def _parsed(ctx: click.Context, option: click.Parameter, value: str, key: str) -> "Pipeline":
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
