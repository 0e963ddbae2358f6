"""Deferred edits: what migrated plugins change in the model or world around them, applied after all plugins."""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field

from twinform.ir import (
    Axis,
    Document,
    Format,
    GazeboExtension,
    Joint,
    Mimic,
    Model,
    Plugin,
    Sensor,
    World,
    replace_fields,
)
from twinform.ir.element import Element
from twinform.passes.plugins.add_elements import add_sensor, add_world_plugin
from twinform.passes.plugins.sites import PluginSite

Path = tuple[str, ...]
"""The names of the world, or nothing, and of the models on the way to one."""
Change = Callable[[Model], Model]


@dataclass(slots=True)
class DeferredEdits:
    """Changes to models, by their paths, and systems for worlds, by their names."""

    format: Format
    models: dict[Path, list[Change]] = field(default_factory=lambda: defaultdict(list))
    worlds: dict[str, list[Plugin]] = field(default_factory=lambda: defaultdict(list))

    def sensor(self, site: PluginSite, holder: str, sensor: Sensor) -> None:
        """Put a sensor on a link or joint."""
        self.models[path_of(site)].append(lambda model: _with_sensor(model, holder, sensor, self.format))

    def mimic(self, site: PluginSite, follower: str, mimic: Mimic) -> None:
        """Let a joint follow another."""
        self.models[path_of(site)].append(lambda model: _with_mimic(model, follower, mimic))

    def change(self, site: PluginSite, change: Change) -> None:
        """Do something else to a model."""
        self.models[path_of(site)].append(change)

    def run(self, document: Document) -> Document:
        """The document with everything done."""
        # Changes wait until all plugins are visited: the walk over plugins rebuilds the models, and
        # a change made in between would be of a model that is no longer part of the document.
        if not self.models and not self.worlds:
            return document
        models = tuple(self._model(model, ("",)) for model in document.models)
        worlds = tuple(self._world(world) for world in document.worlds)
        return document.copy(models=models, worlds=worlds)

    def _world(self, world: World) -> World:
        models = tuple(self._model(model, (world.name,)) for model in world.models)
        world = world.copy(models=models)
        for plugin in self.worlds.get(world.name, ()):
            world = add_world_plugin(world, plugin)
        return world

    def _model(self, model: Model, above: Path) -> Model:
        path = (*above, model.name)
        model = replace_fields(model, models=tuple(self._model(each, path) for each in model.models))
        for change in self.models.get(path, ()):
            model = change(model)
        return model


def path_of(site: PluginSite) -> Path:
    """The path of the model that a place is in."""
    return (site.world.name if site.world else "", *(model.name for model in site.models))


def _with_sensor(model: Model, holder: str, sensor: Sensor, format_: Format) -> Model:
    model = add_sensor(model, holder, sensor, format_)
    joint = next((each for each in model.joints if each.name == holder), None)
    if format_ is Format.SDF or joint is None or joint.type != "fixed" or _is_preserved(model, holder):
        return model
    # libsdformat merges links on fixed joints, and the joint goes with its sensor
    preserve = GazeboExtension(reference=holder, content=(Element(name="preserveFixedJoint", text="true"),))
    return model.copy(extensions=(*model.extensions, preserve))


def _is_preserved(model: Model, joint: str) -> bool:
    names = {"preserveFixedJoint", "disableFixedJointLumping"}
    return any(
        each.reference == joint and any(child.name in names for child in each.content) for each in model.extensions
    )


def _with_mimic(model: Model, follower: str, mimic: Mimic) -> Model:
    def follow(joint: Joint) -> Joint:
        if joint.name != follower:
            return joint
        return joint.copy(axis=(joint.axis or Axis()).copy(mimic=mimic))

    return model.copy(joints=tuple(map(follow, model.joints)))
