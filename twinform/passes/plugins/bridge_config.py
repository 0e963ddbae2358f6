"""Write the configuration of ros_gz_bridge."""

from pathlib import Path
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import Notes
from twinform.diagnostics.rules import plugins as rules
from twinform.ir import Document
from twinform.passes.base import Pass
from twinform.passes.plugins.bridge import bridge_yaml, bridges
from twinform.passes.plugins.parts import ReleaseName


class BridgeConfig(Pass):
    """Writes the YAML file that ros_gz_bridge needs to carry the topics of sensors and plugins to ROS and back.

    For the clock, each topic that a sensor or a system of the catalogue writes, and each that a system reads, it has
    the names and messages on both sides and the direction. Names of ROS are short: `cmd_vel`, `odom`, `joint_states`,
    `imu`; with several models each has its own below the model's name. Transforms go to `/tf`.

    It changes nothing in the document. The file is written when the pass runs, whatever becomes of the conversion;
    `twinform convert --bridge FILE` writes the same for the result, if there is one.
    It never bridges topics whose message ROS does not know, nor those whose name depends on an unknown world.
    Diagnostics: `unbridged-topic`, `unwritten-file`.
    """

    name: ClassVar[str] = "bridge-config"
    example: ClassVar[str] = "bridge-config{file=bridge.yaml release=harmonic}"

    file: str = Field(min_length=1, description="Where to write it.")
    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that runs the model.")
    world: str | None = Field(default=None, description="The world that a model is put into; topics may contain it.")

    def run(self, document: Document, notes: Notes) -> Document:
        """The same document."""
        text = bridge_yaml(bridges(document, self.release, notes, self.world))
        try:
            Path(self.file).write_text(text, encoding="utf-8")
        except (OSError, ValueError) as error:
            message = f"{self.file} cannot be written: {getattr(error, 'strerror', None) or error}"
            notes.report(rules.UNWRITTEN_FILE, message, found=self.file)
        return document
