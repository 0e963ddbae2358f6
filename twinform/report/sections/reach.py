"""How far links are from the root, and can be."""

import math

from twinform.report.content import ModelReport
from twinform.report.html_parts import Cell, bar, number, table
from twinform.report.markup import Markup
from twinform.report.reach import reaches

_HEADS = ("Link", "At zero (m)", "At most (m)", "From 0 to the furthest")


def reach(report: ModelReport) -> Markup | None:
    """A table that can be sorted, with a bar for each link."""
    found = reaches(report.first.scene) if report.first.scene else ()
    most = max((each.most if math.isfinite(each.most) else each.zero for each in found), default=0.0)
    if not most:
        return None
    caption = (
        "Distances of link frames from the root of their tree: with every joint at zero (dark), and along all joints "
        "between, as if they were stretched (pale), which is a bound"
    )
    rows = (
        (each.link, number(each.zero), number(each.most), Cell(bar(each.zero, most, min(each.most, most)), each.most))
        for each in found
    )
    return table(caption, _HEADS, rows, sortable=True)
