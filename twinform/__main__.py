"""The program `twinform`. As `python -m twinform` it is the same, but Python looks in the current folder first.

In a folder of somebody else use the command, or `python -P -m twinform`.
"""

import gc
import sys
import warnings

from twinform.signals import end_on_signals

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, NoReturn

# New objects before the garbage collector looks for cycles; with Python's default of 700 it walks all imports again.
_MANY = 50_000

end_on_signals()  # before the command line is imported, which takes longer than many commands


def program() -> "NoReturn":
    """Run the command line and leave the process, as the installed script does; `main` is for other programs."""
    gc.set_threshold(_MANY)  # before the imports, which make half of all objects
    from twinform.cli import main  # noqa: PLC0415 - see above
    from twinform.cli.process import distrust_current_folder, run  # noqa: PLC0415 - see above

    distrust_current_folder()
    sys.excepthook = _print_uncaught
    if not sys.warnoptions:  # they are for developers, such as those of numpy about numbers in a file
        warnings.simplefilter("ignore")
    run(main)


def _print_uncaught(*error: "Any") -> None:
    from twinform.cli.printing import print_traceback  # noqa: PLC0415 - it should never be needed

    print_traceback(*error)


if __name__ == "__main__":
    program()
