"""Keeps the program from running what lies in the current folder, which may have come with a model."""

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import twinform


def distrust_current_folder() -> None:
    """Neither import modules nor start programs from the current folder, unless PYTHONPATH names it.

    Python looks there for `python -m twinform`, and where PYTHONPATH has an empty entry. Scripts that set up a shell
    leave such entries by accident, in PYTHONPATH and in PATH.
    """
    _filter_entries("PATH", os.path.isabs)
    is_module = sys.modules["__main__"].__spec__ is not None and not sys.flags.safe_path
    if _filter_entries("PYTHONPATH", bool) or is_module:
        with suppress(FileNotFoundError):  # the current folder was deleted
            _stop_importing_from(Path.cwd())


def _filter_entries(variable: str, is_kept: Callable[[str], bool]) -> bool:
    """Take entries from a search path in the environment, also of child processes; return whether there were any."""
    entries = os.environ.get(variable, "").split(os.pathsep)
    kept = [each for each in entries if is_kept(each)]
    if not any(entries) or kept == entries:
        return False
    os.environ[variable] = os.pathsep.join(kept)
    return True


def _stop_importing_from(folder: Path) -> None:
    named = {os.path.abspath(each) for each in os.environ.get("PYTHONPATH", "").split(os.pathsep) if each}  # noqa: PTH100
    # who runs twinform itself from there, as developers do in a checkout, trusts the folder
    if str(folder) not in named and folder != Path(twinform.__file__).parents[1]:
        sys.path[:] = [each for each in sys.path if each not in {"", str(folder)}]
