"""Files for Gazebo beside the model: a world around it, and the configuration of ros_gz_bridge."""

from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import click

from twinform.cli.flags import group
from twinform.cli.outputs import Output, Outputs
from twinform.cli.printing import show
from twinform.compiler import Conversion
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.reporters import FileFindings
from twinform.passes.plugins.release_names import ReleaseName
from twinform.schemas import parse_version

_WORLD = "default"
"""The name of the world that is written."""

release_option = click.option(
    "--gazebo",
    type=click.Choice(get_args(ReleaseName)),
    default="harmonic",
    help="The release of Gazebo that all is for: SDF is written in the newest version that it reads.",
)


def version_for(gazebo: str, asked: str | None) -> str:
    """Return the version of SDF for a release of Gazebo: the one that is asked for, or the newest that it reads."""
    from twinform.passes.plugins.catalog import release  # noqa: PLC0415 - few conversions need it

    newest = release(gazebo).sdf
    if asked is not None and parse_version(asked) > parse_version(newest):
        raise click.UsageError(f"Gazebo {gazebo} reads SDF up to {newest}, and --sdf-version is {asked}")
    return asked or newest


@dataclass(frozen=True, slots=True)
class GazeboFiles:
    """The files to write beside one model, and the release of Gazebo that they are for."""

    bridge: Path | None = None
    world: Path | None = None
    gazebo: str = "harmonic"

    def __bool__(self) -> bool:
        return self.bridge is not None or self.world is not None

    def places(self) -> Iterator[Output]:
        """Yield the files to write."""
        for by, path in (("--world", self.world), ("--bridge", self.bridge)):
            if path is not None:
                yield Output(by, path)

    def make(self, conversion: Conversion, name: str, outputs: Outputs, *, notes: bool) -> bool:
        """Add the files that are asked for to the outputs; return whether they could be made."""
        if not self:
            return True
        from twinform.compiler.gazebo_files import bridge_text, world_text  # noqa: PLC0415 - few conversions need it

        document, found = conversion.document, DiagnosticSink(file=name)
        if self.world is not None:
            # The model stands in the world file itself: libsdformat looks up includes only in its
            # own path, and did not find a file beside the world.
            outputs.add("--world", self.world, world_text(document, self.gazebo, found, _WORLD))
        if self.bridge is not None:
            world = _WORLD if self.world else None
            outputs.add("--bridge", self.bridge, bridge_text(document, self.gazebo, found, world))
        show(FileFindings(name, tuple(found.diagnostics)), notes=notes, on_stderr=True)
        return not found.has_errors


companion_options = group(
    "gazebo_files",
    GazeboFiles,
    release_option,
    click.option(
        "--world",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Write a world with the model in it, ground, light, and the systems that its sensors need.",
    ),
    click.option(
        "--bridge",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Write the file of ros_gz_bridge for the topics of the result.",
    ),
)
"""Gives a command the options for files beside the model."""
