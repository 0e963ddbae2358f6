"""Joints of MJCF with what a joint of SDF keeps of the one that it was read from: the number of the drawn position.

In SDF a joint is drawn at zero. Where it keeps a `ref`, its range and the rest position of its spring are counted from
there, and get it added again. A limit of force that was none of the joint, but of its actuators, is not written.
"""

from twinform.ir import Element, Joint
from twinform.ir.transform import rounded
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements, with_kept
from twinform.schemas import format_value

_FORCE = ("actuatorfrclimited", "actuatorfrcrange")
_POLYNOMIALS = ("damping", "stiffness")
"""Coefficients of which SDF says the first."""


def with_kept_joint(element: Element, joint: Joint) -> Element:
    """Return a joint of MJCF with what the joint of SDF keeps of it."""
    kept = next((each for each in kept_elements(joint) if each.name == "joint"), None)
    if kept is None:
        return element
    if kept.get(_FORCE[0]) == "false" and kept.get(_FORCE[1]) is None:
        own = tuple(pair for pair in element.attributes if pair[0] not in _FORCE)
        element = element.copy(attributes=own)
    written = tuple((name, _with_rest(name, value, kept)) for name, value in element.attributes)
    made = with_kept(element.copy(attributes=written), joint)
    if made.get(_FORCE[1]) is None:  # where nothing is limited, it need not be said
        made = made.copy(attributes=tuple(pair for pair in made.attributes if pair != (_FORCE[0], "false")))
    return _counted_from(made)


def with_kept_equality(element: Element, joint: Joint) -> Element:
    """Return an equality of MJCF with what the joint of SDF keeps of the one that it was read from."""
    for section in kept_elements(joint):
        for kept in section.children:
            if section.name == "equality" and kept.name == element.name:
                known = {key for key, _ in element.attributes}
                more = tuple(pair for pair in kept.attributes if pair[0] not in known)
                element = element.copy(attributes=(*element.attributes, *more))
    return element


def _with_rest(name: str, value: str, kept: Element) -> str:
    """Return a first coefficient with those that stood behind it."""
    others = (kept.get(name) or "").split()[1:] if name in _POLYNOMIALS else []
    return " ".join([value, *others])


def _counted_from(element: Element) -> Element:
    """Return the joint with positions counted from its `ref`."""
    ref = float(element.get("ref") or 0.0)
    if not ref:
        return element
    attributes = dict(element.attributes)
    if "range" in attributes:
        attributes["range"] = _moved(attributes["range"], ref)
    if "stiffness" in attributes:
        attributes["springref"] = _moved(attributes.get("springref", "0"), ref)
    return element.copy(attributes=tuple(attributes.items()))


def _moved(text: str, by: float) -> str:
    numbers = [rounded((float(each) + by, 0.0, 0.0))[0] for each in text.split()]
    return " ".join(map(format_value, numbers))
