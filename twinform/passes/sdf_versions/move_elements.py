"""Elements that moved to another one: time steps of physics in SDF 1.4, gravity and magnetic field in 1.6."""

from functools import partial
from typing import ClassVar

from twinform.ir import Document, Element, Opaque, World, rewrite
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper, version_carriers
from twinform.passes.sdf_versions.version_pass import (
    VersionPass,
    has_element,
    map_elements_named,
    put_element,
    take_element,
)
from twinform.schemas import format_value, parse_value

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


_SINCE = (1, 6)
_FIELD = "magnetic_field"
_FIELD_SINCE = (1, 5)


class MoveWorldFields(VersionPass):
    """Move `<gravity>` and `<magnetic_field>` from the physics of a world to the world, or with `back` from there.

    Changes: where a world without `<physics>` has one of them, `back` makes one, which goes again on the way forth.
    Never touches: gravity of a second `<physics>`; the magnetic field in the conversion to 1.4, which does not have it.
    """

    name: ClassVar[str] = "move-world-fields"
    back: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with the fields in their places."""
        back = partial(_move_to_physics, self.carriers, self.number >= _FIELD_SINCE)
        return rewrite(document, World, back if self.back else _move_to_world)


def _move_to_world(world: World) -> World:
    """The world with gravity and magnetic field taken out of its first `<physics>`."""
    for part in world.opaque:
        # Only the first <physics> of a world counts for gravity.
        if part.element and part.element.name == "physics" and not part.at:
            return _take_fields(world, part, part.element)
    return world


def _take_fields(world: World, part: Opaque, physics: Element) -> World:
    update: dict[str, object] = {}
    moved: list[Opaque] = []
    left, gravity = take_element(physics, ("gravity",))
    if gravity is not None and gravity.text and world.gravity is None:
        physics, update["gravity"] = left, parse_value("vector3", gravity.text)
    left, field = take_element(physics, (_FIELD,))
    if field is not None and not any(map(_is_field, world.opaque)):
        physics = left
        moved.append(Opaque.unchecked(element=field, source=part.source))
    if not update and not moved:
        return world
    changed = part.copy(element=physics)
    update["opaque"] = (*(changed if each is part else each for each in world.opaque), *moved)
    return world.copy(**update)


def _move_to_physics(carriers: bool, field: bool, world: World) -> World:
    """The world with its gravity in its first `<physics>`; with `field`, its magnetic field too."""
    fields = [part for part in world.opaque if _is_field(part)] if field else []
    moved = [part.element for part in fields if part.element]
    if world.gravity is not None:
        moved.insert(0, Element.unchecked(name="gravity", text=format_value(world.gravity)))
    if not moved:
        return world
    rest = [part for part in world.opaque if part not in fields]
    place = next((i for i, part in enumerate(rest) if part.element and part.element.name == "physics"), None)
    if place is None:
        place = len(rest)
        rest.append(Opaque.unchecked(element=_make_physics(carriers=carriers), source=world.source))
    physics = rest[place].element
    for element in moved:
        physics = put_element(physics, (), element) if physics else None
    rest[place] = rest[place].copy(element=physics)
    return world.copy(gravity=None, opaque=tuple(rest))


def _make_physics(*, carriers: bool) -> Element:
    """A `<physics>` that holds nothing but the moved fields."""
    # Marked as synthesized, so that the conversion back takes the whole <physics> out again.
    annotations = version_carriers([], VersionCondition(since=_SINCE, without=(".",))) if carriers else ()
    children = tuple(part.element for part in annotations if part.element)
    return Element.unchecked(name="physics", attributes=(("type", "ode"),), children=children)


def _is_field(part: Opaque) -> bool:
    return part.element is not None and part.element.name == _FIELD and not part.at
