"""Options of a conversion that several commands share: target format, version, passes."""

from collections.abc import Callable
from typing import Any, TypeVar

import click

from twinform.cli.completion import pipelines, sdf_versions
from twinform.cli.inputs import InputOptions
from twinform.cli.pipeline_option import pipeline_option
from twinform.compiler import URDF_VERSIONS, ConversionRequest, Language, UrdfVersion
from twinform.passes import Pipeline
from twinform.schemas import parse_version, versions_of

Command = TypeVar("Command", bound=Callable[..., Any])


def _known_version(_ctx: click.Context, _option: click.Parameter, value: str | None) -> str | None:
    if value is not None:
        _require_known(value)
    return value


def _known_versions(ctx: click.Context, _option: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...]:
    """The versions that are asked for, the newest first; else that of the configuration, if it has one."""
    configured = (ctx.default_map or {}).get("sdf_version")
    values = values or ((str(configured),) if configured else ())
    for value in values:
        _require_known(value)
    return tuple(sorted(set(values), key=parse_version, reverse=True))


def _require_known(version: str) -> None:
    versions = versions_of("sdf")
    if version not in versions:
        raise click.BadParameter(f"SDF has no version {version!r}; it has {', '.join(versions)}")


_ONE_VERSION = click.option(
    "--sdf-version",
    metavar="V",
    callback=_known_version,
    shell_complete=sdf_versions,
    help="The version of SDF to write.",
)
_SEVERAL_VERSIONS = click.option(
    "--sdf-version",
    "sdf_versions",
    metavar="V",
    multiple=True,
    callback=_known_versions,
    shell_complete=sdf_versions,
    help="A version of SDF to write; repeatable.",
)
_OPTIONS = (
    click.option("--urdf-version", type=click.Choice(URDF_VERSIONS), help="The version of URDF to write."),
    click.option(
        "--passes",
        metavar="PIPELINE",
        callback=pipeline_option("passes"),
        shell_complete=pipelines,
        help="Passes to run, such as 'check-inertia', or @NAME for one that the configuration names.",
    ),
    click.option(
        "--carriers/--no-carriers",
        default=True,
        help="Whether to keep what the target lacks in elements of tf:.",
    ),
    click.option("--comments/--no-comments", default=True, help="Whether comments of the source go along."),
)


def ordering_options(command: Command) -> Command:
    """Give a command the options that say what a file is to become."""
    return _with_options(command, _ONE_VERSION)


def ordering_options_of_versions(command: Command) -> Command:
    """The same, where SDF may be written in several versions."""
    return _with_options(command, _SEVERAL_VERSIONS)


def _with_options(command: Command, of_version: Callable[[Command], Command]) -> Command:
    for option in reversed(_OPTIONS):
        command = option(command)
    return of_version(command)


class Asked(InputOptions):
    """What these options, and those for reading, give a command."""

    sdf_version: str | None
    urdf_version: UrdfVersion | None
    passes: Pipeline | None
    carriers: bool
    comments: bool
    expand_includes: bool


def request_of(asked: Asked, to: Language, model: str | None = None) -> ConversionRequest:
    """The options as the compiler takes them."""
    return ConversionRequest(
        to=to,
        sdf_version=asked["sdf_version"],
        urdf_version=asked["urdf_version"],
        passes=asked["passes"] or Pipeline(),
        carriers=asked["carriers"],
        comments=asked["comments"],
        model=model,
        expand_includes=asked["expand_includes"],
    )
