"""Which findings of `check` are about the same mistake as what a consumer cannot read: they are reported once."""

import re
from collections.abc import Iterable, Mapping

from twinform.diagnostics import Diagnostic
from twinform.profiles.reading import Shortfall

_ONCE = ("duplicate-name",)
_BODY = ("impossible-inertia", "indefinite-inertia", "non-positive-mass")
_WEIGHTLESS = ("missing-inertial", "non-positive-mass", "weightless-mover")
_LOOP = ("kinematic-loop", "two-parents", "no-links")
_MATERIAL = ("unknown-material", "bare-material", "unnamed-material", "conflicting-material")
# A consumer's table is about the text, and `check` about the model: both find a link that is there
# twice. Reported as the finding of `check`, it stands at the piece that is wrong, has its fixes,
# and a comment that allows it counts.
OF_FACTS: Mapping[str, tuple[str, ...]] = {
    "repeated-link": _ONCE,
    "repeated-link-but-world": _ONCE,
    "repeated-joint": _ONCE,
    "repeated-material": (*_ONCE, "conflicting-material"),
    "repeated-moving-joint": _ONCE,
    "repeated-shape": _ONCE,
    "repeated-collision": _ONCE,
    "reserved-name": ("reserved-name",),
    "shared-name": ("shared-name",),
    "empty-name": ("empty-name",),
    "self-joint": ("self-joint",),
    "unknown-leader": ("unknown-leader",),
    "stiff-mimic": ("unknown-leader",),
    "self-mimic": ("unknown-leader",),
    "idle-mimic": ("unknown-leader",),
    "idle-leader": ("unknown-leader",),
    "unknown-parent": ("dangling-link",),
    "unknown-child": ("dangling-link",),
    "unknown-parent-but-world": ("dangling-link",),
    "unknown-child-but-world": ("dangling-link",),
    "open-joint": ("missing-element", "missing-attribute"),
    "uncolored": _MATERIAL,
    "recolored": _MATERIAL,
    "nameless-color": _MATERIAL,
    "nowhere-material": _MATERIAL,
    "undefined-material": _MATERIAL,
    "plain-material": _MATERIAL,
    "unread-numbers": ("invalid-value",),
    "unknown-number": ("invalid-value",),
    "indefinite-inertia": _BODY,
    "unbalanced-inertia": _BODY,
    "unphysical-inertia": _BODY,
    "weightless-link": _WEIGHTLESS,
    "weightless-body": _WEIGHTLESS,
    "weightless-branch": _WEIGHTLESS,
    "nothing-left": _WEIGHTLESS,
    "endless-moment": _BODY,
    "foreign-end": ("dangling-link",),
    "loop": _LOOP,
    "unread-color": ("invalid-value",),
    "misplaced-element": ("unknown-element",),
    "strange-attribute": ("unknown-attribute",),
    "reversed-limits": ("lower-above-upper",),
    "swapped-limits": ("lower-above-upper",),
    "equal-limits": ("empty-range",),
    "foreign-transmission": ("foreign-transmission", "transmission-without-joint", "unknown-driven-joint"),
    "several-roots": ("several-roots",),
    "no-root": _LOOP,
    "two-parents": _LOOP,
    "circle": _LOOP,
    "no-links": ("no-links",),
}
"""The rules of `check`, by the names of facts."""
_OF_KINDS = {
    "value": frozenset({"invalid-value", "out-of-range", "tabbed-numbers", "missing-file"}),
    "absent": frozenset({"missing-attribute", "missing-element", "missing-part", "missing-limit", "missing-shape"}),
    "unread": frozenset({"unknown-attribute", "unknown-element", "repeated-element", "outside-version", "dialect"}),
}
"""The rules of `check`, by the kind of shortfall."""


class Counterparts:
    """What `check` has found in a file."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self._at_or_below: dict[str, list[Diagnostic]] = {}
        for each in diagnostics:
            path = each.location.path
            for end in (*(at.start() for at in re.finditer("/", path) if at.start()), len(path)):
                self._at_or_below.setdefault(path[:end], []).append(each)

    def of(self, shortfall: Shortfall) -> Diagnostic | None:
        """The finding about the same mistake, if there is one: in its place, or below the element of a fact."""
        known = self._at_or_below.get(shortfall.path, ())
        return next((each for each in known if _is_about(each, shortfall)), None)


def _is_about(finding: Diagnostic, shortfall: Shortfall) -> bool:
    name = finding.rule.name
    if shortfall.fact:
        return name in OF_FACTS.get(shortfall.fact, ())
    if name not in _OF_KINDS.get(shortfall.kind, ()) or finding.location.path != shortfall.path:
        return False
    return shortfall.kind != "absent" or (shortfall.expected or "") in finding.message
