"""Keyframes of models that MJCF attaches: each becomes a keyframe of the whole, with the states of what is attached.

A keyframe is one list of numbers for all joints in their order, so that it can only be written when all models are in
their places. Until then every joint, mocap body and actuator of an attached model has a number in an attribute, by
which its part of each list is found again. As in MuJoCo, what a keyframe says nothing about is in its initial state,
and of the copies that a replicate makes of an attached model, the first one takes the states.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import NamedTuple

from lxml import etree

from twinform.compiler.input.mjcf.element_findings import SLOT, give_number
from twinform.compiler.input.mjcf.number_lists import Numbers, number_text, numbers_of
from twinform.dataclass import dataclass
from twinform.schemas import XmlElement

_POSE = (("pos", (0.0, 0.0, 0.0)), ("quat", (1.0, 0.0, 0.0, 0.0)))
_STATELESS = frozenset({"motor", "velocity", "damper", "adhesion"})
_FILTERED = frozenset({"position", "cylinder", "muscle"})
"""Actuators that have one activation, a `position` where it has a time constant."""
_FIRST_ORDER = frozenset({"integrator", "filter", "filterexact", "muscle"})
_UNCOUNTED = frozenset({"flexcomp", "flex", "plugin"})
"""What has coordinates that no element of the file stands for."""
LISTS = ("qpos", "qvel", "act", "ctrl", "mpos", "mquat")
"""The attributes of a keyframe that have numbers for each joint, actuator or mocap body."""

Place = tuple[str, int]
"""The number of a part, and which of its copies it is."""


class UncountableError(Exception):
    """It is not known how many numbers of a keyframe belong to a part."""


class _Part(NamedTuple):
    """A part that has numbers in the lists of keyframes, and the initial ones."""

    element: XmlElement
    initial: Mapping[str, Numbers]


class _Key(NamedTuple):
    """A keyframe that waits for its place: what is said of it alone, and the numbers of each part by list."""

    own: Mapping[str, str]
    origin: XmlElement
    states: Mapping[Place, Mapping[str, Numbers]]


@dataclass(slots=True)
class AttachedKeys:
    """The keyframes of the models that are attached to one model."""

    waiting: list[_Key] = field(default_factory=list[_Key])
    counted: list[int] = field(default_factory=lambda: [0])

    def mark(self, model: XmlElement) -> None:
        """Give a number to each part of a model that is going to be attached."""
        for part in _elements(model):
            self.counted[0] += 1
            part.set(SLOT, str(self.counted[0]))

    def take(self, whole: XmlElement, prefix: str, attachment: XmlElement) -> None:
        """Take the keyframes of a marked model that is not cut down yet, and whose frames are expanded.

        Raises:
            UncountableError: it has parts whose numbers cannot be told apart.
        """
        places = _places(whole)
        for key in whole.iterfind("keyframe/key"):
            own = {str(name): str(value) for name, value in key.items() if name not in LISTS}
            states: dict[Place, dict[str, Numbers]] = {place: {} for place in places}
            for name in LISTS:
                numbers = numbers_of(key, name)
                if numbers is not None:
                    for place, taken in _shares(places, name, numbers):
                        states[place][name] = taken
            self.waiting.append(_Key({**own, "name": prefix + own.get("name", "")}, attachment, states))

    def write(self, model: XmlElement) -> None:
        """Write all keyframes that wait into a model whose frames are expanded.

        Raises:
            UncountableError: it has parts whose numbers cannot be told apart.
        """
        if not self.waiting:
            return
        places = _places(model)
        section = model.find("keyframe")
        if section is None:
            section = etree.SubElement(model, "keyframe")
            give_number(section, self.waiting[0].origin)
        for waiting in self.waiting:
            key = etree.SubElement(section, "key", dict(waiting.own))
            give_number(key, waiting.origin)
            for name in {name: None for state in waiting.states.values() for name in state}:
                numbers = [
                    number
                    for place, part in places.items()
                    for number in waiting.states.get(place, {}).get(name, part.initial.get(name, ()))
                ]
                if numbers:
                    key.set(name, number_text(numbers))
        self.waiting.clear()


def _elements(model: XmlElement) -> Iterator[XmlElement]:
    for worldbody in model.iterchildren("worldbody"):
        for each in worldbody.iterdescendants("body", "joint", "freejoint"):
            if each.tag != "body" or each.get("mocap") == "true":
                yield each
    yield from model.iterfind("actuator/*")


def _places(model: XmlElement) -> dict[Place, _Part]:
    """Return all parts of a model in the order of its lists."""
    if next(model.iter(*_UNCOUNTED), None) is not None:
        raise UncountableError
    found: dict[Place, _Part] = {}
    copies = Counter[str]()
    for element in _elements(model):
        number = element.get(SLOT, "")
        copies[number] += 1
        found[number, copies[number]] = _Part(element, _initial(element))
    return found


def _shares(places: Mapping[Place, _Part], name: str, numbers: Numbers) -> Iterator[tuple[Place, Numbers]]:
    """Yield the numbers of each part; a list that is too short is completed."""
    at = 0
    for place, part in places.items():
        usual = part.initial.get(name, ())
        if usual:
            taken = numbers[at : at + len(usual)]
            at += len(usual)
            yield place, (*taken, *usual[len(taken) :])


def _initial(element: XmlElement) -> dict[str, Numbers]:
    """Return the numbers that a part has in each list of a keyframe that says nothing about it."""
    if element.tag == "body":
        return {f"m{name}": numbers_of(element, name) or usual for name, usual in _POSE}
    if element.tag not in {"joint", "freejoint"}:
        return {"act": (0.0,) * _activations(element), "ctrl": (0.0,)}
    body = element.getparent()
    match "free" if element.tag == "freejoint" else element.get("type", "hinge"):
        case "free" if body is not None:
            pose = [number for name, usual in _POSE for number in numbers_of(body, name) or usual]
            return {"qpos": tuple(pose), "qvel": (0.0,) * 6}
        case "ball":
            return {"qpos": _POSE[1][1], "qvel": (0.0,) * 3}
        case _:
            return {"qpos": numbers_of(element, "ref") or (0.0,), "qvel": (0.0,)}


def _activations(actuator: XmlElement) -> int:
    tag = str(actuator.tag)
    if tag in _STATELESS or (tag == "position" and not any(numbers_of(actuator, "timeconst") or ())):
        return 0
    if tag in _FILTERED or tag == "intvelocity":
        return 1
    kind = actuator.get("dyntype", "none")
    if tag != "general" or kind not in {"none", *_FIRST_ORDER} or "actdim" in actuator.attrib:
        raise UncountableError
    return 1 if kind in _FIRST_ORDER else 0
