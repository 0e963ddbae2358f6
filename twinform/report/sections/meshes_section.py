"""Mesh files, and how many triangles they cost."""

from twinform.compiler.statistics import MeshCost
from twinform.report.content import ModelReport
from twinform.report.html_parts import Cell, bar, table
from twinform.report.markup import Markup, Part

_HEADS = ("File", "Triangles", "Of the largest", "Bytes", "Visuals", "Collisions", "Remark")


def meshes(report: ModelReport) -> Markup | None:
    """A table that can be sorted, with a bar for the triangles of each."""
    costs = report.first.meshes
    most = max((each.triangles or 0 for each in costs), default=0)
    rows = (_row(each, most) for each in costs)
    return table("Mesh files, and the triangles in them", _HEADS, rows, sortable=True) if costs else None


def _row(each: MeshCost, most: int) -> tuple[Cell | Part, ...]:
    return (
        each.uri,
        _whole(each.triangles),
        Cell(bar(each.triangles or 0, most), each.triangles),
        _whole(each.bytes),
        _whole(each.visuals),
        _whole(each.collisions),
        each.problem,
    )


def _whole(value: int | None) -> Cell:
    return Cell(None if value is None else f"{value:,}", value)
