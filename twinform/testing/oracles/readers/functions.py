"""How each reader is called: a function of a path that raises where the file is refused, and returns what it reads."""

import importlib
import json
import os
import subprocess
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from twinform.testing.oracles import libsdformat

URDF_LOADER = Path(__file__).with_name("urdf_loader.mjs")
NODE_MODULES = "TWINFORM_NODE_MODULES"
"""The variable with the folder in which npm has installed urdf-loader and jsdom."""


class RefusedError(Exception):
    """A reader that tells without an exception of its own."""


def _module(name: str) -> Any:
    return importlib.import_module(name)


def _libsdformat(path: Path) -> str:
    found = libsdformat.judge([path])[path.resolve()]
    if not found.ok:
        raise RefusedError("; ".join(found.errors))
    return found.console


def _urdfdom(path: Path) -> str:
    done = subprocess.run(["check_urdf", str(path)], capture_output=True, text=True, check=False, errors="replace")
    if done.returncode:
        raise RefusedError(done.stderr)
    return done.stderr


def _drake(path: Path) -> str:
    plant = _module("pydrake.multibody.plant").MultibodyPlant(0.001)
    _module("pydrake.multibody.parsing").Parser(plant).AddModels(str(path))
    return ""


def _mujoco(path: Path) -> str:
    _module("mujoco").MjModel.from_xml_path(str(path))
    return ""


def _pinocchio(path: Path) -> str:
    return str(_module("pinocchio").buildModelFromUrdf(str(path)))


def _pybullet(path: Path) -> str:
    bullet = _module("pybullet")
    client = bullet.connect(bullet.DIRECT)
    load = bullet.loadURDF if path.suffix == ".urdf" else bullet.loadSDF
    return str(load(str(path), physicsClientId=client))


def _yourdfpy(path: Path) -> str:
    robot = _module("yourdfpy").URDF.load(str(path), load_meshes=False, build_scene_graph=False)
    return "; ".join(map(str, robot.errors if not robot.validate() else ()))


def _urdf_parser_py(path: Path) -> str:
    _module("urdf_parser_py.urdf").URDF.from_xml_string(path.read_bytes())
    return ""


def _urchin(path: Path) -> str:
    _module("urchin").URDF.load(str(path), lazy_load_meshes=True)
    return ""


def _urdf_usd_converter(path: Path) -> str:
    with tempfile.TemporaryDirectory() as folder:
        _module("urdf_usd_converter").Converter().convert(str(path), folder)
    return ""


def _xacro(path: Path) -> str:
    written = _module("xacro").process_file(str(path)).toxml()
    return canonical(written.encode())


def _lxml(path: Path) -> str:
    etree = _module("lxml.etree")
    return canonical(etree.tostring(etree.parse(str(path)), pretty_print=True))


def canonical(text: bytes) -> str:
    """The content of a rewritten file, without what is of our namespace."""
    etree = _module("lxml.etree")
    root = etree.fromstring(text, etree.XMLParser(remove_blank_text=True, remove_comments=True, remove_pis=True))
    for element in root.xpath("//*[namespace-uri() = 'urn:twinform:1']"):
        element.getparent().remove(element)
    for element in root.iter():
        for name in [name for name in element.attrib if name.startswith("{urn:twinform:1}")]:
            del element.attrib[name]
        element.text, element.tail = (element.text or "").strip() or None, None
    etree.cleanup_namespaces(root)
    return etree.tostring(root, method="c14n").decode()


def _urdf_loader(path: Path) -> str:
    command = ["node", str(URDF_LOADER), os.environ[NODE_MODULES], str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RefusedError(done.stderr)
    return json.dumps(json.loads(done.stdout))


FUNCTIONS: Mapping[str, Callable[[Path], str]] = {
    "libsdformat": _libsdformat,
    "urdfdom": _urdfdom,
    "drake": _drake,
    "mujoco": _mujoco,
    "pinocchio": _pinocchio,
    "pybullet": _pybullet,
    "yourdfpy": _yourdfpy,
    "urdf_parser_py": _urdf_parser_py,
    "urchin": _urchin,
    "urdf-usd-converter": _urdf_usd_converter,
    "urdf-loader": _urdf_loader,
    "xacro": _xacro,
    "lxml": _lxml,
}


def prepare(name: str) -> None:
    """Import what a reader needs, once for all files."""
    for module in _MODULES.get(name, ()):
        _module(module)


_MODULES: Mapping[str, tuple[str, ...]] = {
    "drake": ("pydrake.multibody.plant", "pydrake.multibody.parsing"),
    "mujoco": ("mujoco",),
    "pinocchio": ("pinocchio",),
    "pybullet": ("pybullet",),
    "yourdfpy": ("yourdfpy",),
    "urdf_parser_py": ("urdf_parser_py.urdf",),
    "urchin": ("urchin",),
    "urdf-usd-converter": ("urdf_usd_converter",),
    "xacro": ("xacro",),
    "lxml": ("lxml.etree",),
}
