"""Options that take a pipeline of passes."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from twinform.cli.config import ConfigError, settings_of
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


def _parsed(ctx: click.Context, option: click.Parameter, value: str, key: str) -> "Pipeline":
    from twinform.passes import PipelineError, RegistryError, parse_pipeline  # noqa: PLC0415 - see above

    project = settings_of(ctx)
    configured = ctx.get_parameter_source(option.name or "") is ParameterSource.DEFAULT_MAP
    try:
        pipeline = parse_pipeline(value, names=project.named)
        return project.confined(pipeline, key) if configured else pipeline
    except PipelineError as error:
        if project.path and configured:
            raise ConfigError(project.path, str(error), key=key) from error
        raise click.BadParameter(str(error)) from error
    except RegistryError as error:
        raise Unusable(str(error)) from error
