"""The packages that judges look at, made by the installed command from the examples, and installed by CMake."""

import shlex
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from click.testing import CliRunner

from twinform.cli import main

ROOT = Path(__file__).parents[2]
AMENT = Path(__file__).with_name("ament")

_DRIVE = (
    "add-sensor{type=imu link=imu_link frame-id=imu_link},"
    "add-sensor{type=camera link=camera_mount frame-id=camera_mount},"
    "add-sensor{type=gpu_lidar link=camera_mount frame-id=camera_mount},"
    "add-plugin{system=diff-drive left-joint=[front_left_wheel_joint,rear_left_wheel_joint] "
    "right-joint=[front_right_wheel_joint,rear_right_wheel_joint] frame-id=odom child-frame-id=base_link},"
    "add-plugin{system=joint-state-publisher}"
)
TUTORIAL = (ROOT / "docs/tutorial/ros2-package.md").read_text(encoding="utf-8")
_COURIER = next(
    line for line in TUTORIAL.splitlines() if line.startswith("$ ") and "-o out/courier --kind ros2 --desc" in line
)
_COURIERS_PASSES = shlex.split(_COURIER)[-1]

ROBOTS: dict[str, tuple[str, ...]] = {
    "arm_description": ("arm.urdf", "--kind", "both"),
    "four_wheels": ("four_wheels.urdf.xacro", "--kind", "ros2"),
    "standard_robot": ("standard_robot.urdf", "--kind", "ros2", "--passes", _DRIVE),
    "fortress_robot": (
        "standard_robot.urdf",
        "--kind",
        "both",
        "--no-thumbnail",
        "--gazebo",
        "fortress",
        "--passes",
        _DRIVE,
    ),
    "courier": ("courier_description/urdf/courier.urdf.xacro", "--kind", "ros2", "--passes", _COURIERS_PASSES),
    "gripper": ("gripper.urdf", "--kind", "ros2"),
    "crate": ("crate/model.sdf", "--kind", "ros2"),
}
"""Names of packages with what the command gets for them."""
SAID = ("--description", 'A robot & its "things"', "--maintainer", "Ann <Onym>", "--email", "ann@example.org")


@dataclass(frozen=True)
class Made:
    """A package: the folder that was written, and the prefix that it was installed into, if CMake is here."""

    name: str
    folder: Path
    prefix: Path

    @property
    def share(self) -> Path:
        """Where CMake puts what is for other packages."""
        return self.prefix / "share" / self.name


def make(name: str, folder: Path) -> Made:
    """Run the command."""
    source, *options = ROBOTS[name]
    made = Made(name, folder / "src" / name, folder / "install")
    words = [
        "package",
        str(ROOT / "examples" / source),
        "-o",
        str(made.folder),
        *SAID,
        "--license",
        "Apache-2.0",
        *options,
    ]
    done = CliRunner().invoke(main, words, catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return made


def install(made: Made) -> None:
    """Configure and install a package with CMake and our few lines of ament."""
    cmake = shutil.which("cmake")
    assert cmake
    build = made.prefix.parent / "build" / made.name
    settings = [f"-DCMAKE_PREFIX_PATH={AMENT}", f"-DCMAKE_INSTALL_PREFIX={made.prefix}", "--warn-uninitialized"]
    for words in (["-S", made.folder, "-B", build, *settings], ["--install", build]):
        done = subprocess.run([cmake, *words], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        assert not done.stderr, done.stderr
