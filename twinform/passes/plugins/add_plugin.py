"""Add a system of gz-sim to a model or world."""

from collections.abc import Iterable, Mapping
from typing import ClassVar, Self, cast

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir import Document, Model, Plugin, Sensor, World, replace_node
from twinform.passes.plugins.add_elements import (
    add_plugin,
    add_visual_plugin,
    add_world_plugin,
    find_model,
    find_world,
    report_missing_target,
    world_of,
)
from twinform.passes.plugins.catalog import releases, suggestion, system
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.passes.plugins.parameters import names_in
from twinform.passes.plugins.plugin_options import Fields, MissingError, SelectingPass, content_of, field_of, options_of
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import PluginSite, map_sensors
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError, base_link
from twinform.passes.plugins.world_systems import (
    add_default_systems,
    add_systems,
    missing_system_for,
    system_plugin,
    system_xml,
)

_ODOMETRY_FRAMES = (("frame-id", "child-frame-id"), ("odom-frame", "robot-base-frame"))
"""The options of systems that report odometry: the frame that it is in, and that of the model."""


class AddPlugin(SelectingPass):
    """Add a system of gz-sim to a model or world, with parameters that are checked against the catalog.

    Every parameter of the system is an option, called in kebab-case: `left_joint` is `left-joint`, the `link` in
    `left_track` is `left-track-link`. `docs/reference/plugins.md` lists the systems and their options. One that may
    stand several times takes a list.

    Changes:

    1. the model (`model`, or the only one), for systems of models;
    2. the world (`world`, or the only one), for systems of worlds; one without any plugin gets those too that gz-sim
       would have added;
    3. the sensor `on`, or the visual or all visuals of the link `on`, for systems of these.

    Wheel separation, wheel radius and wheel base, and how far tracks are apart, are read off the model where they are
    not given: from the joints' places and axes, and the cylinders, spheres and capsules of the wheels.
    Frames of odometry that are not given are `odom` and the base link, so that the transforms of ROS make one tree.
    A system that needs another one of the world, such as Buoyancy, gets it there; without a world it is reported.
    Never touches: a plugin that is there; one that is the same already is not added again.
    Diagnostics: `nothing-to-add-to`, `plugin-reference`, `measured-wheels`, `wheels-not-measured`,
    `world-system-needed`, `added-world-system`.
    """

    name: ClassVar[str] = "add-plugin"
    example: ClassVar[str] = "add-plugin{system=diff-drive left-joint=left_wheel_joint right-joint=right_wheel_joint}"
    selector: ClassVar[str] = "system"

    system: str = Field(description="The system, such as `diff-drive` or `joint-state-publisher`.")
    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo to check against.")
    model: str | None = Field(
        default=None, description="The model to add to, where there are several; `a::b` if nested."
    )
    world: str | None = Field(default=None, description="The world to add to, where there are several.")
    on: str | None = Field(default=None, description="The sensor, visual or link of visuals that it is for.")

    @classmethod
    def fields_for(cls, word: str) -> Fields:
        """The options of a system."""
        # The options are fields of a class that is made for the chosen system: 667 parameters over
        # 81 systems. As free text they would have no types, no defaults and no place in a message.
        kind = system(word)
        return {option: field_of(path, row, kind) for option, (path, row) in options_of(kind).items()}

    @model_validator(mode="after")
    def _check_release(self) -> Self:
        kind = self._kind()
        if self.release not in kind.releases:
            have = ", ".join(each for each in releases() if each in kind.releases)
            raise ValueError(f"{kind.name} is not in {self.release}; it is in {have or 'no release yet'}")
        for option in self._given_options():
            if self.release not in options_of(kind)[option][1].releases:
                raise ValueError(f"{kind.name} does not read {option} in {self.release}")
        for option, (_, row) in options_of(kind).items():
            if self.release in row.needed and option not in self._given_options():
                raise ValueError(f"{kind.name} needs the option {option} in {self.release}")
        try:
            content_of(kind, self._given_options())
        except MissingError as error:
            raise ValueError(f"{kind.name} needs the option {error}") from error
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with the plugin."""
        kind = self._kind()
        if "model" in kind.scopes and self.on is None:
            return self._add_to_model(document, sink)
        if "world" in kind.scopes:
            return self._add_to_world(document, sink)
        return self._add_to_sensor(document, sink) if "sensor" in kind.scopes else self._add_to_visual(document, sink)

    def _add_to_model(self, document: Document, sink: DiagnosticSink) -> Document:
        model = find_model(document, self.model, sink)
        if model is None or not self._check_references(model, sink):
            return document
        plugin = self._make_plugin(
            {**self._measure_missing(model, document, sink), **self._odometry_frames(model, document)}
        )
        if sink.has_errors:
            return document
        made = replace_node(document, model, add_plugin(model, plugin, document.format))
        return self._add_needed_system(made, model, world_of(document, model), sink)

    def _add_needed_system(
        self, document: Document, model: Model, world: World | None, sink: DiagnosticSink
    ) -> Document:
        """The document with the system that the world needs for the plugin to work."""
        needed = missing_system_for(self._kind(), world)
        if needed is None:
            return document
        if world is None:
            message = f"{self._kind().class_name} needs {needed.class_name} in the world"
            help_ = f"the world needs {system_xml(needed)}"
            sink.report(rules.WORLD_SYSTEM_NEEDED, message, model.location, help=help_)
            return document
        message = f"world {world.name!r} gets {needed.class_name}"
        sink.report(rules.ADDED_WORLD_SYSTEM, message, world.location)
        # The plugin was added to a model in it, so the world is a new object by now.
        now = next(each for each in document.worlds if each.name == world.name)
        return replace_node(document, now, add_systems(now, [needed]))

    def _add_to_world(self, document: Document, sink: DiagnosticSink) -> Document:
        world = find_world(document, self.world, sink)
        if world is None:
            return document
        made = add_world_plugin(add_default_systems(world, self._kind()), self._make_plugin({}))
        return document if made is world else replace_node(document, world, made)

    def _add_to_sensor(self, document: Document, sink: DiagnosticSink) -> Document:
        plugin, seen = self._make_plugin({}), list[str]()

        def change(sensor: Sensor, _: PluginSite) -> Iterable[Sensor]:
            seen.append(sensor.name or "")
            if sensor.name != self.on or plugin in sensor.plugins:
                return (sensor,)
            return (sensor.copy(plugins=(*sensor.plugins, plugin)),)

        made = map_sensors(document, change)
        if self.on not in seen:
            report_missing_target(document, "sensor", self.on, seen, sink)
        return made

    def _add_to_visual(self, document: Document, sink: DiagnosticSink) -> Document:
        model = find_model(document, self.model, sink)
        if model is None:
            return document
        made = add_visual_plugin(model, self.on or "", self._make_plugin({}), document.format)
        if made is None:
            names = [link.name for link in model.links]
            report_missing_target(document, "visual or link", self.on, names, sink)
            return document
        return replace_node(document, model, made)

    def _kind(self) -> PluginKind:
        return system(self.system)

    def _given_options(self) -> dict[str, object]:
        """The options of the system that have a value."""
        written = {option: getattr(self, option.replace("-", "_"), None) for option in options_of(self._kind())}
        return {option: value for option, value in written.items() if value is not None}

    def _make_plugin(self, measured: Mapping[str, object]) -> Plugin:
        kind = self._kind()
        content = content_of(kind, {**self._given_options(), **measured})
        plugin = system_plugin(kind)
        return plugin.copy(content=content) if content else plugin

    def _check_references(self, model: Model, sink: DiagnosticSink) -> bool:
        """Whether all joints and links that options name exist; reports those that do not."""
        good = True
        for option, value in self._given_options().items():
            row = options_of(self._kind())[option][1]
            known = names_in(model, row.type) if row.type in {"joint", "link"} else None
            if known is None:
                continue
            named = cast("tuple[str, ...]", value) if isinstance(value, tuple) else (str(value),)
            for name in [each for each in named if each not in known]:
                message = f"{option}: model {model.name!r} has no {row.type} {name!r}"
                help_ = suggestion(name, sorted(known))
                sink.report(
                    rules.PLUGIN_REFERENCE, message, model.location, found=name, help=help_, severity=Severity.ERROR
                )
                good = False
        return good

    def _odometry_frames(self, model: Model, document: Document) -> dict[str, object]:
        """The odometry frames by their names in ROS, if not given: Gazebo's contain the name of the model."""
        base, options = base_link(model, document.format), options_of(self._kind())
        for frame, child in _ODOMETRY_FRAMES:
            if base is not None and {frame, child} <= options.keys():
                return {
                    option: name
                    for option, name in ((frame, "odom"), (child, base))
                    if option not in self._given_options()
                }
        return {}

    def _measure_missing(self, model: Model, document: Document, sink: DiagnosticSink) -> dict[str, object]:
        """Values for options that are not given, measured on the model."""
        kind, found = self._kind(), dict[str, object]()

        def names(option: str) -> tuple[str, ...]:
            return cast("tuple[str, ...]", self._given_options().get(option, ()))

        measured = Measured(model, document.format, names)
        for parameter, measure in MEASURES.get(kind.name, {}).items():
            option = parameter.replace("_", "-")
            if option in self._given_options() or self._given_options().get("steering-only"):
                continue
            try:
                found[option] = measure(measured)
            except NotMeasuredError as error:
                message = f"{option} is not given, and cannot be read off model {model.name!r}: {error}"
                sink.report(rules.WHEELS_NOT_MEASURED, message, model.location)
        if found:
            listed = ", ".join(f"{option} {value:g} m" for option, value in found.items())
            sink.report(rules.MEASURED_WHEELS, f"read off model {model.name!r}: {listed}", model.location)
        return found
