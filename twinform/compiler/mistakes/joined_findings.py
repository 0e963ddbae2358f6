"""One finding for one fault: a misspelt part and what is missing without it, a joint that is there twice."""

from collections import defaultdict
from collections.abc import Collection, Sequence
from dataclasses import replace

from twinform.diagnostics import Diagnostic, Location, Rule, rules
from twinform.diagnostics.did_you_mean import meant_name

_UNKNOWN = {rules.UNKNOWN_ELEMENT: "<{}>", rules.UNKNOWN_ATTRIBUTE: "@{}"}
"""How findings about missing parts write what is expected, by the rule of the misspelt one."""


def join_findings(found: Sequence[Diagnostic]) -> Sequence[Diagnostic]:
    """Return findings in which a misspelt part stands for those that miss it, as bad as the worst of them.

    `<limits>` in a joint is one mistake, and not an unknown element and a joint without limits.
    """
    if not any(each.rule in _UNKNOWN or each.rule is rules.DUPLICATE_NAME for each in found):
        return found
    missing: dict[tuple[str, str, str], list[Diagnostic]] = defaultdict(list)
    for each in found:
        if each.expected and each.rule not in _UNKNOWN:
            missing[each.location.file, each.location.path, each.expected].append(each)
    joined: dict[int, Diagnostic] = {}
    dropped: set[int] = set()
    for each in found:
        name = meant_name(each.help) if each.rule in _UNKNOWN else None
        if name:
            around = each.location.path.rpartition("/")[0]
            same = missing.pop((each.location.file, around, _UNKNOWN[each.rule].format(name)), [])
            dropped.update(map(id, same))
            joined[id(each)] = _joined(each, same) if same else each
    said = {(each.rule, each.location) for each in found}
    dropped.update(id(each) for each in found if _is_said(each, said))
    # a macro that is called a third time defines its names a second time too often, at the same place
    last = {(each.message, each.location): id(each) for each in found if each.rule is rules.DUPLICATE_NAME}
    dropped.update(
        id(each)
        for each in found
        if each.rule is rules.DUPLICATE_NAME and last[each.message, each.location] != id(each)
    )
    return [joined.get(id(each), each) for each in found if id(each) not in dropped]


def _is_said(finding: Diagnostic, said: Collection[tuple[Rule, Location]]) -> bool:
    """Whether another finding says what is wrong: a joint that is defined twice, or a value where URDF has it."""
    if finding.rule is rules.TWO_PARENTS:
        return (rules.DUPLICATE_NAME, finding.location) in said
    element = finding.location._replace(path=finding.location.path.removesuffix("/@value"))
    return finding.rule is rules.UNKNOWN_ATTRIBUTE and (rules.BLANK_VALUE, element) in said


def _joined(unknown: Diagnostic, missing: Sequence[Diagnostic]) -> Diagnostic:
    worst = max(missing, key=lambda each: each.severity)
    return replace(
        unknown,
        message=f"{unknown.message}, and {worst.message}",
        severity=max(unknown.severity, worst.severity),
        refused=unknown.refused or any(each.refused for each in missing),
    )
