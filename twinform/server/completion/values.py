"""Completion of values: for attributes and texts, by the row of the facts tables or the element that they belong to."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

from twinform.compiler.input.root_names import MJCF
from twinform.compiler.mistakes.control_checks import (
    HARDWARE,
    HARDWARE_INTERFACES,
    INTERFACES,
    SENSOR_INTERFACES,
    TRANSMISSIONS,
)
from twinform.compiler.named_files import IMAGES, MESHES
from twinform.passes.appearance.materials import classic_materials
from twinform.passes.shared.gazebo_tags import JOINT_TAGS, LINK_TAGS, SCRIPT_URI, TRUTHS
from twinform.server.completion.files import (
    HEIGHTMAPS,
    MODELS,
    SOUNDS,
    XACROS,
    propose_files,
)
from twinform.server.completion.names import propose_names
from twinform.server.completion.plugins import (
    BOOLS,
    propose_classes,
    propose_files_of_plugins,
    propose_values_of_parameter,
)
from twinform.server.completion.proposals import ITEM, Proposal, ValuePlace, values
from twinform.server.completion.xacro import VALUES as VALUES_OF_XACRO
from twinform.server.mapping import MappingRow

Provider = Callable[[ValuePlace], Iterator[Proposal]]
_AXES = ("1 0 0", "0 1 0", "0 0 1")
_TRUTH_TAGS = frozenset(name for name, tag in (LINK_TAGS | JOINT_TAGS).items() if tag.read in TRUTHS)


def _fixed(*words: str) -> Provider:
    return lambda _: iter(tuple(values(words)))


def _materials(_: ValuePlace) -> Iterator[Proposal]:
    yield from values(classic_materials(), ITEM.Color)


def _interfaces(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the interfaces that a joint or sensor of `<ros2_control>` can have and does not have yet."""
    holder = place.node.parent
    if holder is None or holder.tag == "gpio":
        return
    there = {each.get("name") for each in holder.children if each is not place.node and each.tag == place.node.tag}
    names = SENSOR_INTERFACES if holder.tag == "sensor" else INTERFACES
    yield from values((each for each in names if each not in there), ITEM.Field)


def _parameters_of_control(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the parameters that ros2_control itself reads of an interface."""
    holder = place.node.parent
    if holder is not None:
        names = {"command_interface": ("min", "max"), "state_interface": ("initial_value",)}.get(holder.tag, ())
        there = {each.get("name") for each in holder.children if each is not place.node}
        yield from values(each for each in names if each not in there)


def _collisions(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the collisions of the link around, of which a contact sensor may hear."""
    link = place.node.parent
    while link is not None and link.tag != "link":
        link = link.parent
    names = (each.get("name") for each in link.children if each.tag == "collision") if link is not None else ()
    yield from values(filter(None, names), ITEM.Reference)


def _versions(place: ValuePlace) -> Iterator[Proposal]:
    table = place.document.schema.table
    yield from values(reversed(table.versions) if table is not None else ())


def _files_of(endings: tuple[str, ...]) -> Provider:
    return partial(propose_files, endings=endings)


def _files_beside(place: ValuePlace) -> Iterator[Proposal]:
    """Propose files for `include` of MJCF, which knows no schemes."""
    return (each for each in propose_files(place, endings=MJCF) if "://" not in each.label)


_BY_ROW: Mapping[str, Provider] = {
    "robot/@version": _versions,
    "sdf/@version": _versions,
    "geometry/mesh/@filename": _files_of(MESHES),
    "mesh_shape/uri": _files_of(MESHES),
    "actor/skin/filename": _files_of(MESHES),
    "actor/animation/filename": _files_of(MESHES),
    "material/texture/@filename": _files_of(IMAGES),
    "heightmap_shape/uri": _files_of(HEIGHTMAPS),
    "audio_source/uri": _files_of(SOUNDS),
    "include/uri": _files_of(MODELS),
    "joint/axis/@xyz": _fixed(*_AXES),
    "axis/xyz": _fixed(*_AXES),
    "plugin/@filename": propose_files_of_plugins,
    "plugin/@name": propose_classes,
    "control_interface/@name": _interfaces,
    "param/@name": _parameters_of_control,
    "ros2_control/hardware/plugin": _fixed(*HARDWARE),
    "ros2_control/transmission/plugin": _fixed(*TRANSMISSIONS),
    "transmission/type": _fixed(*TRANSMISSIONS),
    "transmission_joint/hardwareInterface": _fixed(*HARDWARE_INTERFACES),
    "transmission_actuator/hardwareInterface": _fixed(*HARDWARE_INTERFACES),
    "contact/collision": _collisions,
    "spherical_coordinates/surface_model": _fixed("EARTH_WGS84"),
    "material/script/name": _materials,
    "material/script/uri": _fixed(SCRIPT_URI),
    "physics/@type": _fixed("ode", "dart", "bullet", "simbody"),
}
"""What is proposed for values of rows of the facts tables, beside what the tables say."""
_MAPS = frozenset({
    "albedo_map", "normal_map", "roughness_map", "metalness_map", "environment_map", "ambient_occlusion_map",
    "emissive_map", "light_map", "specular_map", "glossiness_map",
})  # fmt: skip
_BY_ELEMENT: Mapping[tuple[str, str | None], Provider] = {
    ("xacro:include", "filename"): _files_of(XACROS),
    ("include", "file"): _files_beside,
    ("material", None): _materials,
    **VALUES_OF_XACRO,
    **{(name, None): _files_of(IMAGES) for name in _MAPS},
    **{(name, None): _fixed(*BOOLS) for name in _TRUTH_TAGS},
}
"""The same for elements that no row says all of: those of xacro, tags in `<gazebo>`, and textures."""


def propose_values(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the values of an attribute or of the text of an element."""
    row = place.document.schema.row(place.node, place.attribute)
    own = _BY_ROW.get(row.path) if row is not None else None
    own = own or _BY_ELEMENT.get((place.node.tag, place.attribute))
    if own is not None:
        yield from own(place)
    yield from values(_written_in(row) if row is not None else ())
    yield from propose_names(place)
    yield from propose_values_of_parameter(place)


def _written_in(row: MappingRow) -> tuple[str, ...]:
    """Return the values that a table has for a row: its words, or its default."""
    fact = row.fact
    # a default such as `__default__` stands for nothing that could be written
    default = (fact.default,) if fact.default and "_" not in fact.default else ()
    # no engine of Gazebo has continuous joints
    words = tuple(each for each in fact.enum if (row.format, each) != ("sdf", "continuous"))
    return words or (BOOLS if fact.type == "bool" else default)
