"""The target format and output path of each input of a conversion."""

import os
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Literal, NamedTuple, get_args

import click

from twinform.cli.inputs import InputSource, format_of_suffix
from twinform.compiler.output.same_files import folded

Target = Literal["sdf", "urdf", "json"]
TARGETS: tuple[Target, ...] = get_args(Target)

_OTHER: dict[str, Target] = {"urdf": "sdf", "sdf": "urdf"}
_ENDINGS = frozenset({".urdf", ".sdf", ".world", ".xml", ".json", ".xacro"})


class ConversionJob(NamedTuple):
    """One conversion, to standard output if `path` is None; with `in_place` only the changes are written."""

    source: InputSource
    target: Target
    path: Path | None
    in_place: bool = False


def jobs(sources: Sequence[InputSource], out: str | None, target: Target | None) -> list[ConversionJob]:
    """List the conversions that a command line asks for.

    Raises:
        click.UsageError: it contradicts itself, or does not say the target.
    """
    if out is None or out == "-":
        if len(sources) > 1:
            raise click.UsageError("several inputs need -o DIRECTORY")
        return [ConversionJob(source, target or _other_format(source), None) for source in sources]
    folder = Path(out)
    if not _is_folder(out, len(sources)):
        return [
            ConversionJob(
                source, target or known_target(format_of_suffix(folder.name)) or _other_format(source), folder
            )
            for source in sources
        ]
    if folder.exists() and not folder.is_dir():
        raise click.UsageError(f"several inputs need a directory, and {out} is a file")
    found = [_job_in_folder(folder, source, target or _other_format(source)) for source in sources]
    _require_distinct(found)
    return found


def jobs_in_place(sources: Sequence[InputSource], out: str | None, target: Target | None) -> list[ConversionJob]:
    """List the conversions of `--in-place`, which keep the format of each input.

    Raises:
        click.UsageError: an input is no file that can be changed in place, or another output is named.
    """
    if out is not None:
        raise click.UsageError("--in-place and -o contradict each other")
    return [_job_in_place(source, target) for source in sources]


def _job_in_place(source: InputSource, target: Target | None) -> ConversionJob:
    """Return the job of changing a file in place."""
    if isinstance(source.content, bytes):
        raise click.UsageError(f"{source.name} is no file that could be written in place")
    if source.name.lower().endswith(".xacro"):
        raise click.UsageError(f"{source.name} would be replaced by what it expands to; name another file with -o")
    found = known_target(source.format)
    if found is None or target not in {None, found}:
        raise click.UsageError(f"{source.name} stays {found or 'what it is'} in its place; leave --to out")
    return ConversionJob(source, found, Path(source.content), in_place=True)


def _is_folder(out: str, count: int) -> bool:
    return count > 1 or Path(out).is_dir() or out.endswith(("/", os.sep))


def known_target(word: str | None) -> Target | None:
    """Return the target of a name, if there is one."""
    return next((target for target in TARGETS if target == word), None)


def _other_format(source: InputSource) -> Target:
    """Return the format to convert a source to; if its own format is unknown, the compiler reports why."""
    if source.format == "json":
        raise click.UsageError(f"{source.name} is a JSON document, which can become either format: give --to")
    return _OTHER.get(source.format or "urdf", "sdf")


def _job_in_folder(folder: Path, source: InputSource, target: Target) -> ConversionJob:
    name = Path("stdin" if isinstance(source.content, bytes) else source.name)
    ending: str = target
    while name.suffix.lower() in _ENDINGS:
        ending = "world" if target == "sdf" and name.suffix.lower() == ".world" else ending
        name = name.with_suffix("")
    return ConversionJob(source, target, folder / f"{name.name}.{ending}")


def _require_distinct(found: Sequence[ConversionJob]) -> None:
    counts = Counter(folded(job.path) for job in found if job.path)
    for path, count in counts.items():
        if count > 1:
            alike = [job for job in found if job.path and folded(job.path) == path]
            names = ", ".join(job.source.name for job in alike)
            raise click.UsageError(f"{names} would all be written to {alike[0].path}")
