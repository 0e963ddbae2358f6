"""How each reader is called: a function of a path that raises where the file is refused, and the modules it needs."""

import importlib
from collections.abc import Callable, Mapping
from pathlib import Path

from testbed.engines.readers import engines, parsers, rewriting
from testbed.engines.readers.answers import Answer

FUNCTIONS: Mapping[str, Callable[[Path], Answer]] = {
    "libsdformat": parsers.libsdformat12,
    "urdfdom": parsers.urdfdom,
    "check_urdf": parsers.check_urdf,
    "dart": engines.dart,
    "drake": engines.drake,
    "drake with a scene": engines.drake_with_scene,
    "mujoco": engines.mujoco,
    "newton": engines.newton,
    "pinocchio": engines.pinocchio,
    "pybullet": engines.pybullet,
    "yourdfpy": parsers.yourdfpy,
    "yourdfpy with a scene": parsers.yourdfpy_with_scene,
    "urdf_parser_py": parsers.urdf_parser_py,
    "urchin": parsers.urchin,
    "urdf-usd-converter": engines.urdf_usd_converter,
    "urdf-loader": parsers.urdf_loader,
    "xacro": rewriting.xacro,
    "lxml": rewriting.lxml,
}


def prepare(name: str) -> None:
    """Import what a reader needs, once for all files."""
    for module in _MODULES.get(name, ()):
        importlib.import_module(module)
    if name == "newton":
        importlib.import_module("warp").init()


_DRAKE = ("pydrake.multibody.plant", "pydrake.multibody.parsing", "pydrake.systems.framework", "pydrake.geometry")
_MODULES: Mapping[str, tuple[str, ...]] = {
    "dart": ("dartpy",),
    "drake": _DRAKE,
    "drake with a scene": _DRAKE,
    "mujoco": ("mujoco",),
    "newton": ("newton",),
    "pinocchio": ("pinocchio",),
    "pybullet": ("pybullet",),
    "yourdfpy": ("yourdfpy",),
    "yourdfpy with a scene": ("yourdfpy",),
    "urdf_parser_py": ("urdf_parser_py.urdf",),
    "urchin": ("urchin",),
    "urdf-usd-converter": ("urdf_usd_converter", "pxr.Usd", "pxr.UsdPhysics"),
    "xacro": ("xacro",),
    "lxml": ("lxml.etree",),
}
