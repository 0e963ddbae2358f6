"""The sections of a report as HTML, one file for each."""

from collections.abc import Callable
from typing import NamedTuple

from twinform.report.content import ModelReport
from twinform.report.markup import Markup
from twinform.report.sections.conversion_section import conversion
from twinform.report.sections.differences import differences
from twinform.report.sections.findings_section import findings
from twinform.report.sections.masses import masses
from twinform.report.sections.meshes_section import meshes
from twinform.report.sections.reach import reach
from twinform.report.sections.statistics import statistics
from twinform.report.sections.tree_section import tree
from twinform.report.sections.view import view


class Section(NamedTuple):
    """A section: its anchor, its heading, and what makes its content; None where there is nothing to say."""

    anchor: str
    title: str
    content: Callable[[ModelReport], Markup | None]


SECTIONS = (
    Section("differences", "Differences", differences),
    Section("view", "3D view", view),
    Section("findings", "Findings", findings),
    Section("tree", "Links and joints", tree),
    Section("conversion", "Conversion", conversion),
    Section("statistics", "Statistics", statistics),
    Section("masses", "Masses and inertias", masses),
    Section("reach", "Reach", reach),
    Section("meshes", "Meshes", meshes),
)
