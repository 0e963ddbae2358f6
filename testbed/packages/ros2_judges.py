"""The programs that are shown a package of ROS 2, after the example of those for model folders."""

import ast
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

from testbed.packages.judges import Judge, Packaged
from testbed.ros2 import robot_state_publisher as publisher
from testbed.ros2.frames import differences
from testbed.ros2.judges import manifest, yaml_problems
from testbed.ros2.launch_stubs import described, texts
from testbed.ros2.packages import Made, install
from twinform.compiler import CompileError
from twinform.testing.oracles import libsdformat

_URI = re.compile(r"(?:package|model)://([^\s\"'<>]+)")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_WHERE = re.compile(r"^\d+: |[\"'\[].*?[\]\"']|link named \S+|file:\S+")
"""What differs between the same errors of two files."""


def made(packaged: Packaged) -> Made:
    """Where a package is, and where CMake puts it."""
    return Made(packaged.folder.name, packaged.folder, packaged.folder.parent / "install")


def _catkin(packaged: Packaged) -> str:
    return "; ".join(manifest(packaged.folder).warnings[:2])


def _cmake(packaged: Packaged) -> str:
    """What CMake reports, and the files that a URI names and that are not there once it has installed the package."""
    try:
        install(made(packaged))
    except AssertionError as error:
        return str(error)
    return "; ".join(list(_find_missing_files(made(packaged)))[:2])


def _find_missing_files(package: Made) -> Iterator[str]:
    for file in (*package.share.glob("urdf/*.urdf"), *package.share.glob("*.sdf")):
        for path in dict.fromkeys(_URI.findall(_COMMENT.sub("", file.read_text(encoding="utf-8")))):
            if not (package.share.parent / path).is_file():
                yield f"{file.name} names {path}"


def _launch(packaged: Packaged) -> str | None:
    """The files that launch files name and that are not installed; None where CMake has not installed the package."""
    package = made(packaged)
    if not package.share.is_dir():
        return None
    named = [
        Path(text)
        for file in sorted(package.share.glob("launch/*.launch.py"))
        for text in texts(described(file, package.prefix))
        if text.startswith(str(package.prefix)) and "\n" not in text
    ]
    lost = [path for path in named if not path.is_file() and "ros_gz_sim" not in path.parts]
    return "; ".join(f"{path.name} is not there" for path in lost[:2])


def _yamllint(packaged: Packaged) -> str:
    files = [path for path in packaged.folder.rglob("*") if path.suffix in {".yaml", ".rviz"}]
    return "; ".join([each for path in files for each in yaml_problems(path.read_text(encoding="utf-8"))][:2])


def _python(packaged: Packaged) -> str:
    for path in packaged.folder.glob("launch/*.py"):
        try:
            ast.parse(path.read_text(encoding="utf-8"))
        except SyntaxError as error:
            return str(error)
    return ""


def _urdfdom(packaged: Packaged) -> str:
    done = subprocess.run(["check_urdf", _urdf(packaged)], capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else (done.stdout + done.stderr).strip()[:300]


def _libsdformat(packaged: Packaged) -> str:
    """The errors that are not those of the robot that was packaged."""
    world = packaged.folder / "worlds" / f"{packaged.folder.name}.sdf"
    verdicts = libsdformat.judge([packaged.robot.file, _urdf(packaged), world])
    before, *after = (verdict.errors for verdict in verdicts.values())
    known = {_WHERE.sub("", error) for error in before}
    return "; ".join([error for errors in after for error in errors if _WHERE.sub("", error) not in known][:2])


def _frames(packaged: Packaged) -> str | None:
    """How the frames of ROS differ from ours; None for one link alone, which has none."""
    home = packaged.folder.parent / "ros"
    home.mkdir(exist_ok=True)
    if b"<joint" not in _urdf(packaged).read_bytes():
        return None
    try:
        return "; ".join(list(differences(_urdf(packaged), home))[:2])
    except CompileError as error:
        return str(error)


def _urdf(packaged: Packaged) -> Path:
    return packaged.folder / "urdf" / f"{packaged.folder.name}.urdf"


def _program(name: str) -> str:
    return "" if shutil.which(name) else "not installed"


JUDGES: tuple[Judge, ...] = (
    Judge("catkin_pkg", "reads and validates `package.xml` without a warning", _catkin),
    Judge(
        "CMake",
        "installs the package without a warning, with a few lines in place of ament; all URIs lead to installed files",
        _cmake,
        lambda: _program("cmake"),
    ),
    Judge("launch", "launch files run, with a few lines in place of ROS, and name files that are installed", _launch),
    Judge("Python", "launch files are Python", _python),
    Judge("yamllint", "finds nothing in the files of YAML", _yamllint),
    Judge("check_urdf", "urdfdom reads the robot", _urdfdom, lambda: _program("check_urdf")),
    Judge(
        "libsdformat 12",
        "reads the robot, as Gazebo gets it, and the world without an error that it does not find in the source",
        _libsdformat,
        lambda: "" if libsdformat.available() else "not installed",
    ),
    Judge(
        "robot_state_publisher",
        "that of ROS 1, which Debian has, publishes the frames that our frame graph has, with all joints moved",
        _frames,
        lambda: "" if publisher.available() else "not installed",
    ),
)
