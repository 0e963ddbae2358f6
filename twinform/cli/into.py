"""`twinform convert --into`: one file follows the edits of the other."""

from pathlib import Path

import click

from twinform.cli.conversion_targets import ConversionJob, known_target
from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.outputs import Outputs
from twinform.cli.run_conversion import Options
from twinform.cli.source import InputSource
from twinform.compiler import CompileError
from twinform.compiler.in_place import TextChange
from twinform.compiler.into import convert_into
from twinform.diagnostics.reporters import printable

_LONGEST = 60
"""The longest piece of a file that is shown, in characters."""


def run_into(source: InputSource, into: Path | None, base: Path | None, options: Options, outputs: Outputs) -> int:
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
    target = known_target(InputSource(str(into), str(into)).format)
    if target is None or target in {"json", source.format} or into.suffix.lower() == ".xacro":
        raise click.UsageError(f"--into takes a file of the other format, URDF or SDF, which {into} is not")
    request = options.request_for(ConversionJob(source, target, into))
    try:
        updated = convert_into(request, Path(source.name), into, options.load_options, base=base)
    except CompileError as error:
        options.show(source, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    if not options.show(source, updated.conversion.diagnostics):
        return FINDINGS
    outputs.add("--into", into, updated.data)
    outputs.as_read[into] = updated.source
    outputs.news.extend(_line(into, change) for change in updated.changes)
    count = len(updated.changes)
    outputs.news.append(f"{into}: {count} change{'s' if count > 1 else ''}" if count else f"{into} stays as it is")
    return 0


def _line(path: Path, change: TextChange) -> str:
    """Where a change was made, and what: nobody's edit is to go without a word."""
    line, column = change.place
    old, new = _short(change.old), _short(change.new)
    what = f"{old} becomes {new}" if old and new else f"{old} is deleted" if old else f"{new} is inserted"
    return f"{path}:{line}:{column}: {what}"


def _short(piece: str) -> str:
    """A piece of a file on one line."""
    words = printable(" ".join(piece.split()))
    return words if len(words) <= _LONGEST else f"{words[: _LONGEST - 3]}..."
