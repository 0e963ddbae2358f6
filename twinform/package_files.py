"""Where the data files of a package lie."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable


def package_files(package: str) -> "Traversable":
    """The folder of an imported package, as `importlib.resources.files` gives it.

    That one is asked only where the package lies in an archive: to import it takes longer than to read the facts.
    """
    folder = Path(sys.modules[package].__path__[0])
    if folder.is_dir():
        return folder
    from importlib import resources  # noqa: PLC0415 - see above

    return resources.files(package)
