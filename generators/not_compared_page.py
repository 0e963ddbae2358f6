"""Makes the page of what `twinform diff` does not compare."""

from testbed.not_compared import NOT_COMPARED
from twinform.compiler.compare.usd_terms import OF_JOINTS, SINGLE_PRECISION

_INTRODUCTION = """\
# What diff does not compare

`twinform diff` compares every value of both files but these. A changed value anywhere else is a difference or a note: a
test changes values of real files, and looks. Also the same are: another order of elements that have names, comments, a
default that is written or not, and other notation for a number or a pose. The XPaths are those of the values, or of
elements with all below them.
"""

_COMPARED = ", ".join(f"`{path.removesuffix('/')}`" for path in OF_JOINTS)
_IN_USD = f"""\
## What USD cannot say

Where one of the files is USD, these are compared: {_COMPARED}
of joints, masses, centers and inertias of links, shapes of collisions, links, frames, how joints move, and where all
that is. Numbers may differ by {SINGLE_PRECISION:g} of their size: most of those in USD are of single precision. Not
compared are, among others:

* visuals and materials, which other programs of USD judge;
* surfaces of collisions, sensors, plugins, transmissions, and all else that only one of the formats has;
* the place and size of a mesh: converters bake them into its points;
* a mass of zero where USD leaves the mass out: an engine computes one from the shapes, and USD cannot say otherwise;
* the names of fixed joints that the converter has made up;
* the gains of drives that hold a position, and armature: URDF and SDF have no controllers;
* where a body stands in the stage, if it hangs on a joint: the joint says where it is at zero.
"""


def page() -> str:
    """Return the page as Markdown."""
    sections = (f"## {each.what.capitalize()}\n\n{each.why}\n\n{_code(each.xpath)}" for each in NOT_COMPARED)
    return "\n".join((_INTRODUCTION, *sections, _IN_USD))


def _code(xpath: str) -> str:
    paths = "\n".join(part.strip() for part in xpath.split(" | "))
    return f"```text\n{paths}\n```\n"
