"""Output files of a command: never over an input or another output unless in place, and all of them or none."""

import io
import os
from collections.abc import Generator, Hashable, Iterable, Sequence
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import field
from pathlib import Path
from typing import NamedTuple

import click

from twinform.cli.command import FINDINGS, Unusable
from twinform.cli.inputs import InputSource
from twinform.cli.printing import print_document, print_line, print_text
from twinform.compiler import write_all_atomically
from twinform.dataclass import dataclass
from twinform.diagnostics import HEAD, SideFile
from twinform.file_access import Readable, read_regular
from twinform.storage.writing import folded, identities, is_below, is_nothing, is_stream
from twinform.text import SourceText, UndecodableError
from twinform.text.source_text import line_diff

output_option = click.option(
    "-o", "--output", "output", metavar="FILE", type=click.Path(path_type=Path), help="Where to write; else it prints."
)


class Output(NamedTuple):
    """A file to write, and the option or pass that names it."""

    by: str
    path: Path


def beside(result: Path | None, side_files: Iterable[str]) -> list[Output]:
    """Return the files that passes make, at their paths below the folder of the result.

    Raises:
        click.UsageError: the result goes to no file, or a path leads out of the folder through a symbolic link.
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


@contextmanager
def printed_text() -> Generator[io.BytesIO]:
    """Yield a buffer that gets what is printed on standard output inside."""
    data = io.BytesIO()
    stream = io.TextIOWrapper(data, "utf-8", newline="\n", write_through=True)
    with redirect_stdout(stream):
        yield data
    stream.detach()  # it would close the buffer with itself


@dataclass(slots=True)
class Outputs:
    """The files that a command makes, its text for standard output, and the messages to print once all is written.

    `inputs` are the files that it reads, of which only those `spared` may be written over; `as_read` are the bytes that
    these must still have then. With `check` nothing is written, and existing files are compared with the new ones.
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
        """Require that no output is written over another one, over an input, or over a file in `read`.

        Raises:
            click.UsageError: two of them are the same file.
        """
        # An output that is an input is mostly a mistake; --in-place is for that. The same goes for
        # files that are read on the way, such as meshes and included models.
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

    def set_result(self, path: Path | None, text: str) -> None:
        """Write a text to the file of `-o`, or to standard output if there is none or it is `-`."""
        if path is None or str(path) == "-":
            self.stdout = text
        else:
            self.add("-o", path, text)

    def add(self, by: str, path: Path, text: str | bytes) -> None:
        """Add a file that an option names."""
        self.texts.append((Output(by, path), text))

    def add_beside(self, result: Path | None, side_files: Sequence[SideFile]) -> None:
        """Add the files that passes have made.

        Raises:
            click.UsageError: they have no place, or a file that twinform has not written is there.
        """
        places = beside(result, [each.path for each in side_files])
        for place, side_file in zip(places, side_files, strict=True):
            is_there = _is_there(place.path, side_file)
            # A mesh may be read and made again, and several models may share what was made of one.
            if (self.check or not is_there) and (place, side_file.content) not in self.texts:
                self.texts.append((place, side_file.content))

    def write(self, read: Iterable[Path] = ()) -> int:
        """Write or compare all files, print the messages, and return the exit code; `read` was read on the way.

        Raises:
            click.UsageError: a file would be written over another output, or over a file that was read.
            Unusable: a file cannot be written, or has changed since it was read; then nothing is written.
        """
        self.require_apart([output for output, _ in self.texts], read)
        if self.check:
            return _report_outdated(
                [(output.path, text) for output, text in self.texts], to_stdout=self.stdout is not None
            )
        try:
            # One call writes everything or nothing, unlike `batch`. All texts are written beside their
            # places first, then to standard output, and then all are moved.
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
    """Require that a file has not changed since it was read.

    Raises:
        Unusable: somebody else has changed it.
    """
    try:
        now = read_regular(path)
    except OSError as error:
        raise Unusable(f"cannot read {path} again: {error.strerror}; nothing is written") from error
    if now != before:
        raise Unusable(f"{path} has changed since it was read; nothing is written. Run the command again")


def _is_there(path: Path, side_file: SideFile) -> bool:
    """Whether a side file is at its place already.

    Raises:
        click.UsageError: a file that twinform has not written is there.
    """
    with suppress(OSError):  # writing the file will report it
        # A pipeline may come with a downloaded model, so it overwrites only files of twinform, by their first bytes.
        data = read_regular(path)
        if data == side_file.data:
            return True
        if not side_file.is_earlier(data[:HEAD]):
            message = f"{path} is there, and twinform has not written it: remove it, or have another name"
            raise click.UsageError(message)
    return False


