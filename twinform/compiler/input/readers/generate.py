"""Writes the generated readers: `python -m twinform.compiler.input.readers.generate`; `--check` only compares them."""

import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from twinform.child_python import python_command
from twinform.compiler.input.readers.functions import ModuleWriter
from twinform.schemas import table
from twinform.storage.writing import write_all_atomically

_FORMATS = ("urdf", "sdf")


def generated() -> Iterator[tuple[Path, str]]:
    """Every generated module: its file and its text."""
    for name in _FORMATS:
        yield Path(__file__).with_name(f"{name}.py"), _formatted(ModuleWriter(table(name)).text())


def stale() -> list[Path]:
    """The files that are not up to date with the facts."""
    return [file for file, text in generated() if not file.is_file() or file.read_text(encoding="utf-8") != text]


def _formatted(text: str) -> str:
    """The text as `make fmt` leaves it."""
    command = python_command("-m", "ruff", "format", "-")
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout  # noqa: S603 - ours


def main(arguments: Sequence[str]) -> int:
    """Write all modules, or check them; the exit code."""
    if "--check" in arguments:
        for file in (files := stale()):
            sys.stderr.write(f"{file}: not up to date with the facts; run python -m {__spec__.name}\n")
        return 1 if files else 0
    write_all_atomically(dict(generated()))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
