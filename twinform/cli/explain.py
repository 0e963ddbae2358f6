"""`twinform explain`."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

import click

from twinform.cli.command import Command, Unusable
from twinform.cli.completion import rule_names
from twinform.cli.printing import print_text, styled
from twinform.diagnostics import Rule
from twinform.diagnostics.catalog import rule_address
from twinform.diagnostics.did_you_mean import did_you_mean
from twinform.diagnostics.rule_page import sections, severity_words
from twinform.diagnostics.rule_registry import OWN, RegisteredRule, RuleRegistryError, find_rule, rules

if TYPE_CHECKING:
    from twinform.profiles import Assessment

EXAMPLES = {
    "Say what a rule finds, and what is better": "twinform explain dangling-link",
    "Say which programs read a mimic joint": "twinform explain joints/mimic",
}


@click.command("explain", cls=Command, examples=EXAMPLES)
@click.argument("name", metavar="[RULE]", required=False, shell_complete=rule_names)
def command(name: str | None) -> None:
    """Print the page of a rule, or who reads a feature; list all rules.

    A feature is one such as `joints/mimic`, which the help of a finding names.
    """
    if name is not None and "/" in name:
        print_text(_describe_feature(name))
        return
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


def _describe_feature(name: str) -> str:
    from twinform.compiler.advising import assess_file  # noqa: PLC0415 - most names are those of rules
    from twinform.compiler.input.load_options import LoadOptions  # noqa: PLC0415
    from twinform.profiles import every_release  # noqa: PLC0415
    from twinform.profiles.features import features  # noqa: PLC0415

    feature = features().get(name)
    if feature is None:
        raise Unusable(f"no feature is called {name!r}; {did_you_mean(name, features()) or 'the matrix lists all'}")
    told = [each for each in assess_file(feature.path, every_release(), LoadOptions()) if each.reads]
    said = [(each.profile.title, _describe_assessment(each), each.profile.release.name) for each in told]
    lines = [
        f"  {title} {_name_releases([release for _, _, release in alike])}: {words}"
        for (title, words), alike in groupby(said, lambda each: each[:2])
    ]
    title = f"{styled(feature.name)} ({feature.format})\n{feature.title}: {feature.question}"
    seen = f"{styled('What was measured')}\n  {feature.page}"
    return "\n\n".join([title, feature.text.rstrip(), "\n".join([styled("By their profiles"), *lines]), seen])


def _name_releases(names: Sequence[str]) -> str:
    return f"{names[0]} to {names[-1]}" if len(names) > 1 else names[0]


def _describe_assessment(told: "Assessment") -> str:
    words = dict.fromkeys(f"{each.row.effect}: {each.row.about}" for each in told.judgments)
    return "; ".join(words) or ("nothing is said against it" if told.profile.is_complete else "nothing is known")


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
