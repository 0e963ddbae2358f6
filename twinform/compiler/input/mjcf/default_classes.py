"""The `default` classes of MJCF, and how their values are merged into the elements that they are for.

An element takes the values of its own `class`, else those of the nearest `childclass` around it, else those of the
class `main`. A list of numbers that is shorter than that of the class is filled up from it. Classes may be used before
they are defined.
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import field
from types import MappingProxyType
from typing import NamedTuple

from twinform.compiler.input.mjcf.actuator_defaults import ACTUATORS, ActuatorLevel, actuator_values
from twinform.compiler.input.mjcf.copy_budget import CHARACTERS, CopyBudget
from twinform.compiler.input.mjcf.element_findings import NUMBER, ElementFindings
from twinform.dataclass import dataclass
from twinform.diagnostics import nearest_name, rules
from twinform.schemas import XmlElement

MAIN = "main"
ROTATIONS = ("quat", "axisangle", "euler", "xyaxes", "zaxis")
"""The notations of an orientation, of which an element has one."""
_FILLED_UP = frozenset({
    "size", "friction", "gear", "gainprm", "biasprm", "dynprm", "fluidcoef", "polycoef", "solref", "solimp",
    "solreflimit", "solimplimit", "solreffriction", "solimpfriction",
})  # fmt: skip
"""Lists of numbers of which an element may write only the first ones."""
_OF_NO_CLASS = frozenset({"name", "class", NUMBER})
"""What is said of one element alone; a name in a class is reported, and not passed on."""
_EQUALITIES = frozenset({"connect", "weld", "joint", "tendon", "flex", "flexstrain"})
_SPATIAL_ONLY = ("material", "rgba", "width")
_BODIES = frozenset({"body", "worldbody", "frame", "replicate"})
_IN_BODIES = frozenset({"joint", "geom", "site", "camera", "light"})
_ASSETS = frozenset({"mesh", "material", "texture"})


class ClassValues(NamedTuple):
    """What a class says, with what it inherits: attributes and children by element, and its actuators by level.

    The weights are how many elements the texts of the attributes count as, where they are long.
    """

    attributes: Mapping[str, Mapping[str, str]]
    weights: Mapping[str, int] = MappingProxyType({})
    layers: tuple[XmlElement, ...] = ()
    actuators: tuple[ActuatorLevel, ...] = ()


_NOTHING = ClassValues({})


@dataclass(slots=True)
class DefaultClasses:
    """The classes of a file by name."""

    findings: ElementFindings
    budget: CopyBudget
    classes: dict[str, ClassValues] = field(default_factory=lambda: {MAIN: _NOTHING})

    @classmethod
    def of(cls, root: XmlElement, findings: ElementFindings, budget: CopyBudget) -> "DefaultClasses":
        """Read all classes of a file, and report those that have no name, or one that is taken."""
        found = cls(findings, budget)
        for top in root.iterchildren("default"):
            found._read_top(top)
        return found

    def _read_top(self, top: XmlElement) -> None:
        name = top.get("class", MAIN)
        if name != MAIN:
            message = f"the class at the top is always called 'main', so that it cannot be called {name!r}"
            hint = f'write <default><default class="{name}"> around its elements'
            self.findings.report(rules.INVALID_VALUE, top, message, "@class", found=name, expected=MAIN, help=hint)
        self.classes[MAIN] = _with_values(self.classes[MAIN], top)
        left = [(each, MAIN) for each in reversed([*top.iterchildren("default")])]
        while left:
            element, parent = left.pop()
            name = element.get("class") or ""
            if not self._may_be_called(name, element):
                continue
            self.classes[name] = _with_values(self.classes[parent], element)
            left += [(each, name) for each in reversed([*element.iterchildren("default")])]

    def _may_be_called(self, name: str, element: XmlElement) -> bool:
        if not name:
            message = "a class inside of another one needs a name"
            self.findings.report(rules.MISSING_ATTRIBUTE, element, message, expected="@class")
        elif name in self.classes:
            message = f"there is more than one class called {name!r}"
            self.findings.report(rules.DUPLICATE_NAME, element, message, "@class", found=name)
        else:
            return True
        return False

    def merge_into(self, root: XmlElement) -> None:
        """Write the values of classes into all elements of a tree, and take the classes out of it."""
        for section in root.iterchildren():
            match section.tag:
                case "worldbody":
                    self._merge_bodies(section)
                case "asset":
                    self._merge_children(section, lambda tag: tag if tag in _ASSETS else None)
                case "contact":
                    self._merge_children(section, lambda tag: tag if tag == "pair" else None)
                case "equality":
                    self._merge_children(section, lambda tag: "equality" if tag in _EQUALITIES else None)
                case "tendon":
                    self._merge_children(section, lambda tag: "tendon" if tag in {"spatial", "fixed"} else None)
                case "actuator":
                    for each in section.iterchildren():
                        self._merge_actuator(each)
                case _:
                    pass

    def _merge_bodies(self, worldbody: XmlElement) -> None:
        left = [(worldbody, MAIN)]
        while left:
            around, name = left.pop()
            name = self._known(around, around.attrib.pop("childclass", None), "childclass") or name
            for child in around.iterchildren():
                if child.tag in _IN_BODIES:
                    self._merge(child, str(child.tag), name)
                elif child.tag in _BODIES:
                    left.append((child, name))

    def _merge_children(self, section: XmlElement, kind_of: Callable[[str], str | None]) -> None:
        for each in section.iterchildren():
            kind = kind_of(str(each.tag))
            if kind is not None:
                self._merge(each, kind, MAIN)

    def _merge(self, element: XmlElement, kind: str, around: str) -> None:
        name = self._known(element, element.attrib.pop("class", None), "class") or around
        found = self.classes[name]
        values = found.attributes.get(kind)
        if values and self._may_add(kind, found, element):
            left_out = _SPATIAL_ONLY if element.tag == "fixed" else ()
            merge_values(element, {key: text for key, text in values.items() if key not in left_out})
        if kind != "material" or not found.layers or "texture" in element.attrib or len(element):
            return
        if self.budget.spend(len(found.layers), element, self.findings):
            element.extend(deepcopy(each) for each in found.layers)

    def _merge_actuator(self, element: XmlElement) -> None:
        if element.tag not in ACTUATORS:
            return
        name = self._known(element, element.attrib.pop("class", None), "class") or MAIN
        values = actuator_values(element, self.classes[name].actuators)
        if self.budget.spend(_weight_of(values), element, self.findings):
            merge_values(element, values)

    def _may_add(self, kind: str, found: ClassValues, element: XmlElement) -> bool:
        """Count the long texts that a class adds to an element; those of most classes are short."""
        weight = found.weights.get(kind, 0)
        return not weight or self.budget.spend(weight, element, self.findings)

    def _known(self, element: XmlElement, name: str | None, attribute: str) -> str | None:
        """Return a name of a class, or None for one that there is not, which is reported."""
        if name is None or name in self.classes:
            return name
        near = nearest_name(name, list(self.classes))
        hint = f"did you mean {near!r}?" if near else f"the classes are {', '.join(self.classes)}"
        message = f"there is no default class {name!r}"
        self.findings.report(rules.UNKNOWN_CLASS, element, message, f"@{attribute}", found=name, help=hint)
        return None


def merge_values(element: XmlElement, values: Mapping[str, str]) -> None:
    """Add the attributes that an element lacks, and fill up its lists; its own orientation counts in any notation."""
    is_turned = any(name in element.attrib for name in ROTATIONS)
    for name, text in values.items():
        own = element.get(name)
        if own is None:
            if not (is_turned and name in ROTATIONS):
                element.set(name, text)
        elif name in _FILLED_UP:
            element.set(name, _filled_up(own, text))


def _filled_up(own: str, whole: str) -> str:
    """Return a list of numbers with those of another list behind it, where that is longer."""
    mine, theirs = own.split(), whole.split()
    return " ".join([*mine, *theirs[len(mine) :]]) if len(theirs) > len(mine) else own


def _with_values(parent: ClassValues, element: XmlElement) -> ClassValues:
    """Return the values of a class: those of its parent, and over them its own."""
    attributes = dict(parent.attributes)
    layers, actuators = parent.layers, list[XmlElement]()
    for child in element.iterchildren():
        tag = str(child.tag)
        if tag == "default":
            continue
        if tag in ACTUATORS:
            actuators.append(child)
            continue
        attributes[tag] = _over(attributes.get(tag, {}), child)
        if tag == "material" and (len(child) or "texture" in child.attrib):
            layers = tuple(child)
    level = (ActuatorLevel.of(actuators),) if actuators else ()
    weights = {tag: weight for tag, values in attributes.items() if (weight := _weight_of(values))}
    return ClassValues(attributes, weights, layers, parent.actuators + level)


def _weight_of(values: Mapping[str, str]) -> int:
    return sum(map(len, values.values())) // CHARACTERS


def _over(values: Mapping[str, str], element: XmlElement) -> dict[str, str]:
    """Return values with those of an element of a class over them."""
    own = {str(name): str(text) for name, text in element.items() if name not in _OF_NO_CLASS}
    if any(name in own for name in ROTATIONS):
        values = {name: text for name, text in values.items() if name not in ROTATIONS}
    filled = {name: _filled_up(own[name], values[name]) for name in _FILLED_UP if name in own and name in values}
    return {**values, **own, **filled}
