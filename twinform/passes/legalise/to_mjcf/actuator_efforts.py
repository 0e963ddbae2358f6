"""How hard actuators of MJCF push a joint: its effort in SDF, unless the joint itself limits the forces on it.

A joint whose actuators say another effort than that of the joint in SDF is given a limit of its own.
"""

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

from twinform.ir import Element
from twinform.ir.defaults import UNLIMITED
from twinform.passes.legalise.to_mjcf.elements import numbers_in
from twinform.passes.legalise.to_mjcf.kept_mjcf import FORCE
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.schemas import format_value


class Actuator(NamedTuple):
    """An actuator by the name of its element, and what returns its attributes."""

    tag: str
    get: Callable[[str], str | None]


def efforts(actuators: Iterable[Actuator]) -> dict[str, float]:
    """Return the greatest force in N or N m on each joint that is named by an actuator and limited by all of them."""
    found: dict[str, float] = {}
    endless: set[str] = set()
    for actuator in actuators:
        joint = actuator.get("joint")
        if joint is None:
            continue
        force = _greatest_force(actuator)
        if force is None:
            endless.add(joint)
        else:
            found[joint] = found.get(joint, 0.0) + force
    return {joint: force for joint, force in found.items() if joint not in endless and force > 0}


def counts(get: Callable[[str], str | None], limited: str, range_: str) -> bool:
    """Tell whether a range counts: where that is said, and otherwise where it is one."""
    said = get(limited) or "auto"
    least, most = (*numbers_in(get(range_)), 0.0, 0.0)[:2]
    return said == "true" if said != "auto" else least < most


def settle_efforts(context: MjcfContext) -> None:
    """Give joints the efforts that they have in SDF, where their actuators say others. All sections are complete."""
    if not context.efforts:
        return
    said = efforts(Actuator(each.name, each.get) for each in context.sections.get("actuator", ()))
    differing = {
        name: each for name, each in context.efforts.items() if not math.isclose(each, said.get(name, math.inf))
    }
    if not context.is_of_mjcf:  # where actuators are an addition, and say nothing of joints without an effort
        differing = {name: effort for name, effort in differing.items() if effort < UNLIMITED}
    if differing:
        bodies = context.sections.get("worldbody", [])
        bodies[:] = [_with_efforts(each, differing) for each in bodies]


def _with_efforts(element: Element, found: dict[str, float]) -> Element:
    children = tuple(_with_efforts(each, found) for each in element.children)
    attributes = element.attributes
    effort = found.get(element.get("name") or "") if element.name == "joint" else None
    if effort:  # no force can be limited to nothing
        value = format_value((-effort, effort))
        attributes = (*attributes, (FORCE[0], "true"), (FORCE[1], value))
    return element.copy(attributes=attributes, children=children)


def _greatest_force(actuator: Actuator) -> float | None:
    """Return the greatest force of an actuator: of its own limit, or of a motor at the end of its control range."""
    gear = abs(next(iter(numbers_in(actuator.get("gear"))), 1.0))
    if counts(actuator.get, "forcelimited", "forcerange"):
        return gear * _greatest(actuator.get("forcerange"))
    if actuator.tag == "motor" and counts(actuator.get, "ctrllimited", "ctrlrange"):
        return gear * _greatest(actuator.get("ctrlrange"))
    return None


def _greatest(range_: str | None) -> float:
    """Return the greater end of a range; 0 where none is written, which MuJoCo refuses if it is said to limit."""
    return max(map(abs, numbers_in(range_)), default=0.0)
