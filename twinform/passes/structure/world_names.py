"""What a world says about the parts of its models, by names such as `robot::arm`."""

from collections.abc import Callable

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Format, Model, World
from twinform.passes.structure.renaming import with_followed
from twinform.passes.structure.scopes import Scope


def followed(before: World, after: World, scope: Callable[[Model], Scope], only: str | None) -> World:
    """The world after its models were renamed, with its own joints, frames and the like following them.

    `before` has the models by their old names; `only` names the one model that was renamed, if it is one alone.
    """
    inner = {model.name: scope(model) for model in before.models if only in (None, model.name)}
    own: dict[str, dict[str, str]] = {part: {} for part in ("link", "joint", "frame", "model")}
    return with_followed(after, Scope("", own, inner), Format.SDF, DiagnosticSink())
