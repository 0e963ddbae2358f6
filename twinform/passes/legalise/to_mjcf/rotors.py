"""Inertia of rotors: Drake's `rotor_inertia` and `gear_ratio`, of which the `armature` of a joint of MJCF is made.

Drake has both in a joint of SDF and in the actuator of a transmission of URDF. Behind a gear of ratio n a rotor counts
n squared times for its joint. Where an armature was edited, the inertia of the rotor gives way and the gear stays.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import NamedTuple

from twinform.ir import Element, Joint, Model, Node, Opaque
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT, kept_elements
from twinform.schemas import format_value

_OF_URDF = f"{{{NAMESPACE}}}urdf"
_ARMATURE = "armature"


class Rotor(NamedTuple):
    """The inertia of a rotor in kg m^2, or its mass in kg before a slide, and the ratio of its gear."""

    inertia: float
    ratio: float

    @property
    def armature(self) -> float:
        """What the rotor adds to the inertia of its joint."""
        return self.inertia * self.ratio**2


def rotors_of(model: Model) -> Mapping[str, Rotor]:
    """The rotors of a model, by the names of their joints in it."""
    parts = (*_actuators(model), *((each.name, _elements(each)) for each in model.joints if each.opaque))
    return {name: rotor for name, elements in parts if (rotor := _rotor(elements)) is not None}


def _actuators(model: Model) -> Iterator[tuple[str, Iterable[Element]]]:
    """Yield the joints of URDF's transmissions and the elements in their actuators."""
    for each in _elements(model):
        for transmission in each.children if each.name == _OF_URDF else ():
            if transmission.name == "transmission":
                parts = [part for one in transmission.children if one.name == "actuator" for part in one.children]
                yield from ((one.get("name") or "", parts) for one in transmission.children if one.name == "joint")


def _elements(node: Node) -> list[Element]:
    return [part.element for part in node.opaque if part.element is not None and not part.at]


def _rotor(parts: Iterable[Element]) -> Rotor | None:
    found = {name: each for each in parts if (name := _word(each))}
    if "rotor_inertia" not in found:
        return None
    try:
        inertia, ratio = _number(found["rotor_inertia"], 0.0), _number(found.get("gear_ratio"), 1.0)
    except ValueError:
        return None
    return Rotor(inertia, ratio) if math.isfinite(inertia * ratio) and ratio and inertia >= 0.0 else None


def _word(element: Element) -> str:
    """The name of an element in the namespace of Drake, of which there are several spellings."""
    namespace, _, word = element.name.removeprefix("{").rpartition("}")
    return word if "drake" in namespace else word.partition("drake:")[2]


def _number(element: Element | None, usual: float) -> float:
    return usual if element is None else float(element.get("value") or element.text or "nan")


def with_rotors(model: Model) -> Model:
    """The model, read of MJCF, whose joints have the armatures of the file as rotors, where they had rotors before."""
    rotors = rotors_of(model)
    if not rotors:
        return model
    armatures = {each.name: _armature(each) for each in model.joints if each.name in rotors}
    edited = {
        name: written
        for name, written in armatures.items()
        if not math.isclose(written, rotors[name].armature, rel_tol=1e-5, abs_tol=1e-15)  # MuJoCo saves six digits
    }
    inertias = {name: format_value(written / rotors[name].ratio ** 2) for name, written in edited.items()}

    def settled(joint: Joint) -> Joint:
        return joint if joint.name not in rotors else _without_armature(_with_inertia(joint, inertias.get(joint.name)))

    opaque = tuple(_changed(part, lambda each: _in_transmission(each, inertias)) for part in model.opaque)
    return model.copy(joints=tuple(map(settled, model.joints)), opaque=opaque if inertias else model.opaque)


def _armature(joint: Joint) -> float:
    return next((float(each.get(_ARMATURE) or 0.0) for each in kept_elements(joint) if each.name == "joint"), 0.0)


def _with_inertia(joint: Joint, inertia: str | None) -> Joint:
    if inertia is None:
        return joint
    return joint.copy(opaque=tuple(_changed(part, partial(_written, inertia=inertia)) for part in joint.opaque))


def _changed(part: Opaque, change: Callable[[Element], Element]) -> Opaque:
    return part if part.element is None else part.copy(element=change(part.element))


def _written(element: Element, inertia: str) -> Element:
    """The element with another inertia, if it is one of a rotor."""
    if _word(element) != "rotor_inertia":
        return element
    if element.get("value") is None:
        return element.copy(text=inertia)
    return element.copy(attributes=tuple((key, inertia if key == "value" else old) for key, old in element.attributes))


def _in_transmission(element: Element, inertias: Mapping[str, str]) -> Element:
    """An element of a model with other inertias in the transmissions that are in it."""
    if element.name == _OF_URDF:
        return element.copy(children=tuple(_in_transmission(each, inertias) for each in element.children))
    names = [each.get("name") or "" for each in element.children if each.name == "joint"]
    inertia = next((inertias[name] for name in names if name in inertias), None)
    if element.name != "transmission" or inertia is None:
        return element
    actuators = (
        each.copy(children=tuple(_written(one, inertia) for one in each.children)) if each.name == "actuator" else each
        for each in element.children
    )
    return element.copy(children=tuple(actuators))


def _without_armature(joint: Joint) -> Joint:
    """The joint without the armature of the file, which its rotor has."""

    def left(part: Opaque) -> Opaque | None:
        if part.element is None or part.element.name != KEPT:
            return part
        bare = [_bare(each) if each.name == "joint" else each for each in part.element.children]
        children = tuple(each for each in bare if each.attributes or each.children)
        return part.copy(element=part.element.copy(children=children)) if children else None

    return joint.copy(opaque=tuple(made for part in joint.opaque if (made := left(part)) is not None))


def _bare(element: Element) -> Element:
    return element.copy(attributes=tuple(pair for pair in element.attributes if pair[0] != _ARMATURE))
