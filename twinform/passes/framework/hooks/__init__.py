"""Instrumentation hooks: timing, statistics and changes of passes.

`reproducer.py`, which is about their faults, is imported where there is one.
"""

from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.passes.framework.hooks.dumps import Dumps
    from twinform.passes.framework.hooks.printing import PrintChanges
    from twinform.passes.framework.hooks.statistics import PassRecord, Statistics
    from twinform.passes.framework.hooks.table import table
else:
    __getattr__ = lazy_attributes(
        __name__,
        {
            "twinform.passes.framework.hooks.dumps": "Dumps",
            "twinform.passes.framework.hooks.printing": "PrintChanges",
            "twinform.passes.framework.hooks.statistics": "PassRecord Statistics",
            "twinform.passes.framework.hooks.table": "table",
        },
    )

__all__ = ["Dumps", "PassRecord", "PrintChanges", "Statistics", "table"]
