"""Facts about the masses of a robot whose links are put into those that they are fixed to, as libsdformat does."""

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache

from twinform.ir import Pose
from twinform.ir.principal_moments import Symmetric, principal_moments
from twinform.ir.solids import ORIGIN, Solid, combined, placed
from twinform.ir.transform import Transform
from twinform.profiles.reading.forms import FORMS
from twinform.profiles.reading.nodes import Node

Fact = Iterator[tuple[Node, str]]
"""Elements that it is about, and what is so."""

_NUMBER = re.compile(r"[-+]?(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|inf)", re.IGNORECASE | re.ASCII)
_ELEMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_NOTHING: Symmetric = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_STREAM, _STREAMS = FORMS["stream"][1], FORMS["stream3"][1]
_ROUNDING = 1e-12
"""How much of the greatest moment the digits of a file may lack."""
_DROPPED = 1e-6
"""In kg: libsdformat before 12.7.2 leaves out links that do not weigh more."""


@dataclass(frozen=True, slots=True)
class _Body:
    """A link with what fixed joints hang on it, and the joint that moves it; none above a root."""

    joint: Node | None
    links: tuple[Node, ...]
    places: tuple[Transform, ...]

    @property
    def link(self) -> Node:
        return self.links[0]

    @property
    def name(self) -> str:
        return self.link.attributes.get("name", "")

    def solid(self) -> Solid:
        """All of it as one, in the frame of its first link."""
        return combined([placed(_solid(link), at) for link, at in zip(self.links, self.places, strict=True)])


def _number(text: str) -> float:
    return float.fromhex(text) if "x" in text.lower() else float(text)


def _numbers(text: str | None, count: int) -> tuple[float, ...]:
    found = [_number(text) for text in _NUMBER.findall(text or "")]
    return tuple(found) if len(found) == count else (0.0,) * count


def _finite(numbers: tuple[float, ...]) -> tuple[float, ...]:
    """Those of a place; with an infinite one the file is refused before anything is put together."""
    return numbers if all(map(math.isfinite, numbers)) else (0.0,) * len(numbers)


def _place(node: Node | None) -> Transform:
    origin = node.first("origin") if node is not None else None
    if origin is None:
        return Transform.from_pose(None)
    x, y, z = _finite(_numbers(origin.attributes.get("xyz"), 3))
    roll, pitch, yaw = _finite(_numbers(origin.attributes.get("rpy"), 3))
    return Transform.from_pose(Pose(xyz=(x, y, z), rpy=(roll, pitch, yaw)))


def _solid(link: Node) -> Solid:
    """What urdfdom, which reads it first, has of an inertial when it gives it up: it begins with the origin."""
    inertial = link.first("inertial")
    mass = inertial.value("mass", "value") if inertial is not None else None
    if inertial is None or mass is None or not _STREAM(mass) or not _is_place(inertial.first("origin")):
        return Solid(0.0, ORIGIN, _NOTHING)
    return placed(Solid(float(mass), ORIGIN, _inertia(inertial.first("inertia"))), _place(inertial))


def _inertia(inertia: Node | None) -> Symmetric:
    texts = [inertia.attributes.get(name, "") for name in _ELEMENTS] if inertia is not None else []
    if not texts or not all(map(_STREAM, texts)):
        return _NOTHING
    xx, yy, zz, xy, xz, yz = map(float, texts)
    return xx, yy, zz, xy, xz, yz


def _is_place(origin: Node | None) -> bool:
    return origin is None or all(
        _STREAMS(origin.attributes[name]) for name in ("xyz", "rpy") if name in origin.attributes
    )


def _is_finite(one: Solid) -> bool:
    return all(map(math.isfinite, (one.mass, *one.center, *one.inertia)))


@lru_cache(maxsize=4)
def _bodies(root: Node) -> tuple[_Body, ...]:
    """The bodies from the roots to the leaves, without what is in a circle."""
    links = {link.attributes.get("name", ""): link for link in reversed(list(root.all("link")))}
    below: dict[str, list[Node]] = {}
    children = set[str]()
    for joint in root.all("joint"):
        parent, child = joint.value("parent", "link") or "", joint.value("child", "link") or ""
        if parent in links and child in links and child not in children and parent != child:
            below.setdefault(parent, []).append(joint)
            children.add(child)
    heads: list[tuple[Node | None, str]] = [(None, name) for name in links if name not in children]
    found = list[_Body]()
    for joint, name in heads:  # grows while it is walked
        names, places = [name], [Transform.from_pose(None)]
        for index, inside in enumerate(names):  # grows, too
            for each in below.get(inside, ()):
                child = each.value("child", "link") or ""
                if each.attributes.get("type") == "fixed" and inside != "world":
                    names.append(child)
                    places.append(places[index].compose(_place(each)))
                else:
                    heads.append((each, child))
        found.append(_Body(joint, tuple(links[each] for each in names), tuple(places)))
    return tuple(found)


def _is_possible(inertia: Symmetric) -> bool:
    least, middle, greatest = sorted(principal_moments(inertia))
    slack = _ROUNDING * abs(greatest)
    return least >= -slack and least + middle >= greatest - slack


def _impossible_when_lumped(root: Node) -> Fact:
    """Bodies with an impossible inertia after what is fixed to them became a part of them."""
    for body in _bodies(root):
        one = body.solid()
        if body.name != "world" and _is_finite(one) and one.mass > _DROPPED and not _is_possible(one.inertia):
            yield body.link, f"no body has the inertia of link {body.name!r} with what is fixed to it"
        elif one.mass < 0:
            yield body.link, f"link {body.name!r} has the mass {one.mass:g} kg with what is fixed to it"


def _dropped(wanted: Callable[[_Body], bool]) -> Callable[[Node], Fact]:
    def fact(root: Node) -> Fact:
        for body in _bodies(root):
            if body.name != "world" and wanted(body) and 0 <= body.solid().mass <= _DROPPED:
                yield body.link, f"link {body.name!r} weighs no more than {_DROPPED:g} kg with what is fixed to it"

    return fact


FACTS: Mapping[str, Callable[[Node], Fact]] = {
    "impossible-lumped-inertia": _impossible_when_lumped,
    "weightless-branch": _dropped(lambda body: body.joint is not None),
    "weightless-root": _dropped(lambda body: body.joint is None),
}
"""Facts by their names in tables."""
