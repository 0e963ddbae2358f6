"""Options of a conversion that several commands share: target format, version, passes."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar, Unpack, cast

import click

from twinform.cli.completion import pipelines, sdf_versions
from twinform.cli.flags import flags_of, group
from twinform.cli.pipeline_option import pipeline_option
from twinform.compiler.input.load_options import ReadingOptions
from twinform.compiler.request_options import RequestOptions, known_sdf_version
from twinform.schemas import parse_version

if TYPE_CHECKING:
    from twinform.passes import Pipeline

Command = TypeVar("Command", bound=Callable[..., Any])


def _known_versions(ctx: click.Context, _option: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...]:
    """The versions that are asked for, the newest first; else that of the configuration, if it has one."""
    configured = (ctx.default_map or {}).get("sdf_version")
    values = values or ((str(configured),) if configured else ())
    try:
        values = tuple(map(known_sdf_version, values))
    except ValueError as error:
        raise click.BadParameter(str(error)) from error
    return tuple(sorted(set(values), key=parse_version, reverse=True))


_PIPELINE = {"callback": pipeline_option("passes"), "shell_complete": pipelines}
_SEVERAL_VERSIONS = click.option(
    "--sdf-version",
    "sdf_versions",
    metavar="V",
    multiple=True,
    callback=_known_versions,
    shell_complete=sdf_versions,
    help="A version of SDF to write; repeatable.",
)
request_options = group("request", dict, *flags_of(RequestOptions, passes=_PIPELINE))
"""Gives a command the options that say what a file is to become."""
_of_versions = group("request", dict, *flags_of(RequestOptions, without=["sdf_version"], passes=_PIPELINE))


def request_options_of_versions(command: Command) -> Command:
    """Give a command the same, where SDF may be written in several versions."""
    return _SEVERAL_VERSIONS(_of_versions(command))


def passes_of(request: RequestOptions) -> "Pipeline | None":
    """The pipeline that was typed or configured, which the command line has parsed."""
    return cast("Pipeline | None", request.get("passes"))


def whole_request(request: RequestOptions, reading: ReadingOptions, **more: Unpack[RequestOptions]) -> RequestOptions:
    """The options on what a file becomes, with those that a command has elsewhere."""
    return {**request, "expand_includes": reading.get("expand_includes") or False, **more}
