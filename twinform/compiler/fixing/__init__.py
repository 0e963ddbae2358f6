"""Fixes of findings: what a rule offers to mend a file, and what applies it until nothing changes."""

from twinform.compiler.fixing.mending import Mended, Refused, mend, mend_by
from twinform.compiler.fixing.offering import with_fixes
from twinform.compiler.fixing.site import Fixer, Site

__all__ = ["Fixer", "Mended", "Refused", "Site", "mend", "mend_by", "with_fixes"]
