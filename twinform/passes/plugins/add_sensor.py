"""Add a sensor to a link or joint, with the elements that its settings make."""

import tomllib
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib import resources
from itertools import count
from typing import Annotated, Any, ClassVar, Literal, Self, get_args

from lxml import etree
from pydantic import Field, model_validator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Element, Format, Joint, Link, Model, Opaque, Pose, Sensor, replace_node
from twinform.ir.frames import WORLD
from twinform.ir.node import NOT_CONTENT
from twinform.passes.carriers.carriers import from_xml
from twinform.passes.plugins.add_elements import (
    add_own_frame,
    add_sensor,
    find_model,
    own_frame_name,
    report_missing_target,
    set_frame_id,
    world_of,
)
from twinform.passes.plugins.catalog import releases, sensor, sensors
from twinform.passes.plugins.catalog_types import SensorKind
from twinform.passes.plugins.parameters import is_topic
from twinform.passes.plugins.plugin_options import Fields, SelectingPass
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import sensors_of
from twinform.passes.plugins.world_systems import (
    add_systems,
    has_element,
    has_system,
    report_needed_systems,
    requirements_of,
)
from twinform.passes.shared.nodes import unique_name
from twinform.schemas import XmlElement, format_value, table

_Number = Annotated[float, Field(allow_inf_nan=False)]
Finite = tuple[_Number, _Number, _Number]
Word = Annotated[str, Field(min_length=1)]


