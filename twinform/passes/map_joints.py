"""Change the joints of a document, wherever they are."""

from collections.abc import Callable
from typing import TypeVar

from twinform.ir import Document, Joint, Model, Node, World

Change = Callable[[Joint], Joint]
N = TypeVar("N", bound=Node)


def map_joints(document: Document, change: Change) -> Document:
    """The document with every joint changed; parts in which no joint changed are the same objects as before."""
    models = _map(document.models, lambda model: _in_model(model, change))
    worlds = _map(document.worlds, lambda world: _in_world(world, change))
    if models is document.models and worlds is document.worlds:
        return document
    return document.model_copy(update={"models": models, "worlds": worlds})


def _in_world(world: World, change: Change) -> World:
    joints, models = _map(world.joints, change), _map(world.models, lambda model: _in_model(model, change))
    if joints is world.joints and models is world.models:
        return world
    return world.model_copy(update={"joints": joints, "models": models})


def _in_model(model: Model, change: Change) -> Model:
    joints, models = _map(model.joints, change), _map(model.models, lambda nested: _in_model(nested, change))
    if joints is model.joints and models is model.models:
        return model
    return model.model_copy(update={"joints": joints, "models": models})


def _map(nodes: tuple[N, ...], change: Callable[[N], N]) -> tuple[N, ...]:
    changed = tuple(map(change, nodes))
    same = all(new is old for new, old in zip(changed, nodes, strict=True))
    return nodes if same else changed
