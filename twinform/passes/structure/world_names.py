"""What a world says about the parts of its models, by names such as `robot::arm`."""

from collections.abc import Callable
from typing import TypeVar

from twinform.diagnostics import Notes
from twinform.ir import Format, Light, Model, World
from twinform.passes.structure.renaming import renamed_model
from twinform.passes.structure.scopes import Scope

Placed = TypeVar("Placed", Model, Light)
_SHARED = ("joints", "frames", "includes", "opaque", "plugins")
"""What a world has as a model has it."""


def followed(before: World, after: World, scope: Callable[[Model], Scope], only: str | None) -> World:
    """The world after its models were renamed, with its own joints, frames, poses and the like following them.

    `before` has the models by their old names; `only` names the one model that was renamed, if it is one alone.
    """
    inner = {model.name: scope(model) for model in before.models if only in (None, model.name)}
    own: dict[str, dict[str, str]] = {part: {} for part in ("link", "joint", "frame", "model")}
    around = Scope("", own, inner)
    holder = Model(name="", **{name: getattr(after, name) for name in _SHARED})
    made = renamed_model(holder, around, Format.SDF, Notes())
    update: dict[str, object] = {name: getattr(made, name) for name in _SHARED}
    update["models"] = tuple(_placed(model, around) for model in after.models)
    update["lights"] = tuple(_placed(light, around) for light in after.lights)
    return after.model_copy(update=update)


def _placed(node: Placed, around: Scope) -> Placed:
    """A model or light of the world, its pose relative to what has another name now."""
    if node.pose is None or not node.pose.relative_to:
        return node
    pose = node.pose.model_copy(update={"relative_to": around.follow("any", node.pose.relative_to)})
    return node.model_copy(update={"pose": pose})
