"""One finding for a misspelt element or attribute and for the part that is therefore missing."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

from twinform.diagnostics import Diagnostic, rules
from twinform.diagnostics.did_you_mean import meant_name

_UNKNOWN = {rules.UNKNOWN_ELEMENT: "<{}>", rules.UNKNOWN_ATTRIBUTE: "@{}"}
"""How findings about missing parts write what is expected, by the rule of the misspelt one."""


def join_misspelt_parts(found: Sequence[Diagnostic]) -> Sequence[Diagnostic]:
    """Return findings in which a misspelt part stands for those that miss it, as bad as the worst of them.

    `<limits>` in a joint is one mistake, and not an unknown element and a joint without limits.
    """
    if not any(each.rule in _UNKNOWN for each in found):
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
    return [joined.get(id(each), each) for each in found if id(each) not in dropped]


def _joined(unknown: Diagnostic, missing: Sequence[Diagnostic]) -> Diagnostic:
    worst = max(missing, key=lambda each: each.severity)
    return replace(
        unknown,
        message=f"{unknown.message}, and {worst.message}",
        severity=max(unknown.severity, worst.severity),
        refused=unknown.refused or any(each.refused for each in missing),
    )
