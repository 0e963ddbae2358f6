"""`twinform explain`."""

from collections.abc import Iterable, Iterator, Mapping

import click

from twinform.cli.command import Command, Unusable
from twinform.cli.completion import rule_names
from twinform.cli.printing import print_text, styled
from twinform.diagnostics import Rule
from twinform.diagnostics.catalog import rule_address
from twinform.diagnostics.rule_registry import OWN, RegisteredRule, RuleRegistryError, find_rule, rules
from twinform.diagnostics.rules_page import sections, severity_words

EXAMPLES = {
    "Say what a rule finds, and what is better": "twinform explain dangling-link",
}


@click.command("explain", cls=Command, examples=EXAMPLES)
@click.argument("name", metavar="[RULE]", required=False, shell_complete=rule_names)
def command(name: str | None) -> None:
    """Print the page of a rule, or list all rules."""
    try:
        if name is None:
            _list(rules())
            return
        found = find_rule(name)
        if found is None:
            raise Unusable(_describe_unknown(name, rules()))
    except RuleRegistryError as error:
        raise Unusable(str(error)) from error
    print_text(_page(found.rule, _origin(found)))


def _list(known: Mapping[str, RegisteredRule]) -> None:
    width = max(map(len, known))
    print_text("\n".join(f"{key:{width}}  {severity_words(each.rule)}{_origin(each)}" for key, each in known.items()))


def _describe_unknown(name: str, known: Iterable[str]) -> str:
    from difflib import get_close_matches  # noqa: PLC0415 - most names are those of rules

    near = get_close_matches(name, list(known), n=3, cutoff=0.5)
    hint = f"the nearest are {', '.join(near)}" if near else "`twinform explain` lists all"
    return f"no rule is called {name!r}; {hint}"


def _origin(registered: RegisteredRule) -> str:
    """Name the package of a rule that is not our own."""
    return "" if registered.owner == OWN else f" (from {registered.owner})"


def _parts(rule: Rule) -> Iterator[tuple[str, str]]:
    yield from sections(rule)
    address = rule_address(rule.name)
    if address:
        yield "More", address


def _page(rule: Rule, origin: str) -> str:
    title = f"{styled(rule.name)} ({severity_words(rule)}){origin}"
    texts = ((head, click.wrap_text(body, 100, "  ", "  ", preserve_paragraphs=True)) for head, body in _parts(rule))
    return "\n\n".join([title, *(f"{styled(head)}\n{text}" for head, text in texts)])
