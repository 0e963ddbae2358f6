"""What the audit knows of MJCF: words that it has for those of URDF and SDF, numbers in other units, and carriers."""

from collections.abc import Iterator

from twinform.ir.frames import MODEL
from twinform.passes.carriers.mjcf_texts import parse_data, parse_text_name
from twinform.passes.legalise.to_mjcf.friction import TORSIONAL_CONDIM, torsional_length
from twinform.schemas import XmlElement

KINDS = {
    "hinge": ("revolute", "continuous", "universal", "revolute2", "screw"),
    "slide": ("prismatic",),
    "ball": ("ball", "spherical"),
    "free": ("floating", "free", "model"),
}
"""Types of joints in MJCF, each with those of URDF and SDF that it stands for; what SDF leaves free has no joint."""
_IMPLIED = {("worldbody", ""): ("world", "fixed", MODEL), **{("joint", name): kinds for name, kinds in KINDS.items()}}
"""Words that an element of MJCF stands for, by its name and type: a body in a body is fixed to it, and placed in it."""
_OF_TORSION = (("patch_radius", "0"), ("coefficient", "1"))
_WITH_HALF_SIZES = frozenset({"geom", "hfield"})
COMPUTED = frozenset(
    {
        "axis", "axisangle", "biasprm", "cutoff", "density", "diaginertia", "dir", "euler", "fovy", "fromto",
        "fullinertia", "gainprm", "gravity", "mass", "pos", "quat", "range", "refpos", "refquat", "size", "springref",
        "xyaxes", "zaxis",
    }
)  # fmt: skip
"""Attributes whose numbers are in other units or frames in SDF and URDF, or of which others are computed."""


def name_in_sdf(element: XmlElement, attribute: str) -> str:
    """Return what passes call an attribute of MJCF: the root has the name of a world or model in another one."""
    return "name" if attribute == "model" and element.getparent() is None else attribute


def carried_in_mjcf(element: XmlElement) -> XmlElement | None:
    """Return what a carrier of MJCF holds, a text with XML in it; None for all other elements."""
    if element.tag != "text" or parse_text_name(element.get("name", "")) is None:
        return None
    return parse_data(element.get("data", ""))


def implied_in_mjcf(element: XmlElement) -> Iterator[str]:
    """Yield the words of SDF and URDF that an element of MJCF implies: types of joints, and whole for half sizes.

    And those that torsional friction of SDF implies in MJCF: a length, for contacts with four directions.
    """
    if element.tag == "torsional":
        radius, factor = (float(element.findtext(name, usual)) for name, usual in _OF_TORSION)
        yield from (repr(float(TORSIONAL_CONDIM)), repr(torsional_length(radius, factor)))
    yield from _IMPLIED.get((str(element.tag), element.get("type", "")), ())
    if element.tag in _WITH_HALF_SIZES:
        yield from (repr(2 * float(number)) for number in element.get("size", "").split())
