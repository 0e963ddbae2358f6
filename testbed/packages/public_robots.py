"""Robots with meshes: those of `example-robot-data` and `pybullet_data`, where these packages are installed."""

import sysconfig
from dataclasses import dataclass
from pathlib import Path

MISSING = "no robots with meshes are here: pip install '.[robots]'"
_SITE = Path(sysconfig.get_path("purelib"))
_SHARE = _SITE / "cmeel.prefix/share"
_ROBOTS = {
    _SHARE / "example-robot-data/robots": (
        "a1_description/urdf/a1", "anymal_c_simple_description/urdf/anymal", "baxter_description/urdf/baxter",
        "centauro_description/urdf/centauro", "finger_edu_description/robots/finger_edu",
        "g1_description/urdf/g1_29dof_rev_1_0", "go2_description/urdf/go2", "panda_description/urdf/panda",
        "romeo_description/urdf/romeo", "so_arm_description/urdf/so100", "solo_description/robots/solo12",
        "tiago_description/robots/tiago", "ur_description/urdf/ur5_robot", "xarm_description/urdf/xarm7",
        "z1_description/urdf/z1",
    ),
    _SITE / "pybullet_data": ("laikago/laikago", "racecar/racecar", "quadruped/minitaur", "kuka_iiwa/model"),
}  # fmt: skip
"""Robots of as many makers, with meshes of every format that the packages have: COLLADA, STL and OBJ with textures."""


@dataclass(frozen=True, slots=True)
class Robot:
    """A URDF file, and the folders in which its packages are."""

    name: str
    file: Path
    paths: tuple[Path, ...] = ()


def robots() -> list[Robot]:
    """Those that are installed, by name."""
    found = [
        Robot(f"{_owner(folder)}/{name}", file, (_SHARE,) if _SHARE.is_dir() else ())
        for folder, names in _ROBOTS.items()
        for name in names
        if (file := folder / f"{name}.urdf").is_file()
    ]
    return sorted(found, key=lambda robot: robot.name)


def _owner(folder: Path) -> str:
    """The package that brings a folder of robots."""
    return folder.relative_to(_SHARE if folder.is_relative_to(_SHARE) else _SITE).parts[0]
