"""The files that are timed: generated trees and chains, robots that many know, and the corpus."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import twinform
from testbed import robots
from testbed.corpus.files import CORPUS, CorpusFile, Kind, models
from testbed.output_files import OUT, kept

FOLDER = OUT / "bench"
KNOWN = {
    "KUKA iiwa 14": "RobotLocomotion+models/iiwa_description/urdf/iiwa14_primitive_collision.urdf",
    "Atlas": "RobotLocomotion+models/atlas/atlas_convex_hull.urdf",
    "Unitree G1 with hands": (
        "unitreerobotics+unitree_ros/robots/g1_description/g1_29dof_rev_1_0_with_inspire_hand_FTP.urdf"
    ),
}
"""An arm, a humanoid with transmissions and `<gazebo>`, and the URDF of the corpus with the most elements."""
_SHAPES = {"tree": robots.urdf, "chain": robots.chain}


@dataclass(frozen=True, slots=True)
class Robot:
    """A URDF file; `shape` is how it was generated, empty where it is a real one."""

    name: str
    path: Path
    links: int
    shape: str = ""


def generated(shape: str, links: int) -> Robot:
    """A generated robot, in a file."""
    path = kept(FOLDER / f"{shape}_of_{links}.urdf", _SHAPES[shape](links))
    return Robot(f"{shape} of {links:,}", path, links, shape)


def robots_in(folder: Path | None) -> Sequence[Robot]:
    """The URDF files of a folder, by name."""
    found = sorted(folder.glob("*.urdf")) if folder is not None else []
    return [Robot(path.stem, path, path.read_bytes().count(b"<link ")) for path in found]


def known() -> Iterator[Robot]:
    """The well-known robots, where the corpus is here."""
    for name, place in KNOWN.items():
        path = CORPUS / place
        if path.is_file():
            yield Robot(name, path, path.read_bytes().count(b"<link "))


def converted(robot: Robot, to: Literal["sdf", "mjcf"]) -> Path:
    """The robot in another language, as the compiler converts it by default.

    Raises:
        CompileError: the compiler refuses it.
    """
    return kept(FOLDER / f"{robot.path.stem}.{to}", twinform.convert(robot.path, to=to).text)


def corpus(every: int, *kinds: Kind) -> Sequence[CorpusFile]:
    """One of so many real files."""
    return [file for file in models() if not kinds or file.kind in kinds][::every] if CORPUS.is_dir() else []
