"""`twinform check`: its options."""

from functools import partial
from pathlib import Path

import click

from twinform.cli.baseline_file import KnownOptions, baseline_options
from twinform.cli.check_report import ExitOptions, exit_options
from twinform.cli.check_run import CheckOptions, CheckRun
from twinform.cli.command import Command
from twinform.cli.completion import files, pipelines
from twinform.cli.file_runs import RunOptions, run_options
from twinform.cli.flags import group
from twinform.cli.inputs import exclude_options, exclusion_of, reading_options
from twinform.cli.printing import all_option, notes_option
from twinform.cli.project_options import consumers_option, pipeline_option
from twinform.cli.rule_options import policy_options
from twinform.diagnostics.reporters import REPORTERS

EXAMPLES = {
    "Find mistakes": "twinform check robot.urdf",
    "Also what is legal and yet worth knowing, for a program": "twinform check robot.sdf --notes --format json",
    "Expand a xacro file with an argument of its own": "twinform check arm.urdf.xacro prefix:=left_",
    "What would these two programs make of it?": "twinform check robot.urdf --for drake,mujoco",
    "One rule is an error, another is left out": "twinform check robot.urdf --deny massless-link --allow missing-limit",
    "Only what is about meshes": "twinform check robot.urdf --select meshes",
}
_FILE = click.Path(path_type=Path, dir_okay=False)

check_options = group(
    "options",
    CheckOptions,
    click.option("--format", "style", type=click.Choice([*REPORTERS]), default="text", help="How to print findings."),
    notes_option,
    all_option,
    click.option("--output-file", type=_FILE, metavar="FILE", help="Where to write the findings, not print them."),
    click.option(
        "--stdin-filename", metavar="NAME", help="The name of the file whose text comes from standard input."
    ),
    click.option("--watch", is_flag=True, help="Stay, and check what changes again, until Ctrl-C."),
    click.option("--fix", is_flag=True, help="Fix what can be fixed without another robot coming of it, in the files."),
    click.option("--unsafe-fixes", is_flag=True, help="Fix what is a guess too, or may make another robot of a file."),
    click.option(
        "--diff", is_flag=True, help="Print what --fix or --add-allow would change, and write nothing; exit code 1 if "
        "anything.",
    ),
    click.option("--fix-only", is_flag=True, help="Fix, and report nothing of what is left."),
    click.option(
        "--add-allow", is_flag=True, help="Write comments into the files that allow what is found in them today."
    ),
)  # fmt: skip
"""Gives a command the options of what is done with the findings, as `options`."""


@click.command("check", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@check_options
@policy_options
@baseline_options
@click.option(
    "--passes",
    "check_passes",
    metavar="PIPELINE",
    callback=pipeline_option("check-passes"),
    shell_complete=pipelines,
    help="Read-only passes, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@consumers_option
@click.option(
    "--robot",
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="The robot that SRDF and parameters of controllers, MoveIt and Nav2 are for; else it is looked for.",
)
@exclude_options
@exit_options
@run_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    *,
    options: CheckOptions,
    exit_options: ExitOptions,
    known: KnownOptions,
    exclude: tuple[str, ...],
    force_exclude: bool,
    run: RunOptions,
    **_options: object,
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, MJCF, xacro or JSON files, files that name the parts of a robot (SRDF, and YAML for controllers,
    MoveIt and Nav2), folders of them, or globs in quotes; - is standard input. Arguments of xacro are written
    NAME:=VALUE. The nearest twinform.toml of each file has its settings. Exit code: 0 without errors, 1 with errors, 2
    where a file that is named cannot be opened.
    """
    # How a file is read, the rules, passes and consumers depend on its configuration: `OptionsByFile` has them.
    exclusion = partial(exclusion_of, ctx, exclude, force=force_exclude)
    ctx.exit(CheckRun(ctx, words, options, exclusion, known, exit_options, run).run())
