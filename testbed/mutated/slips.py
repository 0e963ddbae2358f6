"""Slips of those who write models: one value, name or place in a document that is not what it should be."""

import copy
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from random import Random

from lxml import etree

from twinform.schemas import XmlElement

_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])")
_SPELLINGS = (
    "inf", "-inf", "Infinity", "nan", "1e400", "-1e400", "1e-400", "1e", "0x10", "+1", "1.", ".5", "-.5e-2", "1f",
    "1.0kg", "1,5", "1_0", "1d0", "one", "--1", "-0", "1e+2", "0.5.5", "\u0661", "1%", "${x}", "$(arg x)", "1;",
    "007", "1 000",
)  # fmt: skip
_NAMES = (
    "world", "__model__", "__root__", "nowhere", "", " ", "a b", "a::b", "::", "a/b", "__x__", "\u00e4", "0", "-",
    "World",
)  # fmt: skip
_WORDS = (
    "true", "TRUE", "True", "t", "yes", "1", "0", "2", "false", "fixed", "revolute", "revolute2", "continuous",
    "prismatic", "floating", "planar", "ball", "screw", "universal", "gearbox", "spherical", "Revolute", "camera",
    "ray", "lidar", "gpu_lidar", "imu", "contact", "altimeter", "force_torque", "depth", "gps", "point", "spot",
    "directional", "gaussian", "none", "ode", "custom", "child", "parent", "sensor", "nonsense",
)  # fmt: skip
_SHAPES = ("box", "cylinder", "sphere", "mesh", "capsule", "ellipsoid", "plane", "cone", "heightmap", "empty", "image")
_NAMING = frozenset({
    "name", "link", "joint", "reference", "parent", "child", "relative_to", "attached_to", "expressed_in",
    "canonical_link", "placement_frame", "frame", "topic", "collision", "gearbox_reference_body", "gripper_link",
    "palm_link", "body",
})  # fmt: skip
_CHOOSING = frozenset(
    {"type", "static", "gravity", "kinematic", "self_collide", "always_on", "visualize", "cast_shadows"}
)


@dataclass(frozen=True, slots=True)
class _Value:
    """An attribute, or the text of an element without children."""

    element: XmlElement
    attribute: str = ""

    @property
    def key(self) -> str:
        return self.attribute or str(self.element.tag)

    @property
    def text(self) -> str:
        return (self.element.get(self.attribute) if self.attribute else self.element.text) or ""

    def become(self, text: str) -> None:
        if self.attribute:
            self.element.set(self.attribute, text)
        else:
            self.element.text = text


Slip = Callable[[Random, XmlElement], None]
"""Changes a tree that it is given the root of, where it has something to change."""


def slipped(source: XmlElement, random: Random, count: int = 1) -> XmlElement:
    """A copy with so many slips, written and read again so that its lines are true."""
    root = copy.deepcopy(source)
    for _ in range(count):
        random.choice(_SLIPS)(random, root)
    return etree.fromstring(etree.tostring(root))


def _values(root: XmlElement) -> Iterator[_Value]:
    for element in root.iter(etree.Element):
        yield from (_Value(element, str(name)) for name in element.attrib)
        if not len(element) and (element.text or "").strip():
            yield _Value(element)


def _numbers(root: XmlElement) -> list[_Value]:
    return [value for value in _values(root) if _NUMBER.search(value.text) and value.element is not root]


def _in_a_number(change: Callable[[Random, str], str]) -> Slip:
    def slip(random: Random, root: XmlElement) -> None:
        if values := _numbers(root):
            value = random.choice(values)
            number = random.choice(list(_NUMBER.finditer(value.text)))
            made = change(random, number[0])
            value.become(value.text[: number.start()] + made + value.text[number.end() :])

    return slip


def _negated(_: Random, number: str) -> str:
    return number.removeprefix("-") if number.startswith("-") else f"-{number.removeprefix('+')}"


def _scaled(random: Random, number: str) -> str:
    return repr(float(number) * random.choice((1e-12, 1e-3, 1e3, 1e12)))


def _named_otherwise(random: Random, root: XmlElement) -> None:
    values = [value for value in _values(root) if value.key in _NAMING]
    if values:
        random.choice(values).become(random.choice((*_NAMES, *(value.text for value in values))))


def _chosen_otherwise(random: Random, root: XmlElement) -> None:
    values = [value for value in _values(root) if value.key in _CHOOSING]
    if values:
        random.choice(values).become(random.choice(_WORDS))


def _another_shape(random: Random, root: XmlElement) -> None:
    if shapes := [element for element in root.iter(*_SHAPES) if element.getparent() is not None]:
        random.choice(shapes).tag = random.choice(_SHAPES)


def _value_of_another(random: Random, root: XmlElement) -> None:
    if values := list(_values(root)):
        random.choice(values).become(random.choice(values).text)


def _without_a_value(random: Random, root: XmlElement) -> None:
    values = [value for value in _values(root) if value.element is not root]
    if values:
        value = random.choice(values)
        if value.attribute:
            del value.element.attrib[value.attribute]
        else:
            value.element.text = None


def _elsewhere(random: Random, root: XmlElement) -> None:
    elements = list(root.iter(etree.Element))[1:]
    if len(elements) > 1:
        moved, host = random.sample(elements, 2)
        if host not in moved.iter(etree.Element):
            host.append(moved)


def _left_out(random: Random, root: XmlElement) -> None:
    if elements := list(root.iter(etree.Element))[1:]:
        element = random.choice(elements)
        element.getparent().remove(element)  # pyright: ignore[reportOptionalMemberAccess] - only the root has no parent


def _twice(random: Random, root: XmlElement) -> None:
    if elements := list(root.iter(etree.Element))[1:]:
        element = random.choice(elements)
        element.addnext(copy.deepcopy(element))


def _with_a_comment(random: Random, root: XmlElement) -> None:
    if values := [value for value in _values(root) if not value.attribute]:
        value = random.choice(values)
        at = random.randint(0, len(value.text))
        comment = etree.Comment("slip")
        comment.tail = value.text[at:]
        value.become(value.text[:at])
        value.element.insert(0, comment)


_SLIPS: tuple[Slip, ...] = (
    _in_a_number(lambda random, _: random.choice(_SPELLINGS)),
    _in_a_number(_negated),
    _in_a_number(_scaled),
    _in_a_number(lambda _, __: "0"),
    _in_a_number(lambda _, __: ""),
    _in_a_number(lambda _, number: f"{number} {number}"),
    _named_otherwise,
    _named_otherwise,
    _chosen_otherwise,
    _another_shape,
    _value_of_another,
    _without_a_value,
    _elsewhere,
    _left_out,
    _twice,
    _with_a_comment,
)
