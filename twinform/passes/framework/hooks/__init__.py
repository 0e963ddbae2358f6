"""Instrumentation hooks: timing, statistics and changes of passes.

`reproducer.py`, which is about their faults, is imported where there is one.
"""

from twinform.passes.framework.hooks.dumps import Dumps
from twinform.passes.framework.hooks.printing import PrintChanges
from twinform.passes.framework.hooks.statistics import PassRecord, Statistics
from twinform.passes.framework.hooks.table import table

__all__ = ["Dumps", "PassRecord", "PrintChanges", "Statistics", "table"]
