"""Files that a command changes in place: printing the differences, and writing the files."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from twinform.cli.command import Unusable
from twinform.cli.inputs import InputSource
from twinform.cli.outputs import Outputs, require_as_read
from twinform.cli.printing import print_document, print_line, print_text
from twinform.compiler import write_all_atomically
from twinform.dataclass import dataclass
from twinform.diagnostics import SideFile
from twinform.text import SourceText, UndecodableError
from twinform.text.source_text import line_diff


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
        print_text("".join(line_diff(each.source.name, _decode(each.before), _decode(each.after))), nl=False)
        for file in each.side_files:
            print_line(f"{Path(each.source.name).parent / file.path} would be written")
    return bool(changed)


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
