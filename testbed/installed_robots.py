"""The folders of robots with meshes that come with installed packages: PyBullet, Drake, example-robot-data."""

import importlib.util
from collections.abc import Iterator
from pathlib import Path

_PACKAGES = ("pybullet_data", "pydrake", "cmeel")
_FOLDERS = {"cmeel": "../cmeel.prefix/share/example-robot-data", "pydrake": "share"}


def installed_folders() -> Iterator[tuple[str, Path]]:
    """Yield what each folder is called, and where it is; `make report` installs the packages where they are needed."""
    for package in _PACKAGES:
        spec = importlib.util.find_spec(package)
        if spec is not None and spec.origin is not None:
            folder = (Path(spec.origin).parent / _FOLDERS.get(package, ".")).resolve()
            yield folder.name if package == "cmeel" else package, folder
