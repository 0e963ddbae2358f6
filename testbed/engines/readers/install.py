"""Installs readers in other releases than the environment has: `python -m testbed.engines.readers.install`."""

import subprocess
import sys
from collections.abc import Mapping

from testbed.engines.readers.installed import folder_of, python_for, version_in
from testbed.engines.readers.loaders import LOADERS

_BESIDE: Mapping[str, tuple[str, ...]] = {
    "cmeel-urdfdom==4.0.1": ("cmeel-tinyxml2<11",),
    "mujoco-usd-converter==0.1.0": ("mujoco==3.5.0",),
    "pin==3.9.0": ("cmeel-urdfdom<5", "cmeel-tinyxml2<11"),
}
"""The libraries that a package was built with, where it does not ask for these versions."""


def install(package: str, version: str) -> None:
    """Install a package in its folder, unless it is there.

    Raises:
        CalledProcessError: pip finds no such release.
        FileNotFoundError: the Python that it needs is not here.
    """
    requirement, folder, python = f"{package}=={version}", folder_of(package, version), python_for(package, version)
    if version_in(folder, package):
        return
    if python is None:
        raise FileNotFoundError("a newer Python")
    print(requirement, flush=True)
    command = [sys.executable, "-m", "pip", "--python", python, "install", "-qqq", "--disable-pip-version-check"]
    subprocess.run([*command, "--target", str(folder), requirement, *_BESIDE.get(requirement, ())], check=True)


def main() -> None:
    """Install all releases that loaders are asked in and that are not there."""
    for loader in LOADERS:
        if loader.package is not None:
            try:
                install(*loader.package)
            except (subprocess.CalledProcessError, FileNotFoundError) as error:
                print(f"{loader.consumer} cannot be installed: {error}")


if __name__ == "__main__":
    main()
