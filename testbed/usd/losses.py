"""Losses planted in the stage of a robot: each takes away or changes one thing that a converter could have lost."""

import importlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from twinform.compiler.compare import Comparison

Prim = Any
_LEAST, _MOST = 1e-6, 1e9
Change = Callable[[Prim, Random], bool]
"""Changes a prim, and says whether it could be changed in this way."""


@dataclass(frozen=True, slots=True)
class Loss:
    """A planted loss: its kind, the names of the parts that it is about, and the stage with it as a text."""

    kind: str
    names: frozenset[str]
    text: str

    def found_by(self, found: Comparison, before: Comparison) -> bool:
        """Whether a comparison has something about one of these parts that it did not have before."""
        known = {(each.severity, each.name, each.aspect, each.b.text) for each in before.counted}
        new = (each for each in found.counted if (each.severity, each.name, each.aspect, each.b.text) not in known)
        return any(each.name in self.names for each in new)


def flat(stage: Path) -> str:
    """The text of a stage with all that its layers compose, in one layer."""
    return _usd("Usd").Stage.Open(str(stage)).Flatten().ExportToString()


def losses(text: str, seed: str) -> Iterator[Loss]:
    """Yield a loss of each kind that a stage can have, in an order and at places that are drawn."""
    for kind in Random(seed).sample(list(KINDS), len(KINDS)):
        found = _plant(text, kind, Random(f"{seed}/{kind}"))
        if found is not None:
            yield found


def _plant(text: str, kind: str, chance: Random) -> Loss | None:
    layer = _usd("Sdf").Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    stage = _usd("Usd").Stage.Open(layer)
    prims = list(stage.Traverse())
    chance.shuffle(prims)
    for prim in prims:
        names = frozenset(_names(prim))
        if KINDS[kind](prim, chance):
            return Loss(kind, names, layer.ExportToString())
    return None


def _names(prim: Prim) -> Iterator[str]:
    """The names of a part, of the link that it is in, and of the one that it moves."""
    yield _name(prim)
    body = prim
    while body and not body.HasAPI(_usd("UsdPhysics").RigidBodyAPI):
        body = body.GetParent()
    if body:
        yield _name(body)
    for target in prim.GetRelationship("physics:body1").GetTargets():
        yield _name(prim.GetStage().GetPrimAtPath(target))


def _name(prim: Prim) -> str:
    return str(prim.GetDisplayName() or prim.GetName())


def _number(name: str, change: Callable[[float], float], *, signed: bool = False) -> Change:
    """Change a number that says something; `signed` ones do so below zero, too."""

    def apply(prim: Prim, _: Random) -> bool:
        attribute = prim.GetAttribute(name)
        return _says_something(attribute.Get(), signed=signed) and bool(attribute.Set(change(attribute.Get())))

    return apply


def _without(name: str, *, signed: bool = False) -> Change:
    """Remove a number that says something."""

    def apply(prim: Prim, _: Random) -> bool:
        return _says_something(prim.GetAttribute(name).Get(), signed=signed) and bool(prim.RemoveProperty(name))

    return apply


def _says_something(value: float | None, *, signed: bool) -> bool:
    """Whether a number is more than nothing, and less than stands for no limit in SDF."""
    return value is not None and _LEAST < (abs(value) if signed else value) < _MOST


def _moved(name: str, by: float) -> Change:
    """Move a point in a direction that is drawn."""

    def apply(prim: Prim, chance: Random) -> bool:
        point = prim.GetAttribute(name).Get()
        if point is None or not prim.GetAttribute(name).HasAuthoredValue() or prim.GetName() == "root_joint":
            return False
        point[chance.randrange(3)] += by
        return bool(prim.GetAttribute(name).Set(point))

    return apply


def _turned(name: str) -> Change:
    """Turn a rotation by two degrees about an axis that is drawn."""

    def apply(prim: Prim, chance: Random) -> bool:
        rotation = prim.GetAttribute(name).Get()
        if rotation is None or prim.GetName() == "root_joint":
            return False
        gf = _usd("Gf")
        axis = gf.Vec3d(*(chance.uniform(-1, 1) for _ in range(3)))
        return bool(prim.GetAttribute(name).Set(rotation * gf.Quatf(gf.Rotation(axis, 2.0).GetQuat())))

    return apply


def _turn_inertia(prim: Prim, _: Random) -> bool:
    """Exchange two of the principal moments, where they are different."""
    moments = prim.GetAttribute("physics:diagonalInertia").Get()
    if moments is None or max(moments) - min(moments) <= 0.1 * max(moments):
        return False
    first, last = (list(moments).index(pick(moments)) for pick in (min, max))
    moments[first], moments[last] = moments[last], moments[first]
    return bool(prim.GetAttribute("physics:diagonalInertia").Set(moments))


def _scale_inertia(prim: Prim, _: Random) -> bool:
    moments = prim.GetAttribute("physics:diagonalInertia").Get()
    return bool(moments) and max(moments) > 0 and bool(prim.GetAttribute("physics:diagonalInertia").Set(moments * 1.02))


def _axis(prim: Prim, _: Random) -> bool:
    axis = prim.GetAttribute("physics:axis").Get()
    return bool(axis) and bool(prim.GetAttribute("physics:axis").Set("YZX"["XYZ".index(axis)]))


