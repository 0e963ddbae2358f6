"""For tests of models, passes and rules: the case runner that this project tests itself with."""

from twinform.testing.cases import Case, CheckOptions, Finding, cases

__all__ = ["Case", "CheckOptions", "Finding", "cases"]
