"""Drake as a judge of conversions: are these two files the same robot?

The joint positions and the comparison are those of the oracle scripts beside the corpus; this file decides by them.
"""

import importlib.util
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from benchmarks.drake_model import Samples, read
from tests.corpus.files import SHARED

ORACLES = SHARED / "oracles"
TOLERANCE = 1e-9
_SAMPLES = 5
_INERTIAL = ("M_rel", "gravity", "com", "inertia", "mass")
_FRAMES = (*_INERTIAL, "frame_pos", "frame_rot")


class Judge(StrEnum):
    """What was found equal: everything, or everything but where the frames of links lie."""

    FRAMES = "frames"
    INERTIAL = "inertial"


@dataclass(frozen=True, slots=True)
class Judgement:
    """Whether two models are the same robot: `judge` says in which sense, and is None where they are not."""

    judge: Judge | None
    difference: float
    cause: str = ""


def available() -> bool:
    """Whether Drake and the oracle scripts are here."""
    return importlib.util.find_spec("pydrake") is not None and ORACLES.is_dir()


def load(path: Path, names: Mapping[str, str] | None = None, reference: str | None = None) -> Samples:
    """A model as Drake sees it; see `benchmarks.drake_model.read`."""
    sample = _script("_common").qrand

    def position(joint: str, number: int) -> float:
        # by name only: a limit that differs is one finding, not another position of the whole robot
        return sample(joint, number, -math.inf, math.inf)

    return read(path, names=names or {}, reference=reference, position=position, count=_SAMPLES)


def renamed(source: Samples, result: Samples) -> dict[str, str]:
    """The joints that have a new name because a link had theirs: the old name by the new one."""
    lost = (set(source["dofs"]) - set(result["dofs"])) & set(source["links"])
    return {f"{name}_joint": name for name in lost if f"{name}_joint" in result["dofs"]}


def compare(source: Samples, result: Samples) -> Judgement:
    """The verdict on two models that Drake could read."""
    found: Mapping[str, Any] = _script("_common").compare(source, result)
    worst = {key: found["max"][key] / _magnitude(source, key) for key in _FRAMES}
    all_, inertial = max(worst.values()), max(worst[key] for key in _INERTIAL)
    if cause := _other_parts(source, result, found) or _other_limits(found):
        return Judgement(None, all_, cause)
    if not found["only_links_A"] and all_ <= TOLERANCE:
        return Judgement(Judge.FRAMES, all_)
    if inertial <= TOLERANCE:
        return Judgement(Judge.INERTIAL, inertial)
    measures = ", ".join(f"{key} {worst[key]:.2g}" for key in _INERTIAL if worst[key] > TOLERANCE)
    return Judgement(None, inertial, f"other numbers: {measures}")


def _magnitude(model: Samples, key: str) -> float:
    """What a difference is measured against: one, or the largest number of its kind where that is more."""
    name = {"gravity": "g", "inertia": "I", "frame_pos": "X"}.get(key, key)
    values = (value for sample in model["samples"] for value in sample.get(name, {}).values())
    return max([1.0, *(float(np.abs(value).max()) for value in values)])


def _other_parts(source: Samples, result: Samples, found: Mapping[str, Any]) -> str:
    """Joints that only one of the models has, and links with mass; massless links may become frames and back."""
    parts = [
        ("joints lost", found["only_dofs_A"]),
        ("joints added", found["only_dofs_B"]),
        ("links lost", _massive(source, found["only_links_A"])),
        ("links added", _massive(result, found["only_links_B"])),
    ]
    return "; ".join(f"{what}: {', '.join(names)}" for what, names in parts if names)


def _other_limits(found: Mapping[str, Any]) -> str:
    limits: Mapping[str, tuple[float, float]] = found.get("limit_diff", {})
    texts = [f"{name} {before:g} became {after:g}" for name, (before, after) in limits.items()]
    return f"limits and damping: {'; '.join(texts[:4])}" if texts else ""


def _massive(model: Samples, links: list[str]) -> list[str]:
    mass = model["samples"][0]["mass"]
    return [link for link in links if mass[link] > 0]


@cache
def _script(name: str) -> ModuleType:
    """One of the oracle scripts, which import each other by their bare names."""
    if str(ORACLES) not in sys.path:
        sys.path.insert(0, str(ORACLES))
    return importlib.import_module(name)
