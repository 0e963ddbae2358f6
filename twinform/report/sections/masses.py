"""Masses, centers of mass and inertias of all links, with a bar for each mass."""

from twinform.compiler.scene import SceneLink
from twinform.report.content import ModelReport
from twinform.report.html_parts import Cell, bar, number, table
from twinform.report.markup import Markup, Part, element

_HEADS = (
    "Link", "Mass (kg)", "Share of the heaviest", "x (m)", "y (m)", "z (m)", "ixx", "iyy", "izz", "ixy", "ixz", "iyz",
)  # fmt: skip
_MOMENTS = 6
_SUMMED = 2


def masses(report: ModelReport) -> Markup | None:
    """A table that can be sorted; the inertias are in kg m^2."""
    links = report.first.scene.links if report.first.scene else ()
    if not any(link.mass for link in links):
        return None
    heaviest = max(link.mass.mass for link in links if link.mass)
    whole = sum(link.mass.mass for link in links if link.mass)
    cells = element("th", "Together", scope="row"), element("td", f"{whole:.6g}", class_="number")
    total = element("tr", *cells, element("td", colspan=len(_HEADS) - _SUMMED))
    caption = (
        "Masses, centers of mass, and inertias in kg m\N{SUPERSCRIPT TWO} about these, in the axes of the link. "
        "Links without a mass have no number."
    )
    return table(caption, _HEADS, (_row(link, heaviest) for link in links), sortable=True, total=total)


def _row(link: SceneLink, heaviest: float) -> tuple[Cell | Part, ...]:
    solid = link.mass
    if solid is None:
        return (link.name, *([Cell(None)] * (len(_HEADS) - 1)))
    moments = (number(each) for each in solid.inertia[:_MOMENTS])
    share = Cell(bar(solid.mass, heaviest), solid.mass)
    return (link.name, number(solid.mass), share, *map(number, solid.center), *moments)
