"""The facts about a composed stage of USD: its units, and its prims with their places, values and targets."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from functools import cached_property
from typing import Any, cast

from twinform.dataclass import dataclass
from twinform.diagnostics import Source
from twinform.ir import Pose, Vector3
from twinform.ir.transform import Matrix3, Transform


@dataclass(frozen=True, slots=True)
class Prim:
    """A prim of a stage.

    `place` is its frame in the world, in meters and with z up, and `scale` the length there of each of its own units.
    `name` is the one that it is displayed by, or else that of its path.
    """

    path: str
    type: str
    name: str
    schemas: frozenset[str]
    place: Transform
    scale: Vector3
    values: Mapping[str, object] = field(default_factory=dict[str, object])
    targets: Mapping[str, tuple[str, ...]] = field(default_factory=dict[str, tuple[str, ...]])
    source: Source | None = None

    def has(self, schema: str) -> bool:
        """Whether an API schema is applied, of those with instances any one."""
        return schema in self.schemas or any(each.startswith(f"{schema}:") for each in self.schemas)

    def on(self, name: str) -> bool:
        """Whether a boolean is not false; all that turn a part of the physics off are true where nothing is written."""
        return self.values.get(name) is not False

    def number(self, name: str) -> float | None:
        """Return a number, or None where none is written."""
        value = self.values.get(name)
        return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None

    def first(self, *names: str) -> float | None:
        """Return the first of some numbers that is written."""
        return next((value for name in names if (value := self.number(name)) is not None), None)

    def numbers(self, name: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return as many numbers as the default has, or the default."""
        value = self.values.get(name)
        if not isinstance(value, list) or len(cast("list[object]", value)) != len(default):
            return default
        return tuple(map(float, cast("list[float]", value)))

    def token(self, name: str, default: str) -> str:
        """Return a token, or the default."""
        value = self.values.get(name)
        return value if isinstance(value, str) else default

    def target(self, name: str) -> str | None:
        """Return the first target of a relationship."""
        return next(iter(self.targets.get(name, ())), None)

    def point(self, name: str) -> Vector3:
        """Return a point in the frame of this prim, in meters."""
        return scaled(self.numbers(name, (0.0, 0.0, 0.0)), self.scale)


def rotation_of(prim: Prim, name: str) -> Matrix3:
    """Return a rotation that a prim has as a quaternion, its real part first."""
    w, x, y, z = prim.numbers(name, (1.0, 0.0, 0.0, 0.0))
    return Transform.from_pose(Pose.unchecked(quat_xyzw=(x, y, z, w))).rotation


def scaled(numbers: Iterable[float], scale: Vector3) -> Vector3:
    """Return three numbers, each times its own scale."""
    x, y, z = (number * factor for number, factor in zip(numbers, scale, strict=True))
    return (x, y, z)


@dataclass(frozen=True)
class Stage:
    """A composed stage: its units of length and mass in SI, and its frame in one with z up, which is its `root`."""

    default: str
    meters: float
    kilograms: float
    root: Transform
    prims: Mapping[str, Prim]

    @cached_property
    def bodies(self) -> frozenset[str]:
        """The paths of the rigid bodies."""
        return frozenset(path for path, each in self.prims.items() if _is_body(each))

    def body_of(self, path: str | None) -> str | None:
        """Return the rigid body that a prim is or belongs to; None for what belongs to none, and stands still."""
        return next((each for each in paths_up(path or "") if each in self.bodies), None)


def _is_body(prim: Prim) -> bool:
    return prim.has("PhysicsRigidBodyAPI") and prim.on("physics:rigidBodyEnabled")


def paths_up(path: str) -> Iterator[str]:
    """Yield a path and those above it, the longest first."""
    while path.count("/") >= 1 and path != "/":
        yield path
        path = path.rpartition("/")[0]


def stage_of(facts: Mapping[str, Any], file: str) -> Stage:
    """Make a stage of what the child process says about it; `file` stands in the sources of its prims."""
    meters = _positive(facts["meters"])
    upright = Transform.from_pose(Pose.unchecked(rpy=(math.pi / 2, 0.0, 0.0) if facts["up"] == "Y" else None))
    prims = (_prim_of(each, meters, upright, file) for each in facts["prims"])
    kilograms = _positive(facts["kilograms"])
    return Stage(str(facts["default"]), meters, kilograms, upright, {prim.path: prim for prim in prims})


def _positive(number: float) -> float:
    return number if 0 < number < math.inf else 1.0


def _prim_of(facts: Mapping[str, Any], meters: float, upright: Transform, file: str) -> Prim:
    place, scale = _place(facts["matrix"], meters)
    path = str(facts["path"])
    return Prim(
        path,
        facts["type"],
        facts["name"] or path.rpartition("/")[2],
        frozenset(facts["schemas"]),
        upright.compose(place),
        scale,
        facts["values"],
        {name: tuple(each) for name, each in facts["targets"].items()},
        Source(file, 0, None, path.removeprefix("/")),
    )


def _place(matrix: list[float], meters: float) -> tuple[Transform, Vector3]:
    """Return the rigid part of a matrix whose rows are the images of the axes and the origin, and the scales."""
    rows = [matrix[at : at + 3] for at in (0, 4, 8)]
    lengths = [math.hypot(*row) or 1.0 for row in rows]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = (
        [number / length for number in row] for row, length in zip(rows, lengths, strict=True)
    )
    if xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx) < 0:  # a mirror image
        lengths[0], xx, xy, xz = -lengths[0], -xx, -xy, -xz
    x, y, z = (number * meters for number in matrix[12:15])
    sx, sy, sz = (length * meters for length in lengths)
    return Transform((x, y, z), (xx, yx, zx, xy, yy, zy, xz, yz, zz)), (sx, sy, sz)
