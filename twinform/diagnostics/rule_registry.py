"""The rules that are installed: ours, and those that other packages bring through an entry-point group."""

from collections.abc import Iterable
from functools import cache
from typing import TYPE_CHECKING

from twinform.dataclass import dataclass
from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.diagnostic import Rule

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "twinform.rules"
OWN = "twinform"


class RuleRegistryError(Exception):
    """The installed rules contradict each other or themselves; the message names the package to blame."""


@dataclass(frozen=True, slots=True)
class RegisteredRule:
    """A rule and `owner`, the distribution that brings it."""

    rule: Rule
    owner: str


@cache
def rules() -> dict[str, RegisteredRule]:
    """Every rule that is installed, sorted by name.

    Raises:
        RuleRegistryError: two have one name, or one is not as it should be.
    """
    from importlib.metadata import entry_points  # noqa: PLC0415 - few commands look at every package

    # Built-in rules do not come through entry points: a rule is an object that its pass imports,
    # and two hundred lines of entry points would be a second list to keep true.
    return collect_rules(catalog().values(), entry_points(group=GROUP))


def find_rule(name: str) -> RegisteredRule | None:
    """An installed rule. A built-in one is found without a look at other packages.

    Raises:
        RuleRegistryError: there is no built-in one of this name, and others contradict each other.
    """
    own = catalog().get(name)
    return RegisteredRule(own, OWN) if own else rules().get(name)


def collect_rules(own: Iterable[Rule], entries: "Iterable[EntryPoint]") -> dict[str, RegisteredRule]:
    """Our own rules and those of these entry points, sorted by name.

    Raises:
        RuleRegistryError: two have one name, or one is not as it should be.
    """
    found: dict[str, RegisteredRule] = {}
    strangers = sorted(map(_load, entries), key=lambda each: (each.rule.name, each.owner))
    for each in (*(RegisteredRule(rule, OWN) for rule in own), *strangers):
        name = each.rule.name
        if name in found:
            raise RuleRegistryError(f"{found[name].owner} and {each.owner} both register a rule called {name}")
        found[name] = each
    return dict(sorted(found.items()))


def _load(entry: "EntryPoint") -> RegisteredRule:
    owner = entry.dist.name if entry.dist else "an unknown distribution"
    try:
        rule: object = entry.load()
    except (ImportError, AttributeError) as error:
        message = f"{owner} registers the rule {entry.name} but it cannot be imported: {error}"
        raise RuleRegistryError(message) from error
    if not isinstance(rule, Rule):
        raise RuleRegistryError(f"{owner} registers the rule {entry.name} but {entry.value} is no Rule")
    if rule.name != entry.name:
        raise RuleRegistryError(f"{owner} registers the rule {entry.name} but {entry.value} calls itself {rule.name}")
    return RegisteredRule(rule, owner)
