"""What MuJoCo sees of two models that differs: joints and what they may do, geoms, masses, and how all of it moves."""

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from testbed.mjcf.compiled import BALL, FREE, Array, Compiled, GeomFacts, JointFacts, Motion

POSES = 20
"""So many random positions are compared."""
TOLERANCE = 1e-9
OF_MESHES = 1e-5
"""The points of meshes have single precision in MuJoCo, and those of text files as many digits as were written."""
_PLANAR = {"TX": "_x", "TY": "_y", "RZ": ""}
"""What our joints of a planar one are called where MuJoCo calls them NAME_TX, NAME_TY and NAME_RZ."""


_LIMITS = frozenset({"range", "force"})


class Pair(NamedTuple):
    """A joint of both models; of a planar one URDF has no limits, which MuJoCo takes for those of one direction."""

    name: str
    source: int
    made: int
    is_planar: bool = False


def differences(source: Compiled, made: Compiled, seed: int = 1) -> list[str]:
    """Return a line for each difference; none where the two are one robot to MuJoCo."""
    pairs, found = _pair(source, made)
    if found:
        return found
    found += [line for pair in pairs for line in _facts(pair, source.facts(pair.source), made.facts(pair.made))]
    return [*found, *_motions(source, made, pairs, np.random.default_rng(seed))]


def _pair(source: Compiled, made: Compiled) -> tuple[list[Pair], list[str]]:
    pairs: list[Pair] = []
    missing: list[str] = []
    others = dict(made.joints)
    for name, number in source.joints.items():
        other, is_planar = others.pop(name, None), False
        if other is None and not source.model.joint(number).name:
            news = [each for each in others if each not in source.joints]
            other = next((others.pop(each) for each in news if _may_be(source, number, made, others[each])), None)
        if other is None:
            stem, _, end = name.rpartition("_")
            other = others.pop(stem + _PLANAR.get(end, " "), None)
            is_planar = other is not None
        if other is None:
            missing.append(f"joint {name!r} is missing")
        else:
            pairs.append(Pair(name, number, other, is_planar))
    return pairs, [*missing, *(f"joint {name!r} is new" for name in others)]


def _may_be(source: Compiled, number: int, made: Compiled, other: int) -> bool:
    """Whether a joint without a name may be another: one without a name too, or one of its body with a made one."""
    return not made.model.joint(other).name or source.body_of(number) == made.body_of(other)


def _facts(pair: Pair, one: JointFacts, other: JointFacts) -> Iterator[str]:
    for name, first, second in zip(one._fields, one, other, strict=True):
        if (pair.is_planar and name in _LIMITS) or (name == "spring" and not (one.stiffness or other.stiffness)):
            continue  # where a spring without stiffness is at rest means nothing
        a, b = (np.atleast_1d(np.asarray(each, dtype=float)) for each in (first, second))
        if a.shape != b.shape or not np.allclose(a, b, rtol=TOLERANCE, atol=TOLERANCE):
            yield f"{name} of joint {pair.name!r}: {first} is {second}"


def _match_geoms(
    source: Compiled, made: Compiled, one: Motion, other: Motion
) -> tuple[list[tuple[int, int]], list[str]]:
    """The geoms of both models that are of one shape at one place, and what has no counterpart.

    They may be in another body: a link without mass that is fixed to another is a site of that in ours.
    """
    left = dict.fromkeys(range(made.model.ngeom))
    pairs: list[tuple[int, int]] = []
    missing: list[str] = []
    fits = _Fits(source, made, one, other)
    for number in range(source.model.ngeom):
        facts = source.geom(number)
        fit = next((each for each in left if fits(number, each)), None)
        if fit is None:
            missing.append(f"geom {number} of body {facts.body!r} is missing: {facts}")
            continue
        left.pop(fit)
        if not facts.is_mesh:  # where the bodies are tells where meshes go
            pairs.append((number, fit))
    return pairs, [*missing, *(f"geom {each} is new: {made.geom(each)}" for each in left)]


class _Fits:
    """Whether two geoms are of one shape at one place: meshes by the space that they take up."""

    def __init__(self, source: Compiled, made: Compiled, one: Motion, other: Motion) -> None:
        self._source = [source.geom(each) for each in range(source.model.ngeom)]
        self._made = [made.geom(each) for each in range(made.model.ngeom)]
        self._here = [_place(source, one, each) for each in range(source.model.ngeom)]
        self._there = [_place(made, other, each) for each in range(made.model.ngeom)]

    def __call__(self, number: int, each: int) -> bool:
        facts = self._source[number]
        if not _is_same(facts, self._made[each]):
            return False
        return _is_near(self._here[number], self._there[each], OF_MESHES if facts.is_mesh else TOLERANCE)


