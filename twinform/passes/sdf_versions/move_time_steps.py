"""Physics time steps, which are elements of `<physics>` itself since SDF 1.4."""

from typing import ClassVar

from twinform.ir import Document, Element, World
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import (
    VersionPass,
    has_element,
    map_elements_named,
    put_element,
    take_element,
)

_RATE = "update_rate"
_REAL_TIME_RATE = "real_time_update_rate"
_STEP = "max_step_size"
_ENGINE_STEPS: dict[str, tuple[str, ...]] = {"ode": ("ode", "solver", "dt"), "bullet": ("bullet", "dt")}


class MoveTimeSteps(VersionPass):
    """Say the time steps of `<physics>` as 1.4 does, or with `back` as before.

    Changes: 1. `update_rate` and `real_time_update_rate`; 2. `ode/solver/dt` or `bullet/dt`, and `max_step_size`.
    Never touches: a second step, which the version asked for has no place for.
    """

    name: ClassVar[str] = "move-time-steps"
    back: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with time steps in the syntax of the version."""
        return map_elements_named("physics", document, World, _lower_steps if self.back else _raise_steps)


def _raise_steps(physics: Element) -> Element:
    physics = _rename(physics, (_RATE,), _REAL_TIME_RATE)
    for path in _ENGINE_STEPS.values():
        physics = _rename(physics, path, _STEP)
    return physics


def _lower_steps(physics: Element) -> Element:
    physics = _rename(physics, (_REAL_TIME_RATE,), _RATE)
    *holder, name = _ENGINE_STEPS.get(physics.get("type") or "ode", _ENGINE_STEPS["ode"])
    return _rename(physics, (_STEP,), name, tuple(holder))


def _rename(element: Element, path: tuple[str, ...], name: str, into: tuple[str, ...] = ()) -> Element:
    """The element with the descendant at a path renamed and moved, unless there is one in the new place."""
    # A step that is written in both syntaxes stays where it is: the one in the version's own place
    # counts.
    if has_element(element, (*into, name)):
        return element
    left, taken = take_element(element, path)
    return element if taken is None else put_element(left, into, taken.copy(name=name))
