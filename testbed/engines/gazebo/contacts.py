"""What a ball touches, in DART as Gazebo uses it."""

import json
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from testbed.engines.gazebo.library import PACKAGES, PhysicsEngine, available, plugin_folder
from twinform.testing.oracles.libsdformat import Program

_DETECTOR = "dart-collision-ode"
_PROGRAM = Program(Path(__file__).with_name("contacts.cpp"), PACKAGES, (_DETECTOR,))

Point = tuple[float, float, float]


def can_touch() -> bool:
    """Whether DART is installed with the detector of contacts that Gazebo uses."""
    return available(PhysicsEngine.DART) and Path("/usr/include/dart/collision/ode").is_dir()


class Contact(NamedTuple):
    """How deep a ball is, 0 where it touches nothing, and how large a ball there has to be to touch; in m."""

    depth: float
    reach: float


def contacts(asked: Iterable[tuple[Path, float, Sequence[Point]]]) -> list[list[Contact]]:
    """What a ball of a radius touches in a file, at each of its centers, for each of the questions.

    Centers are in m, in the frame of the model.
    """
    lines = (
        f"{path}|{radius!r}|{';'.join(' '.join(map(repr, each)) for each in centers)}\n"
        for path, radius, centers in asked
    )
    command = [str(_PROGRAM.built()), str(plugin_folder())]
    done = subprocess.run(command, input="".join(lines).encode(), stdout=subprocess.PIPE, check=True)
    # the engine prints its version between the answers
    rows = (json.loads(line) for line in done.stdout.splitlines() if line.startswith(b"[["))
    return [[Contact(*each) for each in row] for row in rows]
