"""`twinform package`."""

import json
from pathlib import Path

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files
from twinform.cli.flags import group
from twinform.cli.gazebo_files import release_option, version_for
from twinform.cli.inputs import InputSource, inputs, reading_options
from twinform.cli.instrumentation import show_fault
from twinform.cli.outputs import Output, Outputs
from twinform.cli.printing import all_option, notes_option, print_line, print_text
from twinform.cli.project_options import (
    OptionsByFile,
    request_options_of_versions,
    whole_request,
)
from twinform.cli.rule_options import policy_options
from twinform.cli.run_conversion import show_findings, summary
from twinform.compiler import CompileError, ConversionRequest
from twinform.compiler.input.load_options import ReadingOptions
from twinform.compiler.packaging.kinds import KIND_NAMES, build, kinds_of
from twinform.compiler.packaging.order import Built, Order, PackageDetails, details_around
from twinform.compiler.packaging.package import OccupiedError, Package, write_package
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, Policy
from twinform.diagnostics.wording import plural
from twinform.passes import PassError
from twinform.passes.plugins.release_names import ReleaseName

_OPTIONS = (
    click.option("--package-version", metavar="X.Y.Z", default="", help="The version of the package; else 0.1.0."),
    click.option("--description", metavar="TEXT", default="", help="What the package is, in a sentence."),
    click.option("--author", metavar="NAME", default="", help="Who made the model; else the maintainer."),
    click.option("--maintainer", metavar="NAME", default="", help="Who looks after the package."),
    click.option("--email", metavar="ADDRESS", default="", help="The address of the maintainer."),
    click.option("--license", metavar="LICENSE", default="", help="The license, such as Apache-2.0."),
)


def _details(package_version: str, **words: str) -> PackageDetails:
    return PackageDetails(version=package_version.strip(), **{name: word.strip() for name, word in words.items()})


detail_options = group("details", _details, *_OPTIONS)
"""Gives the command the options for what the package says about itself."""


def _complete_details(given: PackageDetails, source: str | bytes) -> PackageDetails:
    """Complete the details with those of the package or model around the source."""
    return given if isinstance(source, bytes) else given.or_else(details_around(Path(source)))


EXAMPLES = {
    "Make a model folder for Gazebo": "twinform package robot.urdf -o robot --kind gazebo-model",
    "Let older Gazebo read it too": "twinform package robot.urdf -o robot --kind gazebo-model --sdf-version 1.11 "
    "--sdf-version 1.6",
    "Make a package for ROS 2": "twinform package robot.urdf -o robot_description --kind ros2",
    "Make one folder for both, with Fortress and Humble": "twinform package robot.urdf -o robot_description "
    "--kind both --gazebo fortress",
    "Make a folder for MuJoCo, with a scene to load": "twinform package robot.urdf -o robot --kind mujoco",
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
    help="A model folder for Gazebo, a package for ROS 2, one folder that is both, or a folder for MuJoCo.",
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
    reading: ReadingOptions,
    **_options: object,
) -> None:
    """Put a model and all its files into a folder.

    IN is a URDF, SDF, MJCF, xacro or JSON file. Its meshes, textures and scripts, and what these name themselves, are
    copied into DIR, each once, and all URIs lead there. Of a world, each model gets a folder. Who made the model, its
    license and its version are those of the package.xml or model.config around IN, where no option says it. The folder
    is written at once, or, where there is an error, not at all. Exit code: 0 without errors, 1 with errors, 2 where a
    file could not be read or written.
    """
    sources, arguments = inputs(words)
    if len(sources) > 1:
        raise click.UsageError("package takes one input")
    by_file, source = OptionsByFile(ctx, arguments), sources[0]
    own = by_file.of(source.name)
    sdf_versions: tuple[str, ...] = by_file.context_of(source.name).params["sdf_versions"]
    whole = whole_request(own.request, reading, passes=own.passes, model=model)
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
        details=_complete_details(details, sources[0].content),
        allow_missing=allow_missing,
        thumbnail=thumbnail,
    )
    packaging = Packaging(
        sources[0], order, kinds_of(kind), folder, own.policy, force=force, dry_run=dry_run, ledger=ledger, notes=notes,
        every=every,
    )  # fmt: skip
    ctx.exit(run_packaging(packaging))


@dataclass(frozen=True, slots=True)
class Packaging:
    """The order of a package, where it is written, and what is printed."""

    source: InputSource
    order: Order
    kinds: tuple[str, ...]
    folder: Path
    policy: Policy
    force: bool
    dry_run: bool
    ledger: Path | None
    notes: bool
    every: bool

    def show(self, diagnostics: tuple[Diagnostic, ...]) -> bool:
        """Print the findings by the policy; return whether none of them is an error."""
        return show_findings(self.source, self.policy.apply(diagnostics), notes=self.notes, every=self.every)


def run_packaging(packaging: Packaging) -> int:
    """Make a package, write it, and return the exit code."""
    try:
        built = build(packaging.order, packaging.kinds)
    except CompileError as error:
        packaging.show(error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        show_fault(error, packaging.source.name)
        return FINDINGS
    if not packaging.show(built.diagnostics):
        return FINDINGS
    if packaging.dry_run:
        for path in built.package.files:
            print_line(path)
        return 0
    _write(built, packaging)
    return 0


def _write(built: Built, packaging: Packaging) -> None:
    """Write the package, and the ledger beside it.

    Raises:
        click.UsageError: a file that was read, or that twinform has not written, would be written over.
        Unusable: a file cannot be written.
    """
    outputs = Outputs([packaging.source.path])
    places = [Output("-o", packaging.folder / path) for path in built.package.files]
    ledger = [Output("--ledger", packaging.ledger)] if packaging.ledger else []
    outputs.require_apart([*places, *ledger], packaging.order.load_options.search.seen)
    ledgers = {name: json.loads(each.to_json()) for name, each in built.ledgers.items()}
    beside = {each.path: json.dumps(ledgers, indent=2) + "\n" for each in ledger}
    try:
        write_package(built.package, packaging.folder, force=packaging.force, beside=beside)
    except OccupiedError as error:
        raise click.UsageError(f"{error.strerror}; --force does that") from error
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or packaging.folder}: {error.strerror}") from error
    for name, each in built.ledgers.items():
        print_text(f"{name}: {summary(each)}", err=True)
    print_text(f"{packaging.folder}: {_size(built.package)}", err=True)


def _size(package: Package) -> str:
    """Say how many files are in a package, and how large they are."""
    sizes = [len(each) if isinstance(each, bytes) else each.stat().st_size for each in package.files.values()]
    size = f"{sum(sizes) / 1e6:.1f} MB" if sum(sizes) >= 1e5 else f"{sum(sizes) / 1e3:.0f} kB"
    return f"{plural(len(sizes), 'file')}, {size}"
