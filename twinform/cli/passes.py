"""`twinform passes`."""

import json
from collections.abc import Collection, Iterator
from typing import Literal

import click

from twinform.cli.command import Command, Unusable
from twinform.cli.completion import pass_names, pipelines
from twinform.cli.config_defaults import Project, config_options, settings_of
from twinform.cli.printing import print_document, print_text, styled
from twinform.passes import Pass, PipelineError, Registered, RegistryError, parse_pipeline, registered_passes
from twinform.passes.framework.pass_options import nearest
from twinform.passes.framework.pass_page import OptionPage, description, options, summary
from twinform.passes.framework.pass_registry import OWN
from twinform.passes.framework.pipeline_text import print_tables

_TABLE_NAME = "mine"


EXAMPLES = {
    "List all passes": "twinform passes",
    "Print the page of one": "twinform passes fill-limits",
    "A pipeline as the table of a configuration": "twinform passes --table 'fill-limits{effort=100},check-inertia'",
}


@click.command("passes", cls=Command, examples=EXAMPLES)
@click.argument("name", required=False, shell_complete=pass_names)
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print them.")
@click.option(
    "--table",
    metavar="PIPELINE",
    shell_complete=pipelines,
    help="Print a pipeline as the table that a configuration would have.",
)
@config_options
@click.pass_context
def command(ctx: click.Context, name: str | None, style: Literal["text", "json"], table: str | None) -> None:
    """List the passes, or print the page of one.

    Lists their options with defaults, an example of each, and the pipelines that the configuration names.
    """
    project = settings_of(ctx)
    try:
        if table is not None:
            print_document(print_tables(parse_pipeline(table, names=project.names), _TABLE_NAME))
            return
        found = _find_passes(name)
        if style == "json":
            print_document(f"{_json(found, project)}\n")
        elif name is None:
            print_text("\n".join([*_list_passes(found), *_list_pipelines(project)]))
        else:
            print_text("\n\n".join(_page(found[0].load(), found[0].owner)))
    except PipelineError as error:
        raise click.BadParameter(str(error), ctx, param_hint="--table") from error
    except RegistryError as error:
        raise Unusable(str(error)) from error


def _find_passes(name: str | None) -> list[Registered]:
    found = registered_passes()
    if name is None:
        return list(found.values())
    if name not in found:
        raise Unusable(f"no pass is called {name!r}{nearest(name, list(found))}")
    return [found[name]]


def _list_passes(found: Collection[Registered]) -> Iterator[str]:
    for each in found:
        kind = each.load()
        yield f"{styled(each.name)}{'' if each.owner == OWN else f' (from {each.owner})'}"
        yield f"    {summary(kind)}"
        words = ", ".join(map(_describe_option, options(kind)))
        if words:
            yield click.wrap_text(f"options: {words}", 110, "    ", "      ")
        yield f"    example: {kind.example}"


def _describe_option(option: OptionPage) -> str:
    """Write an option with its default, if it has one."""
    if not option.given:
        return f"{option.name} (needed)"
    return option.name if option.value is None else f"{option.name}={option.default}"


def _list_pipelines(project: Project) -> Iterator[str]:
    names = project.pipelines
    if names:
        yield f"\npipelines of {project.path}"
    for name in names:
        yield f"{styled(f'@{name}')}\n    {project.names(name)}"


def _page(kind: type[Pass], owner: str) -> Iterator[str]:
    yield f"{styled(kind.name)} (from {owner})"
    yield description(kind)
    rows = list(options(kind))
    if rows:
        yield "\n".join([styled("Options"), *map(_row, rows)])
    if kind.example:
        yield f"{styled('Example')}\n  {kind.example}"


def _row(option: OptionPage) -> str:
    return f"  {option.name}: {option.type} (default: {option.default})\n      {option.text}"


def _json(found: Collection[Registered], project: Project) -> str:
    pipelines = [{"name": name, "pipeline": str(project.names(name))} for name in project.pipelines]
    return json.dumps(
        {"passes": [_object(each.load(), each.owner) for each in found], "pipelines": pipelines}, indent=2
    )


def _object(kind: type[Pass], owner: str) -> dict[str, object]:
    return {
        "name": kind.name,
        "owner": owner,
        "summary": summary(kind),
        "description": description(kind),
        "options": [
            {
                "name": option.name,
                "type": option.type,
                "required": not option.given,
                "default": option.value,
                "description": option.text,
            }
            for option in options(kind)
        ],
        "example": kind.example,
    }
