"""`twinform package`."""

from pathlib import Path

import click

from twinform.cli.command import Command
from twinform.cli.completion import files
from twinform.cli.config.per_file import RuleSettings
from twinform.cli.details import detail_options, details_of
from twinform.cli.gazebo_files import release_option, version_for
from twinform.cli.inputs import inputs, reading_options
from twinform.cli.own_options import OptionsByFile
from twinform.cli.packaging import Packaging, run_packaging
from twinform.cli.policy import policy_options
from twinform.cli.print_findings import all_option, notes_option
from twinform.cli.request import passes_of, request_options_of_versions, whole_request
from twinform.compiler import ConversionRequest
from twinform.compiler.input.load_options import ReadingOptions
from twinform.compiler.packaging.kind_names import KIND_NAMES, kinds_of
from twinform.compiler.packaging.order import Order, PackageDetails
from twinform.compiler.request_options import RequestOptions
from twinform.passes.plugins.release_names import ReleaseName

EXAMPLES = {
    "Make a model folder for Gazebo": "twinform package robot.urdf -o robot --kind gazebo-model",
    "Let older Gazebo read it too": "twinform package robot.urdf -o robot --kind gazebo-model --sdf-version 1.11 "
    "--sdf-version 1.6",
    "Make a package for ROS 2": "twinform package robot.urdf -o robot_description --kind ros2",
    "Make one folder for both, with Fortress and Humble": "twinform package robot.urdf -o robot_description "
    "--kind both --gazebo fortress",
    "List its files, and write nothing": "twinform package robot.urdf -o robot --kind gazebo-model --dry-run",
}


@click.command("package", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option(
    "-o",
    "--output",
    "folder",
    metavar="DIR",
    required=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="The folder of the package. Gazebo finds a model by the name of its folder.",
)
@click.option(
    "--kind",
    type=click.Choice(KIND_NAMES),
    required=True,
    help="A model folder for Gazebo, a package for ROS 2, or one folder that is both.",
)
@click.option("--name", metavar="NAME", help="What the package is called; else as its folder.")
@detail_options
@request_options_of_versions
@release_option
@click.option("--model", metavar="NAME", help="The model of the file to put into the package.")
@click.option(
    "--allow-missing", is_flag=True, help="Go on without files that are not found; their URIs stay as they are."
)
@click.option("--thumbnail/--no-thumbnail", default=True, help="Whether to draw a picture of the model.")
@click.option("--force", is_flag=True, help="Write over files that twinform has not put into DIR.")
@click.option("--dry-run", is_flag=True, help="Write nothing, and print the files of the package.")
@click.option(
    "--ledger", type=click.Path(path_type=Path), metavar="FILE", help="Where to write what was not expressed."
)
@notes_option
@all_option
@policy_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    folder: Path,
    kind: str,
    name: str | None,
    *,
    sdf_versions: tuple[str, ...],
    gazebo: ReleaseName,
    model: str | None,
    allow_missing: bool,
    thumbnail: bool,
    force: bool,
    dry_run: bool,
    ledger: Path | None,
    notes: bool,
    every: bool,
    details: PackageDetails,
    request: RequestOptions,
    rules: RuleSettings,
    reading: ReadingOptions,
) -> None:
    """Put a model and all its files into a folder.

    IN is a URDF, SDF, xacro or JSON file. Its meshes, textures and scripts, and what these name themselves, are copied
    into DIR, each once, and all URIs lead there. Of a world, each model gets a folder. Who made the model, its license
    and its version are those of the package.xml or model.config around IN, where no option says it. The folder is
    written at once, or, where there is an error, not at all. Exit code: 0 without errors, 1 with errors, 2 where a file
    could not be read or written.
    """
    sources, arguments = inputs(words)
    if len(sources) > 1:
        raise click.UsageError("package takes one input")
    own = OptionsByFile(ctx, arguments, reading, rules, passes_of(request)).of(sources[0].name)
    whole = whole_request(request, reading, passes=own.passes, model=model)
    title = folder.resolve().name
    if kind == "both" and name is not None and name != title:
        raise click.UsageError(f"--name {name}: ROS looks for a package by its name, and Gazebo by that of its folder, "
                               f"which is {title}; for both they have to be the same")  # fmt: skip
    order = Order(
        source=sources[0].content,
        source_name=sources[0].name,
        name=name or title,
        folder=title,
        conversion=ConversionRequest.of("sdf", whole),
        load_options=own.load_options,
        sdf_versions=tuple(dict.fromkeys(version_for(gazebo, each) for each in sdf_versions or (None,))),
        release=gazebo,
        details=details_of(details, sources[0].content),
        allow_missing=allow_missing,
        thumbnail=thumbnail,
    )
    packaging = Packaging(
        sources[0], order, kinds_of(kind), folder, own.policy, force=force, dry_run=dry_run, ledger=ledger, notes=notes,
        every=every,
    )  # fmt: skip
    ctx.exit(run_packaging(packaging))
