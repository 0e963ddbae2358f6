"""Adding plugins and sensors to models and worlds, in the language that they are in."""

from collections.abc import Callable
from typing import TypeVar

from twinform.ir import Document, Format, GazeboExtension, Model, Node, Plugin, Sensor, World
from twinform.passes.plugins.elements import plugin_element, sensor_element

AnyNode = TypeVar("AnyNode", bound=Node)


def add_plugin(model: Model, plugin: Plugin, format_: Format) -> Model:
    """The model with one more plugin, after those that it has."""
    if format_ is Format.SDF:
        return model.model_copy(update={"plugins": (*model.plugins, plugin)})
    return _extended(model, GazeboExtension(content=(plugin_element(plugin),)))


def add_sensor(model: Model, holder: str, sensor: Sensor, format_: Format) -> Model:
    """The model with one more sensor on a link or joint of its own; a link where both have the name."""
    if format_ is Format.URDF:
        return _extended(model, GazeboExtension(reference=holder, content=(sensor_element(sensor),)))
    field = "links" if any(link.name == holder for link in model.links) else "joints"
    nodes = tuple(
        node.model_copy(update={"sensors": (*node.sensors, sensor)}) if node.name == holder else node
        for node in getattr(model, field)
    )
    return model.model_copy(update={field: nodes})


def add_world_plugin(world: World, plugin: Plugin) -> World:
    """The world with one more plugin."""
    return world.model_copy(update={"plugins": (*world.plugins, plugin)})


def replace_model(document: Document, old: Model, new: Model) -> Document:
    """The document with one model, wherever it is nested, replaced by another; models are told apart by identity."""

    def change(model: Model) -> Model:
        if model is old:
            return new
        models = _each(model.models, change)
        return model if models is model.models else model.model_copy(update={"models": models})

    def in_world(world: World) -> World:
        models = _each(world.models, change)
        return world if models is world.models else world.model_copy(update={"models": models})

    models, worlds = _each(document.models, change), _each(document.worlds, in_world)
    if models is document.models and worlds is document.worlds:
        return document
    return document.model_copy(update={"models": models, "worlds": worlds})


def _extended(model: Model, extension: GazeboExtension) -> Model:
    return model.model_copy(update={"extensions": (*model.extensions, extension)})


def _each(nodes: tuple[AnyNode, ...], change: Callable[[AnyNode], AnyNode]) -> tuple[AnyNode, ...]:
    made = tuple(map(change, nodes))
    return nodes if all(new is old for new, old in zip(made, nodes, strict=True)) else made
