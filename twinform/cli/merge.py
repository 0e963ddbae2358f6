"""`twinform merge`, and how git is set up to use it."""

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Iterator
from pathlib import Path

import click

from twinform.cli.command import FINDINGS, Command, Unusable
from twinform.cli.completion import files as files_of
from twinform.cli.outputs import Outputs, output_option
from twinform.cli.printing import print_document, print_line, show
from twinform.compiler import LoadOptions, write_all_atomically
from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.loading import read
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.compiler.merging import FileVersions, Problem, merge_files
from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.diagnostics.reporters import FileFindings
from twinform.file_access import Readable
from twinform.server.document_names import undefined_names
from twinform.server.model_text import ModelText
from twinform.text import Lines, SourceText

EXAMPLES = {
    "Merge the edits of two people": "twinform merge base.urdf ours.urdf theirs.urdf -o robot.urdf",
    "Have git merge models like this": "twinform merge --install",
}
_STRUCTURE = frozenset(
    rule.name
    for rule in (
        rules.DUPLICATE_NAME,
        rules.FRAME_CYCLE,
        rules.KINEMATIC_LOOP,
        rules.MIMIC_CYCLE,
        rules.REPEATED_ELEMENT,
        rules.SELF_JOINT,
        rules.TWO_PARENTS,
    )
)
"""What can be wrong in a merged robot although each value is that of one side."""


@click.command("merge", cls=Command, examples=EXAMPLES)
@click.argument("files", metavar="BASE OURS THEIRS [NAME]", nargs=-1, shell_complete=files_of)
@output_option
@click.option("--marker-size", metavar="N", default=7, help="The length of the markers around conflicts; by default 7.")
@click.option(
    "--install", is_flag=True, help="Set up git to merge and compare the models of this repository, in its .git/config"
    " and .gitattributes.",
)  # fmt: skip
@click.pass_context
def command(
    ctx: click.Context, files: tuple[str, ...], *, output: Path | None, marker_size: int, install: bool
) -> None:
    """Merge the edits of two people in a model file.

    BASE is the file that both started with. The result is OURS with the changes between BASE and THEIRS: URDF, SDF,
    MJCF, xacro or other XML, merged by elements and attributes and not by lines. With the NAME of the file in the
    repository, as git gives it to a merge driver, the result is written into OURS. Exit code: 0 merged, 1 with
    conflicts, which stand between the markers of git, 2 where a file could not be read or written.
    """
    if install:
        if files or output:
            raise click.UsageError("--install takes no files")
        for line in install_driver(Path.cwd()):
            print_line(line, err=True)
        return
    if len(files) not in {3, 4}:
        raise click.UsageError("expected three files: BASE OURS THEIRS")
    base, ours, theirs = map(Path, files[:3])
    name = files[3] if len(files) > 3 else str(output or ours)
    target = output or (ours if len(files) > 3 else None)
    versions = FileVersions(_read(base), _read(ours), _read(theirs))
    merged = merge_files(versions, lambda text: find_problems(text, name), marker_size=marker_size)
    _write(merged.data, target, [base, ours, theirs])
    for message in merged.notes:
        print_line(f"{name}: {message}", err=True)
    for message in merged.conflicts:
        print_line(f"{name}: conflict: {message}", err=True)
    ctx.exit(FINDINGS if merged.conflicts else 0)


def _read(path: Path) -> bytes:
    sink = DiagnosticSink(str(path))
    try:
        return read_bytes(path, sink)
    except UnreadableError as error:
        show(FileFindings(str(path), tuple(sink.diagnostics)), notes=False, on_stderr=True)
        raise Unusable("nothing is merged") from error


def _write(data: bytes, target: Path | None, read_files: list[Path]) -> None:
    # The driver of git writes over ours, and -o may name any of the three.
    outputs = Outputs(read_files, read_files)
    if target is None or str(target) == "-":
        print_document(data)
        return
    outputs.add("-o", target, data)
    outputs.write()


def find_problems(text: SourceText, name: str) -> Iterator[Problem]:
    """Find names without a definition and what is wrong with the structure of a text."""
    for each in undefined_names(ModelText(name, text.text)):
        message = f"there is no {each.kind} {each.text!r} any more, and one side refers to it"
        yield Problem((each.kind, each.text), message, each.span.start)
    if name.endswith(XACRO) or "xmlns:xacro" in text.text:
        return
    lines = Lines(text.text)
    for found in read(text.data, LoadOptions(), name=name).diagnostics:
        # a note is no fault: in SDF a second parent closes a loop
        if found.rule.name in _STRUCTURE and found.severity is not Severity.INFO:
            line = min(max(1, found.location.line), len(lines))
            yield Problem((found.rule.name, found.message), found.message, lines.start(line))


_PATTERNS = ("*.urdf", "*.sdf", "*.world", "*.mjcf", "*.xacro")
_ATTRIBUTES = "merge=twinform diff=twinform"


def install_driver(folder: Path) -> Iterator[str]:
    """Write the driver into the configuration of the repository around a folder, and yield what was done.

    Raises:
        Unusable: git is not installed, or there is no repository, or a file cannot be written.
    """
    program = _program()
    # A text that is not well-formed is compared as it is. Line ends differ without the models doing so.
    shown = f'{program} format - --sort-attributes --numbers shortest <"$0" 2>/dev/null || cat "$0"'
    settings = {
        "merge.twinform.name": "elements and attributes of robot models",
        "merge.twinform.driver": f"{program} merge --marker-size %L %O %A %B %P",
        "diff.twinform.textconv": f"sh -c '{{ {shown}; }} | tr -d \"\\r\"'",
    }
    top = Path(_git(folder, "rev-parse", "--show-toplevel"))
    for name, value in settings.items():
        _git(folder, "config", name, value)
        yield f"git config {name}: {value}"
    attributes = top / ".gitattributes"
    added = _add_attributes(attributes)
    yield f"{attributes}: {added or 'no'} lines added; commit it, so that others have it too"


def _program() -> str:
    """Return the command in the form of a shell: git may run it where the environment of Python is not active."""
    beside = Path(sysconfig.get_path("scripts")) / "twinform"
    path = beside.as_posix()
    return f'"{path}"' if beside.is_file() and not set(path) & set("\"'\\$`") else "twinform"


def _add_attributes(path: Path) -> int:
    """Add the lines that a file lacks, and return how many these are."""
    try:
        before = Readable.of(path).read(path).decode(errors="surrogateescape") if path.exists() else ""
        known = {" ".join(line.split()) for line in before.splitlines()}
        lines = [line for pattern in _PATTERNS if (line := f"{pattern} {_ATTRIBUTES}") not in known]
        if lines:
            start = before if not before or before.endswith("\n") else f"{before}\n"
            text = f"{start}{chr(10).join(lines)}\n"
            write_all_atomically({path: text.encode(errors="surrogateescape")})
    except OSError as error:
        raise Unusable(f"cannot write {path}: {error.strerror}") from error
    return len(lines)


def _git(folder: Path, *arguments: str) -> str:
    # A git in the folder that one happens to be in is a file of strangers, whatever PATH says.
    folders = [each for each in os.environ.get("PATH", os.defpath).split(os.pathsep) if os.path.isabs(each)]  # noqa: PTH117
    program = shutil.which("git", path=os.pathsep.join(folders))
    if program is None:
        raise Unusable("git is not installed")
    done = subprocess.run(  # noqa: S603 - git itself, with arguments of ours
        [program, *arguments], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise Unusable(f"git {arguments[0]}: {done.stderr.strip()}")
    return done.stdout.strip()
