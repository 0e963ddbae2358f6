"""Options of MJCF: the time step, gravity, wind and magnetic field of a world of SDF."""

from twinform.ir import Element, Sensor, World, walk
from twinform.ir.defaults import GRAVITY
from twinform.passes.legalise.to_mjcf.elements import Attributes, make_element
from twinform.passes.legalise.to_mjcf.said_parts import child_number, child_vector, untyped, without_elements
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

TIME_STEP = 0.001
"""The step of a world of SDF that names none; s."""
MAGNETIC_FIELD = (5.5645e-6, 2.28758e-5, -4.23884e-5)
"""The field of a world of SDF that names none; T."""


SETTINGS = frozenset({"magnetic_field", "physics", "wind"})
"""The elements of a world that become attributes of `option`."""
_OF_MUJOCO = (("type", "ignored"),)
"""The attributes of the `<physics>` of a world that was read of MJCF."""


def add_options(context: MjcfContext) -> None:
    """Add what a world says of its physics to the sections `option`, `visual` and `statistic`."""
    holder = context.holder
    if isinstance(holder, World) and context.document.worlds:
        measured = any(isinstance(node, Sensor) and node.type == "magnetometer" for node in walk(holder))
        context.add("option", make_element("option", option_attributes(holder, has_magnetometers=measured)))
        context.leave(holder, unsaid_world(holder))


def has_usual_settings(context: MjcfContext) -> bool:
    """Whether the options of the file say all settings of the world, and are read as these again."""
    holder = context.holder
    if untyped(holder, "magnetic_field") is None or not isinstance(holder, World):  # MuJoCo has another default for it
        return False
    of_physics = [part.element for part in holder.opaque if part.element and part.element.name == "physics"]
    wind = untyped(unsaid_world(holder), "wind")
    return (
        wind is None
        and [each.attributes for each in of_physics] == [_OF_MUJOCO]
        and not any(child.name != "max_step_size" for each in of_physics for child in each.children)
    )


def option_attributes(world: World, *, has_magnetometers: bool) -> Attributes:
    """The attributes of the `option` of a world.

    Step and gravity are always written, because their defaults differ between SDF and MJCF. The magnetic field is
    written where something measures it.
    """
    magnetic = untyped(world, "magnetic_field")
    return [
        ("timestep", child_number(chosen_physics(world), "max_step_size", default=TIME_STEP)),
        ("gravity", world.gravity or (0.0, 0.0, -GRAVITY)),
        ("wind", child_vector(untyped(world, "wind"), "linear_velocity")),
        ("magnetic", child_vector(magnetic) or (MAGNETIC_FIELD if has_magnetometers else None)),
    ]


def unsaid_world(world: World) -> World:
    """What MJCF does not say of a world, of what stands in the world itself."""
    return without_elements(_without_step(world, chosen_physics(world)).copy(gravity=None), _SAID)


_SAID = frozenset({"wind/linear_velocity", "magnetic_field"})


def chosen_physics(world: World) -> Element | None:
    """The `<physics>` that a simulator takes: the one that is marked as default, or else the first."""
    found = [part.element for part in world.opaque if part.element and part.element.name == "physics"]
    return next((each for each in found if each.get("default") in {"true", "1"}), found[0] if found else None)


def _without_step(world: World, physics: Element | None) -> World:
    if physics is None:
        return world
    rest = physics.copy(children=tuple(each for each in physics.children if each.name != "max_step_size"))
    parts = tuple(part.copy(element=rest) if part.element is physics else part for part in world.opaque)
    if not rest.children and not rest.attributes:
        parts = tuple(part for part in parts if part.element is not rest)
    return world.copy(opaque=parts)
