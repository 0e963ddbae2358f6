"""The script that starts the process which expands xacro."""

import gc
import sys
from os.path import abspath, dirname
from types import ModuleType

_AROUND = ("twinform.compiler.input", "twinform.compiler", "twinform")


def add_packages() -> None:
    """Make the packages around the task importable without running them: they would import the whole compiler.

    The arguments are the folders of libraries, for a Python that was started without its own look for them.
    """
    sys.path += sys.argv[1:]
    folder = dirname(abspath(__file__))
    for name in _AROUND:
        package = ModuleType(name)
        folder = dirname(folder)
        package.__path__ = [folder]
        sys.modules[name] = package


if __name__ == "__main__":
    gc.set_threshold(50_000)  # trees of XML are full of circles, among which it would look for garbage all the time
    add_packages()
    from twinform.compiler.input.xacro.process import main

    main()