class AddSensor(SelectingPass):
    """Add a sensor of Gazebo to a link or joint, with settings that are usual for its kind.

    Every kind has options of its own, such as `width`, `fov`, `samples` or `gyro-stddev`; `docs/reference/plugins.md`
    lists them with what they are where they are not given. The topic is the kind's usual one: `imu` for an IMU called
    `imu`, else `NAME/imu`, and `NAME/image` for a camera.

    Changes:

    1. the link, or for `force_torque` the joint, that gets the sensor; in URDF it stands in a `<gazebo>` element, and a
       fixed joint that is measured is kept from being lumped;
    2. the model, which gets a frame where the sensor is, in URDF a link: `NAME_frame` with `xyz` or `rpy`, and
       `NAME_optical_frame`, which looks along z, for cameras without clouds; none where `frame-id` names another;
    3. the world around the model, which gets the system that the sensor needs, if it has none; and if it had no plugin
       at all, those that gz-sim adds only to such worlds.

    For a file without a world it reports what the world has to have; `convert --world FILE` writes such a world.
    Never touches: a sensor that is there: another one gets another name and topic, and the same one is not added
    again.
    Diagnostics: `nothing-to-add-to`, `missing-world-system`, `world-system-needed`, `added-world-system`.
    """

    name: ClassVar[str] = "add-sensor"
    example: ClassVar[str] = "add-sensor{type=camera link=mast rate=15 width=1280 height=720}"
    selector: ClassVar[str] = "type"

    type: str = Field(description="The kind of sensor: `imu`, `camera`, `gpu_lidar`, `navsat`, ...")
    link: str | None = Field(default=None, description="The link that it sits on.")
    joint: str | None = Field(default=None, description="The joint whose force and torque it measures.")
    sensor_name: Word | None = Field(default=None, description="Its name; by default that of its kind.")
    topic: str | None = Field(default=None, description="The topic that it publishes on.")
    rate: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = Field(
        default=None, description="How often it measures, in Hz; by default what is usual for its kind."
    )
    frame_id: Word | None = Field(
        default=None,
        description="The frame of its messages, for ROS; by default the link, and a frame of its own with `xyz` or "
        "`rpy`, or for a camera.",
    )
    xyz: Finite | None = Field(default=None, description="Where it is on its holder, in m.")
    rpy: Finite | None = Field(default=None, description="Its rotation on its holder: roll, pitch and yaw, in rad.")
    visualize: bool = Field(default=False, description="Whether the GUI shows it.")
    collision: str | None = Field(default=None, description="The collision of a contact sensor; by default all.")
    model: str | None = Field(default=None, description="The model to add to, where there are several.")
    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that has to support it.")

    @classmethod
    def fields_for(cls, word: str) -> Fields:
        """The options of a kind of sensor."""
        return dict(setting_fields(word))

    @model_validator(mode="after")
    def _check(self) -> Self:
        kind = sensor(self.type)
        if kind.type not in addable() or self.release not in kind.releases:
            have = ", ".join(each for each in releases() if each in kind.releases)
            raise ValueError(f"{self.release} does not simulate {kind.type}; releases that do: {have or 'none yet'}")
        wanted, other = ("joint", "link") if kind.holders == ("joint",) else ("link", "joint")
        if getattr(self, wanted) is None or getattr(self, other) is not None:
            raise ValueError(
                f"{kind.type} needs the option {wanted}" + (f", not {other}" if getattr(self, other) else "")
            )
        if self.topic is not None and not is_topic(self.topic):
            raise ValueError(f"{self.topic!r} is no topic")
        if self.collision is not None and kind.type != "contact":
            raise ValueError("only contact sensors look at a collision")
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with the sensor."""
        model = find_model(document, self.model, sink)
        holder = self._find_holder(model, document, sink) if model else None
        if model is None or holder is None:
            return document
        content = self._sensor_content(model, holder, document.format, sink)
        if sink.has_errors:
            return document
        made, is_new = self._choose_name(document, model, holder, content)
        world = world_of(document, model)
        if is_new:
            # libsdformat lumps links on fixed joints of URDF, and the joint goes with its sensor
            # unless <preserveFixedJoint> keeps it.
            kept = isinstance(holder, Joint) and holder.type == "fixed"
            new = add_sensor(model, holder.name, made, document.format, kept=kept)
            type_ = sensor(self.type).type
            own = own_frame_name(model, made, type_) if self.frame_id is None and self.link else None
            if own is not None:
                new = add_own_frame(new, own, made, type_, self.link or "", document.format)
            document = replace_node(document, model, new)
        # Nothing is added to a model without a world: a world system in a model works only until a
        # second model brings the same one. The finding has the line that the world needs instead.
        if world is None:
            report_needed_systems(made, sensor(self.type), holder.location, set(), sink)
            return document
        return self._add_to_world(document, world.name, made, sink)

    def _choose_name(
        self, document: Document, model: Model, holder: Link | Joint, content: tuple[Opaque, ...]
    ) -> tuple[Sensor, bool]:
        """The sensor with the first free name, and whether it is new; an equal sensor that is there keeps its name."""
        everywhere = list(sensors_of(document))
        here = [each for each, site in everywhere if site.model is model and site.link_or_joint == holder.name]
        taken, first = {each.name for each, _ in everywhere}, self.sensor_name or settings_of(self.type).name
        for number in count():
            made = self._make_sensor(f"{first}_{number}" if number else first, content, model)
            # A pipeline that runs twice must not add a second sensor under a numbered name.
            same = next((each for each in here if _content_of(each) == _content_of(made)), None)
            if same is not None or made.name not in taken:
                return made, same is None
        raise AssertionError  # there are more numbers than sensors

    def _find_holder(self, model: Model, document: Document, sink: DiagnosticSink) -> Link | Joint | None:
        word, name = ("joint", self.joint) if self.joint is not None else ("link", self.link)
        nodes: tuple[Link | Joint, ...] = model.joints if word == "joint" else model.links
        found = next((each for each in nodes if each.name == name), None)
        if found is None:
            report_missing_target(model, word, name, [each.name for each in nodes], sink)
        # libsdformat takes the link `world` of a URDF for the world itself and makes no link of it.
        elif word == "link" and name == WORLD and document.format is Format.URDF:
            message = "a sensor cannot be on the link 'world': Gazebo takes it for the world itself"
            sink.report(rules.NOTHING_TO_ADD_TO, message, found.location, found=name)
            return None
        return found

    def _sensor_content(
        self, model: Model, holder: Link | Joint, format_: Format, sink: DiagnosticSink
    ) -> tuple[Opaque, ...]:
        """The untyped elements in the sensor."""
        values = {option: getattr(self, option.replace("-", "_"), None) for option in self.fields_for(self.type)}
        is_contact = sensor(self.type).type == "contact"
        element = (
            self._contact_element(model, holder, format_, sink) if is_contact else settings_element(self.type, values)
        )
        return (Opaque(element=element),) if element is not None else ()

    def _make_sensor(self, name: str, content: tuple[Opaque, ...], model: Model) -> Sensor:
        kind, settings = sensor(self.type), settings_of(self.type)
        topic, is_contact = self.topic or usual_topic(kind, name, settings.name), kind.type == "contact"
        made = Sensor(
            name=name,
            type=kind.type,
            pose=Pose(xyz=self.xyz, rpy=self.rpy) if self.xyz or self.rpy else None,
            always_on=True,
            update_rate=self.rate or float(settings.rate),
            visualize=self.visualize or None,
            topic=None if is_contact else topic,
            opaque=tuple(map(_add_topic_to_contact(topic), content)) if is_contact else content,
        )
        frame = self.frame_id or (self.link and own_frame_name(model, made, kind.type)) or self.link
        return set_frame_id(made, frame, self.release) if frame else made

    def _contact_element(
        self, model: Model, holder: Link | Joint, format_: Format, sink: DiagnosticSink
    ) -> Element | None:
        names = list(_collision_names(holder, format_))
        if not names or (self.collision is not None and self.collision not in names):
            report_missing_target(model, "collision", self.collision, names, sink)
            return None
        chosen = [self.collision] if self.collision else names
        return Element(name="contact", children=tuple(Element(name="collision", text=each) for each in chosen))

    def _add_to_world(self, document: Document, name: str, made: Sensor, sink: DiagnosticSink) -> Document:
        world = next(each for each in document.worlds if each.name == name)
        needed = requirements_of(sensor(self.type))
        for element in needed.elements:
            if not has_element(world, element):
                message = f"sensor {made.name!r} needs <{element}>, and world {world.name!r} has none"
                sink.report(rules.MISSING_WORLD_SYSTEM, message, world.location, expected=element)
        lacks = [each for each in needed.systems if not has_system(world, each)]
        if not lacks:
            return document
        listed = ", ".join(each.class_name for each in lacks)
        sink.report(rules.ADDED_WORLD_SYSTEM, f"world {world.name!r} gets {listed}", world.location)
        return replace_node(document, world, add_systems(world, lacks))


def usual_topic(kind: SensorKind, name: str, usual: str) -> str:
    """The usual topic of a sensor of this name: short, and not shared with others."""
    if kind.element == "camera":
        return f"{name}/{kind.suffix}" if kind.suffix else name
    return kind.suffix if name == usual else f"{name}/{kind.suffix}"


def _add_topic_to_contact(topic: str) -> Callable[[Opaque], Opaque]:
    """A function that writes a topic into `<contact>`, where alone Gazebo reads it (contact/Contact.cc, Load)."""

    def change(part: Opaque) -> Opaque:
        if part.element is None or part.element.name != "contact":
            return part
        children = (*part.element.children, Element(name="topic", text=topic))
        return Opaque(element=part.element.copy(children=children))

    return change


def _collision_names(holder: Link | Joint, format_: Format) -> Iterator[str]:
    """The names of the collisions of a link; in URDF those that Gazebo gives to collisions without a name."""
    taken: set[str] = set()
    for each in holder.collisions if isinstance(holder, Link) else ():
        name = each.name or (unique_name(f"{holder.name}_collision", taken) if format_ is Format.URDF else None)
        if name is not None:
            taken.add(name)
            yield name


def _content_of(node: Sensor) -> object:
    return node.model_dump(exclude=set(NOT_CONTENT), exclude_defaults=True)


Noise = Literal["none", "typical"]

_TYPES: dict[str, Any] = {
    "integer": Annotated[int, Field(ge=1)],
    "number": Annotated[float, Field(allow_inf_nan=False)],
    "bool": bool,
    "text": str,
}
_STDDEV = Annotated[float | None, Field(ge=0, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True)
class Setting:
    """A value below the element of a sensor; an empty value is not written."""

    path: str
    type: str
    default: object
    text: str


@dataclass(frozen=True, slots=True)
class NoiseSetting:
    """The standard deviation of Gaussian noise on some quantities, with its typical value."""

    paths: tuple[str, ...]
    typical: float
    text: str


@dataclass(frozen=True, slots=True)
class SensorSettings:
    """What `add-sensor` knows about a kind of sensor: its usual name and rate in Hz, and its options."""

    name: str
    rate: float
    values: Mapping[str, Setting]
    noises: Mapping[str, NoiseSetting]


@cache
def settings_of(type_: str) -> SensorSettings:
    """The settings of a kind of sensor, by any of its names; empty for a kind that cannot be added.

    Raises:
        UnknownNameError: gz-sim simulates none of this type.
    """
    kind = sensor(type_)
    row = _settings_table().get(kind.type, {})
    return SensorSettings(
        name=row.get("name", kind.type),
        rate=row.get("rate", 0),
        values={option: Setting(*each) for option, each in row.get("settings", {}).items()},
        noises={option: NoiseSetting(tuple(each[0]), *each[1:]) for option, each in row.get("noise", {}).items()},
    )


def addable() -> tuple[str, ...]:
    """The kinds of sensors that can be added."""
    return tuple(type_ for type_ in sensors() if type_ in _settings_table())


@cache
def _settings_table() -> dict[str, Any]:
    file = resources.files("twinform.passes.plugins").joinpath("data", "sensor_settings.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def setting_fields(type_: str) -> Iterator[tuple[str, tuple[Any, Any]]]:
    """The options of a kind of sensor with their types and fields, for a Pydantic model."""
    settings = settings_of(type_)
    for option, each in settings.values.items():
        yield option, (_TYPES[each.type], Field(default=each.default, description=each.text))
    if settings.noises:
        text = "`typical` is what such a device usually has; one that is given counts."
        yield "noise", (Noise, Field(default=get_args(Noise)[0], description=text))
    for option, noise in settings.noises.items():
        text = f"{noise.text} Typical is {noise.typical:g}."
        optional: Any = Field(default=None, description=text)  # typed as its default
        yield option, (_STDDEV, optional)


def settings_element(type_: str, values: Mapping[str, object]) -> Element | None:
    """The element with the parameters of a sensor; None if it would be empty."""
    kind, settings = sensor(type_), settings_of(type_)
    root = etree.Element(kind.element)
    for option, setting in settings.values.items():
        value = values.get(option, setting.default)
        if value != "":
            _find_or_make(root, setting.path).text = format_value(value)
    for option, noise in settings.noises.items():
        stddev = values.get(option)
        if stddev is None and values.get("noise") == "typical":
            stddev = noise.typical
        if stddev is not None:
            for path in noise.paths:
                _write_noise(root, path, stddev, as_element=_has_one_noise(kind.element))
    return from_xml(root) if len(root) else None


def _has_one_noise(element: str) -> bool:
    """Whether the element of a sensor has a single `<noise>` with a type element, and not one for each quantity."""
    facts = table("sdf")
    rows = [row for row in facts.definitions["sensor"].children if row.name == element]
    return any(
        inner.name == "noise" and inner.exists_in(facts.newest) for row in rows for inner in facts.resolve(row).rows
    )


def _write_noise(root: XmlElement, path: str, stddev: object, *, as_element: bool) -> None:
    """Write Gaussian noise without bias; `path` is that of the quantity, or of the noise itself."""
    noise = _find_or_make(root, path if as_element else f"{path}/noise")
    if as_element:
        etree.SubElement(noise, "type").text = "gaussian"
    else:
        noise.set("type", "gaussian")
    etree.SubElement(noise, "mean").text = "0"
    etree.SubElement(noise, "stddev").text = format_value(stddev)


def _find_or_make(element: XmlElement, path: str) -> XmlElement:
    for step in path.split("/"):
        found = element.find(step)
        element = found if found is not None else etree.SubElement(element, step)
    return element