def _slide(prim: Prim, _: Random) -> bool:
    return prim.GetTypeName() == "PhysicsRevoluteJoint" and bool(prim.SetTypeName("PhysicsPrismaticJoint"))


def _no_joint(prim: Prim, _: Random) -> bool:
    movable = prim.GetTypeName() in {"PhysicsRevoluteJoint", "PhysicsPrismaticJoint", "PhysicsFixedJoint"}
    return movable and prim.GetName() != "root_joint" and bool(prim.SetActive(False))


def _another_parent(prim: Prim, chance: Random) -> bool:
    parent = prim.GetRelationship("physics:body0").GetTargets()
    bodies = [each for each in prim.GetStage().Traverse() if each.HasAPI(_usd("UsdPhysics").RigidBodyAPI)]
    own = [*parent, *prim.GetRelationship("physics:body1").GetTargets()]
    others = [each.GetPath() for each in bodies if each.GetPath() not in own]
    if not parent or not others or prim.GetName() == "root_joint":
        return False
    return bool(prim.GetRelationship("physics:body0").SetTargets([chance.choice(others)]))


def _no_mimic(prim: Prim, _: Random) -> bool:
    return bool(prim.GetRelationship("newton:mimicJoint").GetTargets()) and bool(
        prim.RemoveProperty("newton:mimicJoint")
    )


def _collision(change: Callable[[Prim], bool]) -> Change:
    def apply(prim: Prim, _: Random) -> bool:
        return bool(prim.HasAPI(_usd("UsdPhysics").CollisionAPI)) and change(prim)

    return apply


def _no_collider(prim: Prim) -> bool:
    return bool(prim.RemoveAPI(_usd("UsdPhysics").CollisionAPI))


def _gone(prim: Prim) -> bool:
    return bool(prim.SetActive(False))


def _disabled(prim: Prim) -> bool:
    return bool(prim.CreateAttribute("physics:collisionEnabled", _usd("Sdf").ValueTypeNames.Bool).Set(False))


def _larger(prim: Prim) -> bool:
    attribute = prim.GetAttribute("size" if prim.GetTypeName() == "Cube" else "radius")
    return bool(attribute) and attribute.Get() > 0 and bool(attribute.Set(attribute.Get() * 1.05))


def _ball(prim: Prim) -> bool:
    return prim.GetTypeName() != "Sphere" and bool(prim.SetTypeName("Sphere"))


def _shifted(prim: Prim) -> bool:
    attribute = prim.GetAttribute("xformOp:translate")
    return bool(attribute) and bool(attribute.Set(attribute.Get() + _usd("Gf").Vec3d(0.002, 0, 0)))


def _no_body(prim: Prim, _: Random) -> bool:
    physics = _usd("UsdPhysics")
    is_body = prim.HasAPI(physics.RigidBodyAPI) and not prim.HasAPI(physics.ArticulationRootAPI)
    return bool(is_body) and bool(prim.RemoveAPI(physics.RigidBodyAPI))


def _usd(name: str) -> Any:
    return importlib.import_module(f"pxr.{name}")


KINDS: Mapping[str, Change] = {
    "damping removed": _without("newton:damping"),
    "damping changed": _number("newton:damping", lambda value: value * 1.05),
    "friction removed": _without("newton:friction"),
    "friction changed": _number("newton:friction", lambda value: value * 1.05),
    "speed limit removed": _without("newton:velocityLimit"),
    "speed limit changed": _number("newton:velocityLimit", lambda value: value * 1.05),
    "effort removed": _without("urdf:limit:effort"),
    "lower limit changed": _number("physics:lowerLimit", lambda value: value * 1.01, signed=True),
    "upper limit changed": _number("physics:upperLimit", lambda value: value * 1.01, signed=True),
    "lower limit removed": _without("physics:lowerLimit", signed=True),
    "upper limit removed": _without("physics:upperLimit", signed=True),
    "mass scaled": _number("physics:mass", lambda value: value * 1.01),
    "mass removed": _without("physics:mass"),
    "inertia scaled": _scale_inertia,
    "inertia turned": _turn_inertia,
    "center of mass moved": _moved("physics:centerOfMass", 0.001),
    "joint moved": _moved("physics:localPos0", 0.001),
    "joint moved on its child": _moved("physics:localPos1", 0.001),
    "joint turned": _turned("physics:localRot0"),
    "axis changed": _axis,
    "revolute made prismatic": _slide,
    "joint removed": _no_joint,
    "joint on another link": _another_parent,
    "mimic removed": _no_mimic,
    "multiplier of a mimic changed": _number("newton:mimicCoef1", lambda value: value * 1.05, signed=True),
    "offset of a mimic changed": _number("newton:mimicCoef0", lambda value: value + 1, signed=True),
    "no collider any more": _collision(_no_collider),
    "collision removed": _collision(_gone),
    "collision disabled": _collision(_disabled),
    "collision enlarged": _collision(_larger),
    "collision made a ball": _collision(_ball),
    "collision moved": _collision(_shifted),
    "link no body any more": _no_body,
}
"""What is planted, by what it is called."""
