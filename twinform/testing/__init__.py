"""For tests of models, passes and rules: the case runners that this project tests itself with."""

from twinform.testing.cases import Case, CheckOptions, Finding, cases
from twinform.testing.pass_cases import PassCase, pass_cases

__all__ = ["Case", "CheckOptions", "Finding", "PassCase", "cases", "pass_cases"]
