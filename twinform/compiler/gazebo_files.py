"""Files to run a model in Gazebo: a world around it, and the configuration of ros_gz_bridge."""

from importlib import resources

from twinform.compiler.input.loading import loads
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Element, Format, Model, Opaque, Pose, World
from twinform.passes.plugins.bridge_config import bridge_yaml, bridges
from twinform.passes.plugins.sites import sensors_of
from twinform.passes.plugins.wheels import lowest_point
from twinform.passes.plugins.world_systems import (
    WorldRequirements,
    add_default_systems,
    add_systems,
    kind_of_sensor,
    requirements_of,
    systems_needed_by_plugins,
)

# Satellite receivers need some place on earth; as long as none is given, any is as good.
_EQUATOR = (
    ("surface_model", "EARTH_WGS84"),
    ("world_frame_orientation", "ENU"),
    ("latitude_deg", "0"),
    ("longitude_deg", "0"),
    ("elevation", "0"),
    ("heading_deg", "0"),
)


def bridge_text(document: Document, release: str, sink: DiagnosticSink, world: str | None = None) -> str:
    """Write the YAML file of ros_gz_bridge for a document."""
    return bridge_yaml(bridges(document, release, sink, world))


def world_text(document: Document, release: str, sink: DiagnosticSink, name: str) -> str:
    """Write an SDF file with a world around the model of a document, so that it runs by itself.

    The model stands on the ground if it has no pose and its collisions show how deep it reaches. The world has light,
    ground, the systems that gz-sim adds to worlds without any, and those that the sensors and plugins need.
    """
    if document.worlds or document.format is not Format.SDF or len(document.models) != 1:
        message = "a world is written around one model of SDF"
        sink.report(rules.NOTHING_TO_ADD_TO, message, document.location)
        return ""
    template, world = _world(document, release, name)
    world = world.copy(models=(*world.models, _on_the_ground(document.models[0])))
    namespaces, version = document.namespaces, document.version
    return emit(template.copy(worlds=(world,), version=version, namespaces=namespaces), sink)


def world_without_text(document: Document, release: str, sink: DiagnosticSink, name: str) -> str:
    """Write an SDF file with a world for the models of a document, URDF or SDF, without the models themselves."""
    template, world = _world(document, release, name)
    return emit(template.copy(worlds=(world,)), sink)


def _world(document: Document, release: str, name: str) -> tuple[Document, World]:
    """Return an empty file, and a world with light, ground, and what the models of a document need."""
    template = loads(resources.files("twinform.compiler").joinpath("world.sdf").read_bytes())
    needed = _needed(document, release)
    world = add_systems(add_default_systems(template.worlds[0].copy(name=name)), needed.systems)
    return template, _with_place(world) if "spherical_coordinates" in needed.elements else world


def _on_the_ground(model: Model) -> Model:
    # A pose that the author wrote is where the model is meant to be.
    depth = lowest_point(model) if model.pose is None and not model.static else None
    return model if not depth else model.copy(pose=Pose(xyz=(0.0, 0.0, round(-depth, 9))))


def _needed(document: Document, release: str) -> WorldRequirements:
    """Return what the sensors and plugins of a document need from their world."""
    kinds = [kind_of_sensor(sensor, release) for sensor, _ in sensors_of(document)]
    all_ = [requirements_of(kind) for kind in dict.fromkeys(kinds) if kind is not None]
    systems = dict.fromkeys(system for each in all_ for system in each.systems)
    systems |= dict.fromkeys(systems_needed_by_plugins(document, None, release))
    elements = dict.fromkeys(element for each in all_ for element in each.elements)
    return WorldRequirements(tuple(systems), tuple(elements))


def _with_place(world: World) -> World:
    children = tuple(Element(name=name, text=text) for name, text in _EQUATOR)
    place = Opaque(element=Element(name="spherical_coordinates", children=children))
    return world.copy(opaque=(*world.opaque, place))
