"""Files in gz-physics 5, the physics of Gazebo Fortress, with one of its engines."""

import json
import os
import subprocess
from collections.abc import Iterable
from enum import StrEnum
from functools import cache
from pathlib import Path

from testbed.engines.gazebo.reading import simulation
from testbed.engines.gazebo.results import Simulation
from testbed.engines.gazebo.settings import Settings
from twinform.testing.oracles.libsdformat import Program

MISSING = "gz-physics 5 is not here: it needs libignition-physics-dev with its engines, pkg-config and g++"

PACKAGES = ("ignition-physics5-dartsim", "ignition-physics5-sdf", "ignition-plugin1-loader")
_PROGRAM = Program(Path(__file__).with_name("gazebo_run.cpp"), PACKAGES)


class PhysicsEngine(StrEnum):
    """An engine of gz-physics. Bullet is that of constraints between free bodies, in single precision."""

    DART = "dart"
    BULLET = "bullet"
    TPE = "tpe"


_PLUGINS = {PhysicsEngine.DART: "dartsim", PhysicsEngine.BULLET: "bullet", PhysicsEngine.TPE: "tpe"}


def available(engine: PhysicsEngine = PhysicsEngine.DART) -> bool:
    """Whether the engine, and the tools to build a program around it, are installed."""
    return _PROGRAM.can_be_built() and (plugin_folder() / f"libignition-physics5-{_PLUGINS[engine]}-plugin.so").exists()


def simulate(
    paths: Iterable[Path], engine: PhysicsEngine = PhysicsEngine.DART, settings: Settings | None = None
) -> dict[Path, Simulation]:
    """What an engine makes of each file, URDF or SDF, a model or a world, each in a process of its own."""
    files = list(dict.fromkeys(Path(path).resolve() for path in paths))
    names = "".join(f"{file}\n" for file in files).encode()
    wanted = settings or Settings()
    command = [str(_PROGRAM.built()), str(plugin_folder()), engine.value, *wanted.arguments()]
    environment = os.environ | {"SDF_PATH": os.pathsep.join(str(folder) for folder in wanted.folders)}
    done = subprocess.run(command, input=names, stdout=subprocess.PIPE, check=True, env=environment)
    rows = done.stdout.decode(errors="replace").splitlines()
    return {file: simulation(json.loads(row)) for file, row in zip(files, rows, strict=True)}


@cache
def plugin_folder() -> Path:
    """The folder of the plugins."""
    command = ["pkg-config", "--variable=libdir", "ignition-physics5"]
    library = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    return Path(os.path.normpath(library), "ign-physics-5", "engine-plugins")
