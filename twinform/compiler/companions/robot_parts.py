"""The names in robots that companion files may mention: links, joints with their limits, and what is driven."""

import math
from collections.abc import Collection, Mapping
from dataclasses import field
from pathlib import Path

from twinform.compiler.companions.name_places import without_expressions
from twinform.compiler.companions.possible_names import PossibleNames, possible_names
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import read
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.ir import Document, Joint
from twinform.schemas import XmlElement

_OUTSIDE = frozenset({rules.MISSING_ARGUMENT, rules.MISSING_PACKAGE, rules.INCLUDE_NOT_EXPANDED})
_VARIABLES = {"fixed": 0, "planar": 3, "floating": 7}
"""How many numbers a position has, where it is not one."""


@dataclass(frozen=True, slots=True)
class DrivenJoint:
    """The interfaces that `<ros2_control>` gives a joint."""

    commands: frozenset[str]
    states: frozenset[str]


@dataclass(frozen=True, slots=True)
class RobotParts:
    """The parts of one robot that others name; `above` leads from each link to the joint that moves it.

    `driven` and `sensors` are those of `<ros2_control>`; where `is_controlled` is false, it has none. Others are
    `possible` with other arguments.
    """

    path: Path
    name: str
    links: Collection[str]
    joints: Mapping[str, Joint]
    above: Mapping[str, Joint]
    driven: Mapping[str, DrivenJoint] = field(default_factory=dict[str, DrivenJoint])
    sensors: Collection[str] = ()
    is_controlled: bool = False
    possible: PossibleNames = field(default_factory=PossibleNames)

    @property
    def roots(self) -> list[str]:
        """The links that no joint moves."""
        return [link for link in self.links if link not in self.above]

    def chain(self, base: str, tip: str) -> list[Joint]:
        """Return the joints between two links, from the tip up, or down if the base hangs below it."""
        return self._climb(tip, base) or self._climb(base, tip) or []

    def _climb(self, start: str, end: str) -> list[Joint] | None:
        found: list[Joint] = []
        here = start
        while here != end:
            joint = self.above.get(here)
            if joint is None or len(found) > len(self.joints):
                return None
            found.append(joint)
            here = joint.parent or ""
        return found


def variables_of(joint_type: str) -> int:
    """Return how many numbers say where a joint of a type is."""
    return _VARIABLES.get(joint_type, 1)


def range_of(joint: Joint) -> tuple[float, float]:
    """Return the least and greatest position of a joint."""
    limit = joint.axis.limit if joint.axis is not None else None
    if joint.type not in {"revolute", "prismatic"} or limit is None:
        return -math.inf, math.inf
    # urdfdom takes 0 for a bound that is not written
    return limit.lower or 0.0, limit.upper or 0.0


def velocity_of(joint: Joint) -> float:
    """Return the greatest speed of a joint."""
    limit = joint.axis.limit if joint.axis is not None else None
    return math.inf if limit is None or not limit.velocity else limit.velocity


def read_parts(path: Path, load_options: LoadOptions) -> RobotParts | None:
    """Read the parts of a robot; None if it cannot be read as a whole."""
    loaded = read(str(path), load_options)
    document = loaded.document or (loaded.recovered and loaded.recovered.document)
    if document is None or any(each.rule in _OUTSIDE for each in loaded.diagnostics):
        return None
    return _parts_of(path, document, loaded, possible_names(path, load_options.search))


def _parts_of(path: Path, document: Document, loaded: LoadResult, possible: PossibleNames) -> RobotParts | None:
    model = document.models[0] if document.models else None
    if model is None:
        return None
    blocks = [] if loaded.tree is None else list(loaded.tree.iterchildren("ros2_control"))
    return RobotParts(
        path,
        model.name,
        dict.fromkeys(without_expressions(each.name) for each in model.links),
        {without_expressions(each.name): each for each in model.joints},
        {without_expressions(each.child): each for each in model.joints if each.child},
        _driven(blocks),
        {each.get("name") or "" for block in blocks for each in block.iterchildren("sensor", "gpio")},
        bool(blocks),
        possible,
    )


def _driven(blocks: list[XmlElement]) -> dict[str, DrivenJoint]:
    found: dict[str, DrivenJoint] = {}
    for joint in (each for block in blocks for each in block.iterchildren("joint")):
        name = joint.get("name") or ""
        other = found.get(name, DrivenJoint(frozenset(), frozenset()))
        commands, states = _interfaces(joint, "command_interface"), _interfaces(joint, "state_interface")
        found[name] = DrivenJoint(other.commands | commands, other.states | states)
    return found


def _interfaces(joint: XmlElement, tag: str) -> frozenset[str]:
    return frozenset(each.get("name") or "" for each in joint.iterchildren(tag))
