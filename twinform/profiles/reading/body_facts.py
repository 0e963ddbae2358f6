"""Facts about masses and inertias, as the engines want them that build a robot of them."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir.principal_moments import principal_moments
from twinform.profiles.reading.forms import number_in
from twinform.profiles.reading.nodes import RawNode

Fact = Iterator[tuple[RawNode, str]]
# mjMINVAL, at or below which MuJoCo counts a mass (kg) or a moment (kg m2) as none.
_LIGHTEST = 1e-15
# In kg m2: MuJoCo counts smaller principal moments as none.
_SMALLEST = 1e-14
# Drake accepts a largest moment that exceeds the sum of the others by this part of it.
_SLACK = 1e-9
# What finding the axes of an inertia costs, relative to its largest moment.
_ROUNDING = 1e-14
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


class RawBody(NamedTuple):
    """The mass and the moments of a link, and the principal ones; None where they are no numbers."""

    node: RawNode
    mass: float | None
    moments: tuple[float, ...]
    principal: tuple[float, ...] | None

    @property
    def is_empty(self) -> bool:
        """Whether all moments are 0."""
        return not any(self.moments)

    @property
    def excess(self) -> float | None:
        """By how much the largest moment exceeds the sum of the others; None where it is none, or the world's."""
        if self.principal is None or self.principal[0] <= 0 or _name(self.node) == "world":
            return None
        low, middle, high = self.principal
        return high - (low + middle)

    @property
    def lost(self) -> float:
        """What rounding does to a moment where the axes have to be found, in kg m2."""
        _, xy, xz, _, yz, _ = self.moments
        return _ROUNDING * self.principal[2] if self.principal is not None and (xy or xz or yz) else 0.0


def bodies(root: RawNode) -> Iterator[RawBody]:
    """The links with an inertial."""
    for link in root.all("link"):
        inertial = link.first("inertial")
        if inertial is None:
            continue
        inertia = inertial.first("inertia")
        texts = [inertia.attributes.get(name, "0") if inertia else "0" for name in _MOMENTS]
        found = [number_in(text) for text in texts]
        mass = number_in(inertial.value("mass", "value") or "0")
        moments = tuple(0.0 if number is None else number for number in found)
        yield RawBody(link, mass, moments, _principal(moments))


def _principal(moments: tuple[float, ...]) -> tuple[float, ...] | None:
    if not all(map(math.isfinite, moments)):
        return None
    xx, xy, xz, yy, yz, zz = moments
    return tuple(sorted(principal_moments((xx, yy, zz, xy, xz, yz))))


def indefinite(root: RawNode) -> Fact:
    """Inertias with a moment that is not positive, where there is one at all."""
    for body in bodies(root):
        if not body.is_empty and body.principal is not None and body.principal[0] < _SMALLEST:
            yield body.node, f"link {_name(body.node)!r} has a moment that is not positive, or next to nothing"


def unbalanced(root: RawNode) -> Fact:
    """Inertias of which the largest moment is more than the other two together; the world has none."""
    for body in bodies(root):
        if (excess := body.excess) is not None and excess > body.lost:
            yield body.node, f"link {_name(body.node)!r} has a moment above the sum of the other two"


def uncertain(root: RawNode) -> Fact:
    """Inertias of which the largest moment is the sum of the other two, but for what rounding does with it."""
    for body in bodies(root):
        if (excess := body.excess) is not None and -body.lost < excess <= body.lost:
            yield body.node, f"link {_name(body.node)!r} has a moment next to the sum of the other two"


def unphysical(root: RawNode) -> Fact:
    """Inertias that no body has: with a moment above the sum of the others, a negative one, or without a mass."""
    for body in bodies(root):
        principal, mass = body.principal, body.mass or 0.0
        wrong = principal is None or principal[0] < -_SLACK * abs(principal[2]) or _is_unbalanced(principal)
        if wrong or mass < 0 or (mass == 0 and not body.is_empty):
            yield body.node, f"the inertia of link {_name(body.node)!r} is physically impossible"


def _is_unbalanced(principal: tuple[float, ...]) -> bool:
    low, middle, high = principal
    return low + middle < high * (1 - _SLACK)


def weightless(root: RawNode) -> Fact:
    """Links that move, with nothing that has a mass and an inertia in what is fixed to them."""
    heavy = {_name(body.node) for body in bodies(root) if _weighs(body)}
    # Without <inertial>, MuJoCo computes the mass from the collision shapes.
    heavy |= {_name(link) for link in root.all("link") if not link.first("inertial") and link.first("collision")}
    fixed: dict[str, list[str]] = {}
    for joint in root.all("joint"):
        if joint.attributes.get("type") == "fixed":
            fixed.setdefault(joint.value("parent", "link") or "", []).append(joint.value("child", "link") or "")
    links = {_name(link): link for link in root.all("link")}
    for joint in root.all("joint"):
        child = joint.value("child", "link") or ""
        if joint.attributes.get("type") != "fixed" and child in links and not heavy & _together(child, fixed):
            yield links[child], f"link {child!r} moves and has no mass or no inertia, nor has what is fixed to it"


def _weighs(body: RawBody) -> bool:
    mass = body.mass or 0.0
    return mass > _LIGHTEST and body.principal is not None and body.principal[2] > _LIGHTEST


def _together(name: str, fixed: dict[str, list[str]]) -> set[str]:
    found, waiting = set[str](), [name]
    while waiting:
        one = waiting.pop()
        if one not in found:
            found.add(one)
            waiting += fixed.get(one, ())
    return found


def _name(node: RawNode) -> str:
    return node.attributes.get("name", "")
