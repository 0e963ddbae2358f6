"""The script that starts the process which expands xacro."""

import sys
from pathlib import Path
from types import ModuleType

_AROUND = ("twinform.compiler.input", "twinform.compiler", "twinform")


def _start() -> None:
    """Run the task without running the packages around it: they would import the whole compiler.

    The arguments are the folders of libraries, for a Python that was started without its own look for them.
    """
    sys.path += sys.argv[1:]
    folders = Path(__file__).absolute().parents
    for name, folder in zip(_AROUND, folders[1:], strict=False):
        package = ModuleType(name)
        package.__path__ = [str(folder)]
        sys.modules[name] = package
    from twinform.compiler.input.xacro.process import main  # noqa: PLC0415 - it is found by what stands above

    main()


if __name__ == "__main__":
    _start()
