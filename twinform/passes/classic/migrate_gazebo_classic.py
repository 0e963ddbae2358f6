"""Migrate models and worlds from Gazebo Classic to gz-sim."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Document, Format, Model
from twinform.passes.carriers.carriers import declare_carriers
from twinform.passes.classic.document_edits import (
    DeferredEdits,
    complete_worlds,
    convert_material_scripts,
    include_from_fuel,
    remove_emptied,
    rename_hardware,
    report_needs,
    report_unread,
)
from twinform.passes.classic.migrate_sensors import SensorMigration
from twinform.passes.classic.moving import accept_trial, trial_sink
from twinform.passes.classic.plugins import PluginMigration
from twinform.passes.framework.pass_base import Pass
from twinform.passes.joints.ros2_control_from_transmissions import Ros2ControlFromTransmissions
from twinform.passes.plugins.catalog import release
from twinform.passes.plugins.catalog_types import Release
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import map_plugins, map_sensors
from twinform.passes.sdf_versions import change_version, sdf_version_read
from twinform.schemas import parse_version

_HARDWARE = "gz_ros2_control/GazeboSimSystem"
_HARDWARE_BEFORE = "ign_ros2_control/IgnitionSystem"


class MigrateGazeboClassic(Pass):
    """Turn models and worlds for Gazebo Classic into such for gz-sim, in URDF and in SDF.

    Changes:

    1. plugins of Gazebo Classic, gazebo_ros_pkgs and packages around it: systems of gz-sim take their place, with the
       parameters under their new names and in their new units, and with the topics that they had in ROS, namespaces
       and remappings included;
    2. sensors: plugins in them go and leave topic, frame, rate, noise and lens behind; types have their names of now
       (`ray` is `gpu_lidar`, `gps` is `navsat`, `depth` with a plugin for point clouds is `rgbd_camera`); one with
       several cameras is divided; sensors that were plugins of the model are made;
    3. plugins that couple joints: they become `<mimic>`;
    4. controllers: `gz_ros2_control` takes the place of gazebo_ros_control, and transmissions become `<ros2_control>`;
    5. names of Ignition become those of Gazebo, but for Fortress, which has them;
    6. models that came with Gazebo Classic are included from Fuel;
    7. worlds get the systems that their sensors need, and all default systems once one is written;
    8. material scripts become colors, by the pass `materials`;
    9. SDF that is older is upgraded to the version that the release reads.

    Never touches: plugins that are neither of Gazebo Classic nor of gz-sim, and parts of worlds that gz-sim skips; it
    lists these.
    Diagnostics: `migrated-plugin`, `migrated-sensor`, `ignition-name`, `shipped-model` and `added-world-system` for
    what was done; `plugin-without-counterpart`, `parameter-without-counterpart`, `sensor-without-counterpart`,
    `unread-world-part` and `unknown-plugin` for what could not be; `incomplete-migration` and `world-system-needed` for
    what is left to do; and what `ros2-control-from-transmissions` does. The ledger has every plugin and parameter.
    """

    name = "migrate-gazebo-classic"
    example: ClassVar[str] = "migrate-gazebo-classic{release=harmonic}"

    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that the result is for.")
    keep: bool = Field(default=False, description="Whether plugins without a counterpart stay.")
    controllers: str | None = Field(
        default=None, min_length=1, description="The file with the controllers' parameters, for gz_ros2_control."
    )

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document for gz-sim."""
        target, raising = release(self.release), trial_sink(sink)
        # <mimic>, <lidar> and <frame_id> are syntax of newer versions than most files for Gazebo
        # Classic have, so the version is raised first, by the steps of `--sdf-version`. Older
        # releases of gz-sim read no newer version than their own.
        raised = _raise_version(document, target, raising)
        migrating = trial_sink(sink)
        changed = raised if raising.has_errors else self._migrate(raised, target, migrating)
        if raising.has_errors or changed is not raised:
            accept_trial(sink, raising)
        accept_trial(sink, migrating)
        if changed is raised:
            return document
        carried = any(entry.fate is Fate.CARRIED for entry in sink.entries)
        return declare_carriers(changed) if carried else changed

    def _migrate(self, document: Document, target: Release, sink: DiagnosticSink) -> Document:
        # Sensors first: they take the plugins that belong to them, and what is left are plugins of
        # models and worlds.
        edits = DeferredEdits(document.format)
        sensed = map_sensors(document, SensorMigration(target, sink))
        migration = PluginMigration(
            release=target,
            format=document.format,
            sink=sink,
            edits=edits,
            keep=self.keep,
            controllers=self.controllers,
            control=lambda model: self._add_ros2_control(model, document.format, sink),
        )
        done = edits.run(remove_emptied(sensed, map_plugins(sensed, migration)))
        done = include_from_fuel(rename_hardware(done, target, sink), sink)
        # Worlds are completed after all plugins and sensors have their new form, since the systems
        # that they need follow from these.
        done = convert_material_scripts(complete_worlds(done, target, sink), sink)
        if done is not document:
            report_needs(done, target, sink)
        report_unread(done, sink)
        return done

    def _add_ros2_control(self, model: Model, format_: Format, sink: DiagnosticSink) -> Model:
        hardware = _HARDWARE_BEFORE if self.release == "fortress" else _HARDWARE
        return Ros2ControlFromTransmissions(hardware=hardware).convert(model, format_, sink)


def _raise_version(document: Document, target: Release, sink: DiagnosticSink) -> Document:
    """An SDF document, raised to the version that the release reads if it is older."""
    if document.format is Format.URDF:
        return document
    if parse_version(sdf_version_read(document.version)) >= parse_version(target.sdf):
        return document
    for step in change_version(document.version, target.sdf):
        document = step.run(document, sink)
    return document
