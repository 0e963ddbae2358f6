"""Write the configuration of ros_gz_bridge, as a file beside the result."""

from typing import Annotated, ClassVar

from pydantic import AfterValidator, Field

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.framework.side_files import CompanionPath, SideFilePass
from twinform.passes.plugins.bridge import bridge_yaml, bridges
from twinform.passes.plugins.release_names import ReleaseName


def _check_yaml_name(path: str) -> str:
    if not path.endswith((".yaml", ".yml")):
        raise ValueError("takes the name of a YAML file, which ends in .yaml or .yml")
    return path


class BridgeConfig(SideFilePass):
    """Write the YAML file that ros_gz_bridge needs to carry the topics of sensors and plugins to ROS and back.

    For the clock, each topic that a sensor or a system of the catalog writes, and each that a system reads, it has
    the names and messages on both sides and the direction. Names of ROS are short: `cmd_vel`, `odom`, `joint_states`,
    `imu`; with several models each has its own below the model's name. Transforms go to `/tf`.

    Changes nothing in the document. The file is written together with the result, below its folder, where there is
    no error; without `-o` there is no such folder. A file that is there is only replaced if it was written by twinform.
    `twinform convert --bridge FILE` writes the same for the result, into FILE.
    Never bridges: topics whose message ROS does not know, nor those whose name depends on an unknown world.
    Diagnostics: `unbridged-topic`.
    """

    name: ClassVar[str] = "bridge-config"
    example: ClassVar[str] = "bridge-config{file=bridge.yaml release=harmonic}"

    file: Annotated[CompanionPath, AfterValidator(_check_yaml_name)] = Field(
        description="Where to write it: a path below the folder of the result, ending in `.yaml` or `.yml`."
    )
    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that runs the model.")
    world: str | None = Field(default=None, description="The world that a model is put into; topics may contain it.")

    def text(self, document: Document, sink: DiagnosticSink) -> str:
        """The text of the file."""
        return bridge_yaml(bridges(document, self.release, sink, self.world))
