"""Fixes of findings: the edits that rules offer, and how they are applied until nothing changes."""

from twinform.compiler.fixing.fix_rounds import (
    ANOTHER_ROBOT,
    FixResult,
    Refused,
    Texts,
    apply_fixes,
    apply_fixes_by,
    new_rules,
)
from twinform.compiler.fixing.offering import with_fixes
from twinform.compiler.fixing.site import FindingSite, Fixer

__all__ = [
    "ANOTHER_ROBOT",
    "FindingSite",
    "FixResult",
    "Fixer",
    "Refused",
    "Texts",
    "apply_fixes",
    "apply_fixes_by",
    "new_rules",
    "with_fixes",
]
