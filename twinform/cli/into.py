"""`twinform convert --into`: one file follows the edits of the other."""

from dataclasses import replace
from pathlib import Path

import click

from twinform.cli.conversion import Options, summary
from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.outputs import Outputs
from twinform.cli.source import Source
from twinform.compiler import CompileError
from twinform.compiler.in_place import convert_into


def run_into(source: Source, into: Path | None, base: Path | None, options: Options, outputs: Outputs) -> int:
    """Add what becomes of a file that follows another one to what is written; gives the exit code.

    Raises:
        click.UsageError: these are no two files of the two formats.
    """
    if into is None:
        raise click.UsageError("--base is for --into")
    for path in (into, *([base] if base else ())):
        if not path.is_file():
            raise click.UsageError(f"{path} is no file")
    if isinstance(source.content, bytes):
        raise click.UsageError(f"{source.name} is no file that could have been made of {into}")
    target = Source(str(into), str(into)).format
    if target not in {"urdf", "sdf"} or target == source.format or into.suffix.lower() == ".xacro":
        raise click.UsageError(f"--into takes a file of the other format, URDF or SDF, which {into} is not")
    request = replace(options.request, to=target, sdf_version=options.request.sdf_version if target == "sdf" else None)
    try:
        conversion, patched = convert_into(request, Path(source.name), into, options.load_options, base=base)
    except CompileError as error:
        options.show(source.name, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    if not options.show(source.name, conversion.diagnostics):
        return FINDINGS
    outputs.add("--into", into, patched)
    same = patched == into.read_bytes()
    outputs.news.append(f"{into} stays as it is" if same else f"{into}: {summary(conversion.ledger)}")
    return 0