def _place(model: Compiled, motion: Motion, number: int) -> Array:
    return model.bounds(number) if model.geom(number).is_mesh else motion.geoms[number]


def _is_same(one: GeomFacts, other: GeomFacts) -> bool:
    if (one.kind, one.touches) != (other.kind, other.touches):
        return False
    return bool(np.allclose(one.size, other.size, rtol=TOLERANCE, atol=TOLERANCE))


def _is_near(one: Array, other: Array, tolerance: float) -> bool:
    return bool(np.allclose(one, other, rtol=0.0, atol=tolerance * max(1.0, float(np.max(np.abs(one))))))


def _motions(source: Compiled, made: Compiled, pairs: list[Pair], draw: np.random.Generator) -> list[str]:
    """The first difference of each kind at random positions."""
    found: dict[str, str] = {}
    order = _velocity_order(source, made, pairs)
    geoms: list[tuple[int, int]] | None = None
    for _ in range(POSES):
        one, other = _at_random(source, made, pairs, order, draw)
        compare(found, "the mass matrix", one.mass, other.mass[np.ix_(order, order)])
        compare(found, "the bias forces", one.bias, other.bias[order])
        _compare_poses(found, "body", one.bodies, other.bodies)
        if geoms is None:
            geoms, missing = _match_geoms(source, made, one, other)
            found |= dict(zip(missing, missing, strict=True))
        for first, second in geoms:
            compare(found, f"the pose of geom {first}", one.geoms[first], other.geoms[second])
    return list(found.values())


def _at_random(
    source: Compiled, made: Compiled, pairs: list[Pair], order: Array, draw: np.random.Generator
) -> tuple[Motion, Motion]:
    """How both move at one random position with random velocities."""
    here, there = source.model.qpos0.copy(), made.model.qpos0.copy()
    for pair in pairs:
        _draw(source, made, pair, here, there, draw)
    speed = speeds(draw, source.model.nv)
    theirs = np.zeros(made.model.nv)
    theirs[order] = speed
    return source.at(here, speed), made.at(there, theirs)


def matched_geoms(source: Compiled, made: Compiled, seed: int = 1) -> list[tuple[int, int]]:
    """The numbers of geoms of both models that are one, wherever these move; meshes are none of them."""
    pairs, missing = _pair(source, made)
    if missing:
        return []
    at = _at_random(source, made, pairs, _velocity_order(source, made, pairs), np.random.default_rng(seed))
    return _match_geoms(source, made, *at)[0]


def speeds(draw: np.random.Generator, count: int) -> Array:
    """Velocities of so many freedoms, from -1 to 1."""
    return draw.uniform(-1.0, 1.0, count)


def _compare_poses(found: dict[str, str], kind: str, one: Mapping[str, Array], other: Mapping[str, Array]) -> None:
    for name, pose in one.items():
        if name in other:
            compare(found, f"the pose of {kind} {name!r}", pose, other[name])
        else:
            found[name] = f"{kind} {name!r} is missing"


def compare(found: dict[str, str], what: str, one: Array, other: Array, tolerance: float = TOLERANCE) -> None:
    """Note the first difference of a kind, which is relative to the largest number, at least one."""
    size = max(1.0, float(np.max(np.abs(one), initial=0.0)))
    off = float(np.max(np.abs(one - other), initial=0.0))
    if not off <= tolerance * size:
        found.setdefault(what, f"{what} differs by {off:.2g} of {size:.2g}")


def _velocity_order(source: Compiled, made: Compiled, pairs: list[Pair]) -> Array:
    """Where each freedom of the source is in the other model."""
    order = np.zeros(source.model.nv, dtype=int)
    for pair in pairs:
        count = {FREE: 6, BALL: 3}.get(int(source.model.jnt_type[pair.source]), 1)
        start, other = int(source.model.jnt_dofadr[pair.source]), int(made.model.jnt_dofadr[pair.made])
        order[start : start + count] = range(other, other + count)
    return order


def _draw(source: Compiled, made: Compiled, pair: Pair, here: Array, there: Array, draw: np.random.Generator) -> None:
    at, other = int(source.model.jnt_qposadr[pair.source]), int(made.model.jnt_qposadr[pair.made])
    kind = int(source.model.jnt_type[pair.source])
    if kind == FREE:
        here[at : at + 3] = there[other : other + 3] = draw.uniform(-1.0, 1.0, 3)
        at, other = at + 3, other + 3
    if kind in {FREE, BALL}:
        turn = draw.normal(size=4)
        here[at : at + 4] = there[other : other + 4] = turn / np.linalg.norm(turn)
    else:
        here[at] = there[other] = draw.uniform(-math.pi, math.pi)
