"""The `xacro` command, run as a script with a stand-in for the package index of ROS: PACKAGES is an object of JSON."""

import json
import os
import sys
from importlib import import_module
from types import ModuleType

_PACKAGES: dict[str, str] = json.loads(os.environ["PACKAGES"])


def get_package_share_directory(name: str) -> str:
    """Where a package is, as `ament_index_python` gives it."""
    if name not in _PACKAGES:
        raise LookupError(f"package {name!r} not found")
    return _PACKAGES[name]


def _stand_in() -> None:
    packages = ModuleType("ament_index_python.packages")
    vars(packages)["get_package_share_directory"] = get_package_share_directory
    sys.modules["ament_index_python"] = ModuleType("ament_index_python")
    sys.modules["ament_index_python.packages"] = packages


if __name__ == "__main__":
    _stand_in()
    vars(import_module("xacro"))["main"]()
