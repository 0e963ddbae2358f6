"""`twinform explain`."""

from difflib import get_close_matches

import click

from twinform.cli.failure import Unusable
from twinform.cli.findings import heading
from twinform.diagnostics import Rule, catalogue
from twinform.diagnostics.pages import sections, severity_words


@click.command("explain")
@click.argument("name", metavar="[RULE]", required=False)
def command(name: str | None) -> None:
    """Print the page of a rule, or list all rules."""
    rules = catalogue()
    if name is None:
        width = max(map(len, rules))
        click.echo("\n".join(f"{rule.name:{width}}  {severity_words(rule)}" for rule in rules.values()))
        return
    if name not in rules:
        near = get_close_matches(name, rules, n=3, cutoff=0.5)
        hint = f"the nearest are {', '.join(near)}" if near else "`twinform explain` lists all"
        raise Unusable(f"no rule is called {name!r}; {hint}")
    click.echo(_page(rules[name]))


def _page(rule: Rule) -> str:
    title = f"{heading(rule.name)} ({severity_words(rule)})"
    return "\n\n".join(
        [title, *(f"{heading(head)}\n{click.wrap_text(body, 100, '  ', '  ')}" for head, body in sections(rule))]
    )
