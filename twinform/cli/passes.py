"""`twinform passes`."""

from collections.abc import Collection, Iterator

import click

from twinform.cli.failure import Unusable
from twinform.cli.findings import heading
from twinform.passes import Pass, Registered, RegistryError, registered_passes
from twinform.passes.pages import OptionPage, description, options


@click.command("passes")
@click.argument("name", required=False)
def command(name: str | None) -> None:
    """List the passes, or print the page of one."""
    try:
        found = registered_passes()
        if name is None:
            click.echo("\n".join(_list(found.values())))
        elif name in found:
            click.echo("\n\n".join(_page(found[name].load(), found[name].owner)))
        else:
            raise Unusable(f"no pass is called {name!r}; there are {', '.join(found)}")
    except RegistryError as error:
        raise Unusable(str(error)) from error


def _list(found: Collection[Registered]) -> Iterator[str]:
    width = max((len(each.name) for each in found), default=0)
    for each in found:
        summary = description(each.load()).partition("\n")[0]
        yield f"{each.name:{width}}  {summary}{'' if each.owner == 'twinform' else f' (from {each.owner})'}"


def _page(kind: type[Pass], owner: str) -> Iterator[str]:
    yield f"{heading(kind.name)} (from {owner})"
    yield description(kind)
    rows = list(options(kind))
    if rows:
        yield "\n".join([heading("Options"), *map(_row, rows)])
    if kind.example:
        yield f"{heading('Example')}\n  {kind.example}"


def _row(option: OptionPage) -> str:
    return f"  {option.name}: {option.type} (default: {option.default})\n      {option.text}"
