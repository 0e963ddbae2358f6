"""For tests of models, passes and rules: the case runner that this project tests itself with."""

from twinform.testing.cases import Case, Finding, cases

__all__ = ["Case", "Finding", "cases"]
