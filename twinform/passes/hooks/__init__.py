"""What can be known of passes without their help: how long they take, what they change, how their faults come again."""

from twinform.passes.hooks.dumps import Dumps
from twinform.passes.hooks.printing import PrintChanges
from twinform.passes.hooks.reproducer import Reproducer
from twinform.passes.hooks.statistics import PassRecord, Statistics
from twinform.passes.hooks.table import table

__all__ = ["Dumps", "PassRecord", "PrintChanges", "Reproducer", "Statistics", "table"]
