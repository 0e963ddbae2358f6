"""A process that is timed: `python -m benchmarks.worker NAME SECONDS`.

Paths come on standard input; for each it answers a line with the CPU seconds of one call, or after `!` why there are
none. A call that takes little is repeated until so many seconds are over, and the mean is told: what the garbage
collector does meanwhile is counted.
"""

import importlib
import logging
import os
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

Call = Callable[[], object]


def main(name: str, least: str) -> None:
    """Serve until standard input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what a library prints is no answer
    prepare = FUNCTIONS[name]
    for line in sys.stdin:
        print(_answer(prepare, Path(line.rstrip("\n")), float(least)), file=answers, flush=True)


def _answer(prepare: Callable[[Path], Call], path: Path, least: float) -> str:
    try:
        return f"{seconds_of(prepare(path), least):.9f}"
    except (Exception, SystemExit) as error:  # noqa: BLE001  whatever a reader throws, it refuses the file
        return f"! {type(error).__name__}: {' '.join(str(error).split())[:200]}"


def seconds_of(call: Call, least: float = 0) -> float:
    """The CPU time of a call: the mean of as many as it takes to be measured."""
    start, count, taken = time.process_time(), 0, 0.0
    while not count or taken < least:
        call()
        count += 1
        taken = time.process_time() - start
    return taken / count


def _module(name: str) -> Any:
    return importlib.import_module(name)


def _floor(path: Path) -> Call:
    etree, text = _module("lxml.etree"), path.read_bytes()
    return lambda: etree.tostring(etree.fromstring(text))


def _load(path: Path) -> Call:
    twinform = _module("twinform")
    return lambda: twinform.load(path)


def _to_sdf(path: Path) -> Call:
    twinform = _module("twinform")
    return lambda: twinform.convert(path, to="sdf")


def _to_urdf(path: Path) -> Call:
    twinform = _module("twinform")
    return lambda: twinform.convert(path, to="urdf")


def _to_mjcf(path: Path) -> Call:
    twinform = _module("twinform")
    return lambda: twinform.convert(path, to="mjcf")


def _drake(path: Path) -> Call:
    plant, parser = _module("pydrake.multibody.plant").MultibodyPlant, _module("pydrake.multibody.parsing").Parser
    logging.getLogger("drake").setLevel(logging.ERROR)  # each warning costs as much as a link

    def read() -> None:
        robot = plant(0.001)
        parser(robot).AddModels(str(path))

    return read


def _pinocchio(path: Path) -> Call:
    pinocchio = _module("pinocchio")
    return lambda: pinocchio.buildModelFromUrdf(str(path))


def _yourdfpy(path: Path) -> Call:
    yourdfpy = _module("yourdfpy")
    return lambda: yourdfpy.URDF.load(str(path), load_meshes=False, build_scene_graph=False)


def _urdf_parser_py(path: Path) -> Call:
    urdf = _module("urdf_parser_py.urdf")
    return lambda: urdf.URDF.from_xml_string(path.read_bytes())


FUNCTIONS: Mapping[str, Callable[[Path], Call]] = {
    "floor": _floor,
    "load": _load,
    "to SDF": _to_sdf,
    "to URDF": _to_urdf,
    "to MJCF": _to_mjcf,
    "Drake": _drake,
    "Pinocchio": _pinocchio,
    "yourdfpy": _yourdfpy,
    "urdf_parser_py": _urdf_parser_py,
}

if __name__ == "__main__":
    main(*sys.argv[1:])