_MOST_LINES = 400
"""The most lines of a difference that are printed."""


def _report_outdated(texts: Sequence[tuple[Path, str | bytes]], *, to_stdout: bool) -> int:
    """Print how files differ from these texts, and return the exit code.

    Raises:
        click.UsageError: a text goes to standard output, where there is nothing to compare.
        Unusable: a file cannot be read.
    """
    if to_stdout:
        raise click.UsageError("--check compares files: name one with -o")
    outdated = [path for path, text in texts if _differs(path, text)]
    for path in outdated:
        why = "is not what it is made to be" if path.exists() else "is not there"
        print_line(f"{path} {why}; run the command without --check", err=True)
    if not outdated:
        print_line(f"{_count(len(texts), 'file')} up to date", err=True)
    return FINDINGS if outdated else 0


def _differs(path: Path, text: str | bytes) -> bool:
    new = text.encode() if isinstance(text, str) else text
    try:
        old = Readable.of(path).read(path)
    except FileNotFoundError:
        return True
    except OSError as error:
        raise Unusable(f"cannot read {path}: {error.strerror}") from error
    if old == new:
        return False
    from twinform.text.source_text import line_diff  # noqa: PLC0415 - most files are up to date

    lines = list(line_diff(str(path), old.decode(errors="replace"), new.decode(errors="replace")))
    for line in lines[:_MOST_LINES]:
        print_line(line.rstrip())
    if len(lines) > _MOST_LINES:
        print_line(f"... and {len(lines) - _MOST_LINES} lines more")
    return True


def _count(number: int, word: str) -> str:
    return f"{number} {word}{' is' if number == 1 else 's are'}"


@dataclass(frozen=True, slots=True)
class Rewrite:
    """A file or standard input: what was read, and what is to be written."""

    source: InputSource
    before: bytes
    after: bytes
    side_files: tuple[SideFile, ...] = ()

    @property
    def is_change(self) -> bool:
        """Whether there is anything to write."""
        return self.before != self.after or bool(self.side_files)

    @property
    def is_stream(self) -> bool:
        """Whether it came from standard input, and goes to standard output."""
        return isinstance(self.source.content, bytes)


def show_differences(rewrites: Iterable[Rewrite]) -> bool:
    """Print what would change as a unified diff; return whether anything would."""
    changed = [each for each in rewrites if each.is_change]
    for each in changed:
        print_text(text_difference(each), nl=False)
        for file in each.side_files:
            print_line(f"{Path(each.source.name).parent / file.path} would be written")
    return bool(changed)


def text_difference(rewrite: Rewrite) -> str:
    """Return what would change in a file as a unified diff."""
    return "".join(line_diff(rewrite.source.name, _decode(rewrite.before), _decode(rewrite.after)))


def _decode(data: bytes) -> str:
    try:
        return SourceText.of(data).text
    except UndecodableError:
        return data.decode(errors="replace")


def write_back(rewrites: Sequence[Rewrite]) -> None:
    """Write all changed files or none; what came from standard input goes to standard output.

    Raises:
        Unusable: one of the files cannot be written, is read-only, or has changed since it was read.
    """
    files = {Path(each.source.name): each for each in rewrites if each.is_change and not each.is_stream}
    texts = {path: each.after for path, each in files.items() if each.before != each.after}

    def require_unchanged() -> None:
        for path, each in files.items():
            require_as_read(path, each.before)
            # A rename could replace a read-only file, since it needs permissions for the folder
            # only. Whoever made the file read-only did not mean that.
            if not _is_writable(path):
                raise Unusable(f"{path} is read-only; nothing is written")

    try:
        write_all_atomically({**_files_beside(rewrites), **texts}, require_unchanged)
    except OSError as error:
        raise Unusable(f"cannot write {error.filename}: {error.strerror}") from error
    for each in rewrites:
        if each.is_stream:
            print_document(each.after)


def _files_beside(rewrites: Sequence[Rewrite]) -> dict[Path, str | bytes]:
    """Return the files that passes have made, by their places."""
    outputs = Outputs([Path(each.source.name) for each in rewrites if not each.is_stream])
    for each in rewrites:
        outputs.add_beside(None if each.is_stream else Path(each.source.name), each.side_files)
    outputs.require_apart([place for place, _ in outputs.texts])
    return {place.path: content for place, content in outputs.texts}


def _is_writable(path: Path) -> bool:
    """Whether a file may be written; its permissions count for the administrator too."""
    return bool(path.stat().st_mode & 0o222) and os.access(path, os.W_OK)
