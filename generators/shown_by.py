"""Finds which feature shows what a row of a profile is about.

All features are assessed by all profiles. Of several that show the same, the one counts about which least is said.
"""

import json
from collections.abc import Iterator

from testbed.markdown import grouped
from twinform.compiler.advising import assess_file
from twinform.compiler.input.load_options import LoadOptions
from twinform.profiles import every_release
from twinform.profiles.features import PLAIN, Feature, features, strip_predicates

_Key = tuple[str, str, str]


def table() -> str:
    """The rows of `shown_by.json` by what they are about: a rule, a path and a feature each."""
    of_every_robot = said_of(features()[PLAIN])
    told = {each.name: said_of(each) - of_every_robot for each in features().values() if each.name != PLAIN}
    told[PLAIN] = of_every_robot
    shown: dict[_Key, str] = {}
    for name in sorted(told, key=lambda name: (len(told[name]), name)):
        for key in told[name]:
            shown.setdefault(key, name)
    by_about = grouped((about, (rule, path, shown[about, rule, path])) for about, rule, path in sorted(shown))
    return "{\n" + ",\n".join(_lines(by_about)) + "\n}\n"


def _lines(by_about: dict[str, list[tuple[str, str, str]]]) -> Iterator[str]:
    for about, rows in by_about.items():
        yield f"{json.dumps(about)}: {json.dumps(rows)}"


def said_of(feature: Feature) -> set[_Key]:
    """What the rows of all profiles say of a feature: what they are about, the rule and the path."""
    return {
        (judgment.row.about, judgment.row.rule, strip_predicates(judgment.finding.location.path))
        for each in assess_file(feature.path, every_release(), LoadOptions())
        for judgment in each.judgments
    }
