"""Two robots, each as an engine sees it: are they the same? The engines run in this process (see `isolated.py`)."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TypeVar

import numpy as np

from twinform.dataclass import dataclass
from twinform.passes.carriers.token_mass import CHAIN_MASS, TOKEN_MASS
from twinform.testing.oracles.engines import Alike, EngineUnreadableError, Verdict, required
from twinform.testing.oracles.robot import EngineRobot, Matrix, Sample, View
from twinform.testing.oracles.robot import lumped as weighed_together

TOLERANCE = 1e-9
NOTHING = 1000 * TOKEN_MASS
"""A mass in kg, or a moment in kg m^2, that counts as none: a few massless links with token masses, meters away."""
IN_CHAINS = 10 * CHAIN_MASS
"""The mass or moment that counts as none for robots with joint chains: a few links of chains."""
Part = TypeVar("Part")
_POSES = frozenset({"position", "rotation"})
_SHOWN = 4


@dataclass(frozen=True, slots=True)
class _Deviation:
    """The size of a difference in one quantity, and where it is."""

    kind: str
    size: float
    where: str = ""

    def __str__(self) -> str:
        return f"{self.kind} of {self.where}" if self.where else self.kind


def read_robot(path: Path, engine: str, view: View | None = None) -> EngineRobot:
    """Read a file with an engine.

    Raises:
        EngineMissingError: the engine is not installed.
        EngineUnreadableError: the engine cannot read the file.
    """
    chosen = required(engine)
    if not chosen.reads(path):
        raise EngineUnreadableError(engine, path, f"it does not read {path.suffix or 'files without a suffix'}")
    try:
        return import_module(chosen.module).read(path, view or View())
    except (Exception, SystemExit) as error:
        raise EngineUnreadableError(engine, path, str(error) or type(error).__name__) from error


def compared(first: Path, second: Path, engines: tuple[str, str], lumped: bool) -> Verdict:
    """Read two files with an engine each, and compare them.

    Raises:
        EngineUnreadableError: an engine cannot read its file.
    """
    return verdict_on(read_robot(first, engines[0]), (first, second), engines, lumped=lumped)


def verdict_on(
    first: EngineRobot, files: tuple[Path, Path], engines: tuple[str, str], *, lumped: bool = False
) -> Verdict:
    """Compare two files, of which the first has been read.

    Raises:
        EngineUnreadableError: an engine cannot read its file.
    """
    (source, result), (before, after) = files, engines
    second = read_robot(result, after, View(reference=first.reference))
    names = renamed(first, second)
    here, there = chained(first, second), chained(second, first)
    if names or here:
        second = read_robot(result, after, View(names, first.reference, here))
    # Both are seen from one link, or the poses of all others would differ by that of the root.
    if second.reference != first.reference or there:
        first = read_robot(source, before, View(reference=second.reference, still=there))
    tolerance = max(required(engine).formats[path.suffix] for engine, path in zip(engines, files, strict=True))
    return judge(first, second, tolerance=tolerance, lumped=lumped, chains=bool(here or there))


def judge(
    first: EngineRobot, second: EngineRobot, *, tolerance: float = TOLERANCE, lumped: bool = False, chains: bool = False
) -> Verdict:
    """Compare two robots; `lumped` weighs links together that are fixed to each other.

    `chains` says that one of them has joint chains where the other has a joint.
    """
    nothing = IN_CHAINS if chains else NOTHING
    second = _by_scopes(first, second)
    if lumped or first.lumped or second.lumped:
        lumped = True
        first, second = (each if each.lumped else weighed_together(each) for each in (first, second))
    found = _largest_of_each_kind(first, second, nothing)
    worst = _largest(found)
    weight = _largest(one for one in found if one.kind not in _POSES)
    apart = _largest(one for one in found if one.kind in _POSES)
    # Links of chains weigh 2e-6 kg in URDF and nothing in SDF.
    exact = max(tolerance, IN_CHAINS) if chains else tolerance
    if cause := _other_parts(first, second, nothing) or _other_limits(first, second) or _other_numbers(found, exact):
        return _verdict(first, second, None, worst, cause)
    if lumped:
        return _verdict(first, second, Alike.LUMPED, weight)
    if apart.size <= tolerance and set(first.links) <= set(second.links):
        return _verdict(first, second, Alike.FRAMES, worst)
    return _verdict(first, second, Alike.INERTIAL, weight)


def renamed(source: EngineRobot, result: EngineRobot) -> dict[str, str]:
    """Map new names of joints to the old ones, for joints renamed because a link had the same name."""
    lost = (set(source.joints) - set(result.joints)) & {*source.links, *result.links}
    return {f"{name}_joint": name for name in lost if f"{name}_joint" in result.joints}


def chained(first: EngineRobot, second: EngineRobot) -> frozenset[str]:
    """Return the joints of the second robot that are part of a chain standing for one joint of the first.

    SDF's joints with several degrees of freedom, and its screws, become several joints of URDF, whose names begin with
    the name of the joint.
    """
    added = set(second.joints) - set(first.joints)
    whole = set(first.others) - set(second.others)
    return frozenset(name for name in added for joint in whole if name == joint or name.startswith(f"{joint}_"))


def _by_scopes(first: EngineRobot, second: EngineRobot) -> EngineRobot:
    """Return the second robot with the scoped names of links that the first one has."""
    # URDF has no scopes: a link `model::link` is called `model__link` there.
    flat = {name.replace("::", "__"): name for name in first.links if "::" in name and name not in second.links}
    if not flat.keys() & set(second.links):
        return second

    def named(parts: Mapping[str, Part]) -> dict[str, Part]:
        return {flat.get(name, name): part for name, part in parts.items()}

    samples = tuple(
        replace(one, poses=named(one.poses), bodies=named(one.bodies), frames=named(one.frames))
        for one in second.samples
    )
    welds = {flat.get(link, link): flat.get(other, other) for link, other in second.welds.items()}
    links = tuple(flat.get(name, name) for name in second.links)
    return replace(second, links=links, samples=samples, welds=welds)


def _verdict(
    first: EngineRobot, second: EngineRobot, alike: Alike | None, found: _Deviation, cause: str = ""
) -> Verdict:
    engine = first.engine if first.engine == second.engine else f"{first.engine} and {second.engine}"
    return Verdict(engine, alike, found.size, str(found) if found.size else "", cause)


def _largest_of_each_kind(first: EngineRobot, second: EngineRobot, nothing: float) -> list[_Deviation]:
    scales = _scales(first.samples)
    largest: dict[str, _Deviation] = {}
    for before, after in zip(first.samples, second.samples, strict=True):
        for one in _deviations(first, second, before, after, nothing):
            scaled = replace(one, size=_number(one.size / scales.get(one.kind, 1.0)))
            if one.kind not in largest or scaled.size > largest[one.kind].size:
                largest[one.kind] = scaled
    return list(largest.values())


def _scales(samples: Sequence[Sample]) -> Mapping[str, float]:
    """Return what the differences of each kind are measured against: the largest number of the kind, at least one."""
    bodies = [body for sample in samples for body in sample.bodies.values()]
    values: dict[str, list[float | Matrix]] = {
        "gravity": [force for sample in samples for force in sample.gravity.values()],
        "position": [pose[:3, 3] for sample in samples for pose in sample.poses.values()],
        "frame position": [
            pose[:3, 3] for sample in samples for pose in (*sample.poses.values(), *sample.frames.values())
        ],
        "mass": [body.mass for body in bodies],
        "center of mass": [body.center for body in bodies],
        "inertia": [body.inertia for body in bodies],
    }
    return {kind: max([1.0, *(float(np.abs(value).max()) for value in each)]) for kind, each in values.items()}


def _deviations(
    first: EngineRobot, second: EngineRobot, before: Sample, after: Sample, nothing: float
) -> Iterator[_Deviation]:
    shared = [name for name in first.joints if name in second.joints]
    yield _mass_matrix(shared, _part(first, before, shared), _part(second, after, shared))
    for name in shared:
        yield _Deviation("gravity", abs(before.gravity[name] - after.gravity[name]), f"joint {name}")
    for name in before.poses.keys() & after.poses.keys():
        gap = np.abs(before.poses[name] - after.poses[name])
        yield _Deviation("position", float(gap[:3, 3].max()), f"link {name}")
        yield _Deviation("rotation", float(gap[:3, :3].max()), f"link {name}")
    yield from _frames(before, after)
    for name in _massive(before, nothing) & _massive(after, nothing):
        one, other, where = before.bodies[name], after.bodies[name], f"link {name}"
        yield _Deviation("mass", abs(one.mass - other.mass), where)
        yield _Deviation("center of mass", float(np.abs(one.center - other.center).max()), where)
        yield _Deviation("inertia", float(np.abs(one.inertia - other.inertia).max()), where)


def _frames(before: Sample, after: Sample) -> Iterator[_Deviation]:
    """Yield how far apart a frame of one robot and the frame or link of that name in the other are."""
    ours, theirs = {**before.poses, **before.frames}, {**after.poses, **after.frames}
    for name in (before.frames.keys() | after.frames.keys()) & ours.keys() & theirs.keys():
        gap = np.abs(ours[name] - theirs[name])
        yield _Deviation("frame position", float(gap[:3, 3].max()), f"frame {name}")
        yield _Deviation("frame rotation", float(gap[:3, :3].max()), f"frame {name}")


def _massive(sample: Sample, nothing: float) -> set[str]:
    """Return the links with mass; a token mass, which some engines need on every link, is none."""
    return {name for name, body in sample.bodies.items() if body.mass > nothing}


def _part(robot: EngineRobot, sample: Sample, joints: list[str]) -> Matrix:
    rows = [robot.joints.index(name) for name in joints]
    return sample.mass_matrix[np.ix_(rows, rows)]


def _mass_matrix(joints: list[str], before: Matrix, after: Matrix) -> _Deviation:
    if not joints:
        return _Deviation("mass matrix", 0.0)
    gap = np.abs(before - after)
    if max(float(np.abs(before).max()), float(np.abs(after).max())) <= NOTHING:
        return _Deviation("mass matrix", 0.0)
    row, column = np.unravel_index(int(gap.argmax()), gap.shape)
    size = float(gap.max()) / max(float(np.abs(before).max()), 1e-300)
    return _Deviation("mass matrix", size, f"joints {joints[row]} and {joints[column]}")


def _largest(found: Iterable[_Deviation]) -> _Deviation:
    return max(found, key=lambda one: one.size, default=_Deviation("", 0.0))


def _number(size: float) -> float:
    # NaN is as far from right as can be
    return math.inf if math.isnan(size) else size


def _other_parts(first: EngineRobot, second: EngineRobot, nothing: float) -> str:
    """Name joints, and links with mass, that only one robot has; massless links may become frames and back."""
    before, after = (_massive(robot.samples[0], nothing) for robot in (first, second))
    parts = [
        ("joints lost", set(first.joints) - set(second.joints)),
        ("joints added", set(second.joints) - set(first.joints)),
        ("links lost", before - after),
        ("links added", after - before),
    ]
    return "; ".join(f"{what}: {', '.join(sorted(names))}" for what, names in parts if names)


def _other_limits(first: EngineRobot, second: EngineRobot) -> str:
    texts = [
        f"{name}.{key} {one[key]:g} became {other[key]:g}"
        for name, one in first.limits.items()
        if (other := second.limits.get(name)) is not None
        for key in one
        if key in other and not _close(one[key], other[key])
    ]
    return f"limits and damping: {'; '.join(texts[:_SHOWN])}" if texts else ""


def _close(one: float, other: float) -> bool:
    return one == other or abs(one - other) <= TOLERANCE * max(1.0, abs(one))


def _other_numbers(found: Iterable[_Deviation], tolerance: float) -> str:
    wrong = [f"{one.kind} {one.size:.2g}" for one in found if one.kind not in _POSES and one.size > tolerance]
    return f"other numbers: {', '.join(wrong)}" if wrong else ""
