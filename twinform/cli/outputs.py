"""Output files of a command: never over an input or another output, and all of them or none."""

from collections.abc import Hashable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import click

from twinform.cli.failure import Unusable
from twinform.cli.printing import print_document, print_line
from twinform.compiler import write_all_atomically
from twinform.compiler.output.same_files import folded, identities, is_below, is_nothing
from twinform.diagnostics import HEAD, SideFile
from twinform.file_access import read_regular
from twinform.storage.writing import is_stream


class Output(NamedTuple):
    """A file that is to be written, and the option, or the pass, that names it."""

    by: str
    path: Path


def beside(result: Path | None, side_files: Iterable[str]) -> list[Output]:
    """The files that passes make, at their paths below the folder of the result.

    Raises:
        click.UsageError: the result goes to no file, or such a path leads elsewhere, through a symbolic link.
    """
    found: list[Output] = []
    for name in side_files:
        if result is None or is_stream(result):
            raise click.UsageError(f"{name} is to be written beside the result: name a file with -o")
        path = result.parent / name
        if not is_below(path, result.parent) or is_stream(path):
            raise click.UsageError(f"{name} leads out of {result.parent}, or to what is no file")
        found.append(Output(f"the file {name} of a pass", path))
    return found


@dataclass(slots=True)
class Outputs:
    """The files of a call while they are made, the text for standard output, and what is printed once all is there.

    `inputs` are the files that the call reads, of which those `spared` may be written over; `as_read` are the bytes
    that have to stand there still. Where it is to `check`, nothing is written, and the files that are there are
    compared with what would be.
    """

    inputs: Sequence[Path] = ()
    spared: Sequence[Path] = ()
    check: bool = False
    texts: list[tuple[Output, str | bytes]] = field(default_factory=list[tuple[Output, str | bytes]])
    as_read: dict[Path, bytes] = field(default_factory=dict[Path, bytes])
    stdout: str | None = None
    news: list[str] = field(default_factory=list[str])

    @property
    def by(self) -> str:
        """The option that names the result."""
        return "--in-place" if self.spared else "-o"

    def require_apart(self, outputs: Sequence[Output], read: Iterable[Path] = ()) -> None:
        """Raise where one file would be written over another, or over an input; `read` are more of these.

        Raises:
            click.UsageError: two of them are one file.
        """
        # `-o` named twice is mostly a slip, so an output is never an input; --in-place is for that.
        # A file that is read on the way, a mesh or an included model, is no place for an output
        # either.
        known = {each: path for path in (*read, *self.inputs) for each in identities(path)}
        for each in (each for path in self.spared for each in identities(path)):
            known.pop(each, None)
        written: dict[Hashable, Output] = {}
        for output in outputs:
            keys = [*identities(output.path)]
            over = next((known[key] for key in keys if key in known), None)
            if over is not None:
                advice = "name another file, or give --in-place" if output.by == "-o" else "name another file"
                raise click.UsageError(f"{output.by} would write over {over}, which is read: {advice}")
            for key in () if is_nothing(output.path) else (*keys, folded(output.path)):
                other = written.setdefault(key, output)
                if other is not output:
                    raise click.UsageError(f"{other.by} and {output.by} name the same file: {output.path}")

    def add(self, by: str, path: Path, text: str | bytes) -> None:
        """A file that an option names."""
        self.texts.append((Output(by, path), text))

    def add_beside(self, result: Path | None, side_files: Sequence[SideFile]) -> None:
        """The files that passes have made.

        Raises:
            click.UsageError: they have no place, or it is that of a file which was not written by twinform.
        """
        places = beside(result, [each.path for each in side_files])
        for place, side_file in zip(places, side_files, strict=True):
            _require_ours(place.path, side_file)
            if (place, side_file.content) not in self.texts:  # several models may share what was made of one mesh
                self.texts.append((place, side_file.content))

    def write(self, read: Iterable[Path] = ()) -> int:
        """Write all, or compare, and print the news; `read` are files that were read on the way. Gives the exit code.

        Raises:
            click.UsageError: one would be written over another, or over one that was read.
            Unusable: one cannot be written, or has changed since it was read; then none is.
        """
        self.require_apart([output for output, _ in self.texts], read)
        if self.check:
            from twinform.cli.outdated import report_outdated  # noqa: PLC0415 - most runs write

            return report_outdated(
                [(output.path, text) for output, text in self.texts], to_stdout=self.stdout is not None
            )
        try:
            # What one call writes is one thing, the opposite of `batch`, where one bad model never
            # stops the rest. All texts are written beside their places first, then standard output,
            # then all are moved.
            write_all_atomically({output.path: text for output, text in self.texts}, self._print)
        except OSError as error:
            if not error.filename:
                raise  # it is about standard output
            raise Unusable(f"cannot write {error.filename}: {error.strerror}") from error
        for line in self.news:
            print_line(line, err=True)
        return 0

    def _print(self) -> None:
        for path, before in self.as_read.items():
            require_as_read(path, before)
        if self.stdout is not None:
            print_document(self.stdout)


def require_as_read(path: Path, before: bytes) -> None:
    """Raise where a file that is to be changed is not as it was when it was read.

    Raises:
        Unusable: somebody else has changed it.
    """
    try:
        now = read_regular(path)
    except OSError as error:
        raise Unusable(f"cannot read {path} again: {error.strerror}; nothing is written") from error
    if now != before:
        raise Unusable(f"{path} has changed since it was read; nothing is written. Run the command again")


def _require_ours(path: Path, side_file: SideFile) -> None:
    """Raise where somebody else's file is in the place of a side file."""
    with suppress(OSError):  # writing it will say what is wrong
        # A pipeline may come with a model that was downloaded, so it overwrites only what begins as
        # twinform's own files do.
        data = read_regular(path)
        if not side_file.is_earlier(data[:HEAD]) and data != side_file.data:
            message = f"{path} is there, and twinform has not written it: remove it, or have another name"
            raise click.UsageError(message)
