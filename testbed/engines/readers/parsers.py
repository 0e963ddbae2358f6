"""Readers that only parse a file: urdfdom, libsdformat, yourdfpy, urdf_parser_py, urchin, urdf-loader."""

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from testbed.engines.readers.answers import Answer, Kept, kept
from twinform.testing.oracles import libsdformat
from twinform.testing.oracles.libsdformat import Program, models_of

URDF_LOADER = Path(__file__).with_name("urdf_loader.mjs")
NODE_MODULES = "TWINFORM_NODE_MODULES"
"""The variable with the folder in which npm has installed urdf-loader and jsdom."""
_SECONDS = 30
URDFDOM = Program(Path(__file__).with_name("urdf_load.cpp"), ("urdfdom",))


class RefusedError(Exception):
    """A reader that tells without an exception of its own."""


def urdfdom(path: Path) -> Answer:
    """What robot_state_publisher, MoveIt and RViz read URDF with."""
    command = [str(URDFDOM.built()), str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, errors="replace")
    if done.returncode:
        raise RefusedError(f"ended with {done.returncode}: {done.stderr}")
    found: dict[str, Any] = json.loads(done.stdout)
    if not found:
        raise RefusedError(done.stderr)
    return Answer(done.stderr, kept(found["links"], found["joints"], found["masses"], found["shapes"]))


def check_urdf(path: Path) -> Answer:
    """The tool of urdfdom in the first folder of modules that has one: its messages, without what it keeps."""
    prefix = next(each for each in (Path(entry, "cmeel.prefix") for entry in sys.path) if (each / "bin").is_dir())
    environment = {**os.environ, "LD_LIBRARY_PATH": str(prefix / "lib")}
    command = [str(prefix / "bin/check_urdf"), str(path)]
    # it prints the tree, and comes to no end with a link that hangs on itself
    done = subprocess.run(
        command,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
        errors="replace",
        env=environment,
        timeout=_SECONDS,
    )
    if done.returncode:
        raise RefusedError(f"ended with {done.returncode}: {done.stderr}")
    return Answer(done.stderr)


def libsdformat12(path: Path) -> Answer:
    """What Gazebo reads SDF and URDF with; URDF becomes SDF in it, with links that are fixed to each other as one."""
    found, models = models_of(path)
    if not found.ok:
        # the error often only says that the file is bad, and the terminal has the reason
        raise RefusedError("; ".join([*found.errors, found.console]))
    links = [link for model in models for link in model["links"]]
    joints = [joint["name"] for model in models for joint in model["joints"]]
    shapes = sum(len(link["shapes"]) for link in links)
    names = [link["name"] for link in links]
    return Answer(found.console, kept(names, joints, ((link["name"], link["mass"]) for link in links), shapes))


def yourdfpy(path: Path) -> Answer:
    """What visualizers in Python read URDF with, without a scene."""
    return _yourdfpy(path, load_meshes=False, build_scene_graph=False)


def yourdfpy_with_scene(path: Path) -> Answer:
    """The same with what `load` does if it is given nothing but a file: its links have to be a tree."""
    return _yourdfpy(path)


def _yourdfpy(path: Path, **options: bool) -> Answer:
    robot = _module("yourdfpy").URDF.load(str(path), **options)
    objections = "; ".join(map(str, robot.errors if not robot.validate() else ()))
    return Answer(objections, _listed(robot.robot.links, robot.robot.joints))


def urdf_parser_py(path: Path) -> Answer:
    """What many ROS packages in Python read URDF with."""
    robot = _module("urdf_parser_py.urdf").URDF.from_xml_string(path.read_bytes())
    return Answer("", _listed(robot.links, robot.joints))


def urchin(path: Path) -> Answer:
    """The successor of urdfpy."""
    robot = _module("urchin").URDF.load(str(path), lazy_load_meshes=True)
    return Answer("", _listed(robot.links, robot.joints))


def urdf_loader(path: Path) -> Answer:
    """What web pages show URDF with."""
    command = ["node", str(URDF_LOADER), os.environ[NODE_MODULES], str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RefusedError(done.stderr)
    return Answer(json.dumps(json.loads(done.stdout)))


def _listed(links: list[Any], joints: list[Any]) -> Kept:
    """Of readers that have a list of each, and a mass in the inertial of a link."""
    found = [link for link in links if link.inertial is not None and link.inertial.mass is not None]
    shapes = sum(len(link.visuals) + len(link.collisions) for link in links)
    names = (link.name for link in links)
    masses = ((link.name, link.inertial.mass) for link in found)
    return kept(names, (joint.name for joint in joints), masses, shapes)


def available_urdfdom() -> bool:
    """Whether urdfdom and the tools to build against it are installed."""
    return URDFDOM.can_be_built()


def available_libsdformat() -> bool:
    """Whether libsdformat and the tools to build against it are installed."""
    return libsdformat.available()


def _module(name: str) -> Any:
    return importlib.import_module(name)
