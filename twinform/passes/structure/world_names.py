"""What a world says about the parts of its models, by names such as `robot::arm`."""

from collections.abc import Callable

from twinform.diagnostics import Notes
from twinform.ir import Format, Include, Light, Model, World
from twinform.passes.structure.renaming import renamed_model
from twinform.passes.structure.scopes import Scope

_PLACED = ("models", "includes", "lights")
"""The parts of a world whose poses may be relative to a frame in one of its models."""


def followed(before: World, after: World, scope: Callable[[Model], Scope], only: str | None) -> World:
    """The world after its models were renamed, with its own joints, frames and the like following them.

    `before` has the models by their old names; `only` names the one model that was renamed, if it is one alone.
    """
    inner = {model.name: scope(model) for model in before.models if only in (None, model.name)}
    own: dict[str, dict[str, str]] = {part: {} for part in ("link", "joint", "frame", "model")}
    around = Scope("", own, inner)
    holder = Model(name="", joints=after.joints, frames=after.frames, opaque=after.opaque, plugins=after.plugins)
    made = renamed_model(holder, around, Format.SDF, Notes())
    update = {name: getattr(made, name) for name in ("joints", "frames", "opaque", "plugins")}
    placed = {name: tuple(_placed(node, around) for node in getattr(after, name)) for name in _PLACED}
    return after.model_copy(update={**update, **placed})


def _placed(node: Model | Include | Light, around: Scope) -> Model | Include | Light:
    """What stands in a world, at the same place by the new name of the frame that it stands in."""
    if node.pose is None or not node.pose.relative_to:
        return node
    pose = node.pose.model_copy(update={"relative_to": around.follow("any", node.pose.relative_to)})
    return node.model_copy(update={"pose": pose})
