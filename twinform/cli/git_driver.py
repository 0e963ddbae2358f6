"""Sets up git to merge models by their elements, and to show what changed in them without their layout."""

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Iterator
from pathlib import Path

from twinform.cli.command import Unusable
from twinform.compiler import write_all_atomically
from twinform.file_access import Readable

_PATTERNS = ("*.urdf", "*.sdf", "*.world", "*.xacro")
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
