"""Options of conversions that several commands share: version, passes, carriers and the like."""

from typing import TYPE_CHECKING, Unpack, cast

import click

from twinform.cli.command import combine_options
from twinform.cli.completion import pipelines, sdf_versions
from twinform.cli.flags import flags_of, group
from twinform.cli.project_options import pipeline_option
from twinform.compiler.input.load_options import ReadingOptions
from twinform.request_options import RequestOptions, known_sdf_version
from twinform.schemas import parse_version

if TYPE_CHECKING:
    from twinform.passes import Pipeline


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
