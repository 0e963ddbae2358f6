"""Child processes of Python that import nothing from the current folder, which may have come with a model."""

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from multiprocessing.context import SpawnContext

# `python -c` and `python -m` put the current folder first on the module path, and multiprocessing's
# `spawn` is `python -c`: a `signal.py` beside a downloaded model was imported by every worker.
# Every child process of Python is therefore started from this module.
_SAFE_PATH = "-P"
"""Python's option for a module path without the current folder and without the folder of the script."""


def python_command(*arguments: str) -> list[str]:
    """Return the command that starts this Python with the given arguments and a safe module path."""
    return [sys.executable, _SAFE_PATH, *arguments]


def spawn_context() -> "SpawnContext":
    """Return multiprocessing's `spawn` context, after making all processes that it starts use a safe module path."""
    from multiprocessing import get_context, util  # noqa: PLC0415 - slow to import, and few commands start workers

    # `spawn` runs `python -c`, and so does the process that tracks semaphores. Both take the options of the child from
    # this function. PYTHONSAFEPATH is no substitute: children of a Python that was started with -E do not read it
    inherited: Any = util
    options_of_parent = inherited._args_from_interpreter_flags  # noqa: SLF001 - see above
    if _SAFE_PATH not in options_of_parent():
        inherited._args_from_interpreter_flags = lambda: [_SAFE_PATH, *options_of_parent()]  # noqa: SLF001
    return get_context("spawn")
