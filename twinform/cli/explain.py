"""`twinform explain`."""

from difflib import get_close_matches

import click

from twinform.cli.failure import Unusable
from twinform.cli.findings import heading
from twinform.diagnostics import Rule
from twinform.diagnostics.pages import sections, severity_words
from twinform.diagnostics.registry import OWN, RegisteredRule, RuleRegistryError, rules


@click.command("explain")
@click.argument("name", metavar="[RULE]", required=False)
def command(name: str | None) -> None:
    """Print the page of a rule, or list all rules."""
    known = _rules()
    if name is None:
        width = max(map(len, known))
        click.echo("\n".join(f"{key:{width}}  {severity_words(each.rule)}{_from(each)}" for key, each in known.items()))
        return
    if name not in known:
        near = get_close_matches(name, known, n=3, cutoff=0.5)
        hint = f"the nearest are {', '.join(near)}" if near else "`twinform explain` lists all"
        raise Unusable(f"no rule is called {name!r}; {hint}")
    click.echo(_page(known[name].rule, _from(known[name])))


def _rules() -> dict[str, RegisteredRule]:
    try:
        return rules()
    except RuleRegistryError as error:
        raise Unusable(str(error)) from error


def _from(registered: RegisteredRule) -> str:
    """Who brings a rule, if it is not one of ours."""
    return "" if registered.owner == OWN else f" (from {registered.owner})"


def _page(rule: Rule, origin: str) -> str:
    title = f"{heading(rule.name)} ({severity_words(rule)}){origin}"
    return "\n\n".join(
        [title, *(f"{heading(head)}\n{click.wrap_text(body, 100, '  ', '  ')}" for head, body in sections(rule))]
    )
