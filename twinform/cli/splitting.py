"""`twinform convert --split`: a world into a file for each of its models, and one that includes them."""

from dataclasses import replace
from pathlib import Path

from twinform.cli.conversion_targets import Target
from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.outputs import Outputs
from twinform.cli.run_conversion import Options, summary
from twinform.cli.source import InputSource
from twinform.compiler import CompileError, SplitWorld, split
from twinform.passes import PassError


def run_split(source: InputSource, to: Target, options: Options, folder: Path, outputs: Outputs) -> int:
    """Split one world into a folder; gives the exit code. Nothing is made where one of the files has an error.

    Models become URDF where Gazebo reads that as the same robots, or stay SDF with `to`.
    """
    instrumented = options.watching.begin(source.name)
    try:
        request = replace(options.request, to=to)
        result = split(
            request,
            source.content,
            options.load_options,
            name=source.name,
            instrumentation=instrumented.instrumentation,
            folder=folder,
        )
    except CompileError as error:
        instrumented.report()
        options.show(source, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        instrumented.fault(error)
        return FINDINGS
    instrumented.end()
    if not options.show(source, result.diagnostics):
        return FINDINGS
    _add(result, folder, options.ledger, outputs)
    outputs.news.append(f"{len(result.files)} files: {summary(result.ledger)}")
    return 0


def _add(result: SplitWorld, folder: Path, ledger: Path | None, outputs: Outputs) -> None:
    for name, text in result.files.items():
        outputs.add("--split", folder / name, text)
    if ledger is not None:
        outputs.add("--ledger", ledger, result.ledger.to_json())
    outputs.add_beside(folder / next(iter(result.files)), result.side_files)
