"""`python -S run_converter.py PACKAGE URDF FOLDER`: converts one file by a package on the path, and prints the result.

It runs without site-packages: converters bring modules of USD that must not be mixed with those of another release.
"""

import importlib
import re
import sys
from pathlib import Path
from typing import Any

_FOR_MUJOCO = r'\1<mujoco><compiler fusestatic="false" discardvisual="false" balanceinertia="false"/></mujoco>'
"""MuJoCo would otherwise merge links that are fixed to each other, and leave visuals out."""


def main(package: str, urdf: Path, folder: Path) -> str:
    """Convert a file, and return the path of the stage."""
    source = _as_mjcf(urdf, folder) if package == "mujoco-usd-converter" else urdf
    converter = _module(package.replace("-", "_")).Converter()
    return str(converter.convert(str(source), str(folder)).path)


def _as_mjcf(urdf: Path, folder: Path) -> Path:
    """MuJoCo reads URDF itself, and writes what it has read."""
    text = re.sub(r"(<robot\b[^>]*>)", _FOR_MUJOCO, urdf.read_text(encoding="utf-8"), count=1)
    spec = _module("mujoco").MjSpec.from_string(text)
    spec.compile()
    made = folder / f"{urdf.stem}.xml"
    made.write_text(spec.to_xml(), encoding="utf-8")
    return made


def _module(name: str) -> Any:
    return importlib.import_module(name)


if __name__ == "__main__":
    print(main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])), flush=True)
