"""Facts about masses and inertias after lumping: libsdformat adds links on fixed joints to those that carry them."""

import math
import re
from functools import lru_cache

from twinform.dataclass import dataclass
from twinform.ir import Pose
from twinform.ir.solids import ORIGIN, Solid, Symmetric, combined, placed
from twinform.ir.transform import Transform
from twinform.lazy import lazy_pattern
from twinform.passes.inertia.physical_consistency import clearances, is_doubtful, rounding_loss
from twinform.profiles.forms import FORMS
from twinform.profiles.nodes import Fact, FactTable, RawNode
from twinform.profiles.sdformat_facts import foreign_ends, is_static, preserved_joints

_NUMBER = lazy_pattern(
    r"[-+]?(?:0[xX][0-9a-fA-F]+|(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?|inf)", re.IGNORECASE | re.ASCII
)
_ELEMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_NOTHING: Symmetric = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_STREAM, _STREAMS = FORMS["stream"][1], FORMS["stream3"][1]
_ROUNDING = 1e-12
"""How much of the greatest moment may be missing because a file has few digits."""
# In kg: libsdformat before 12.7.2 drops links that do not weigh more, with all links below them.
_DROPPED = 1e-6
_BodyStart = tuple[int | None, RawNode | None, str]
"""Where a body begins: the index of the body above, the joint to it, and the name of its first link."""


@dataclass(frozen=True, slots=True, eq=False)
class _Body:
    """A link with all links that fixed joints hang on it, and the joint that moves it; a root has no parent."""

    parent: "_Body | None"
    joint: RawNode | None
    links: tuple[RawNode, ...]
    places: tuple[Transform, ...]
    above: tuple[int, ...]
    """For each link the index of the link that it is fixed to."""

    @property
    def link(self) -> RawNode:
        return self.links[0]

    @property
    def name(self) -> str:
        return self.link.name

    @property
    def is_dropped(self) -> bool:
        return abs(self.solid().mass) <= _DROPPED

    def solid(self) -> Solid:
        """All links as one solid, in the frame of the first link."""
        return combined([placed(_link_solid(link), at) for link, at in zip(self.links, self.places, strict=True)])

    def is_placeless(self) -> bool:
        """Whether links without mass are combined while the body is lumped."""
        masses = [_link_solid(link).mass for link in self.links]
        written = [link.first("inertial") is not None for link in self.links]
        wrong = [False] * len(masses)
        for number in range(len(masses) - 1, 0, -1):
            if written[number]:
                parent = self.above[number]
                # libsdformat lumps from the leaves to the root: the center of two masses that are
                # both zero is a division by zero.
                masses[parent] += masses[number]
                written[parent] = True
                wrong[parent] |= wrong[number] or masses[parent] == 0
        return wrong[0]


def _read_number(text: str) -> float:
    return float.fromhex(text) if "x" in text.lower() else float(text)


def _read_numbers(text: str | None, count: int) -> tuple[float, ...]:
    found = [_read_number(text) for text in _NUMBER.findall(text or "")]
    return tuple(found) if len(found) == count else (0.0,) * count


def _finite_or_zeros(numbers: tuple[float, ...]) -> tuple[float, ...]:
    """The numbers of a place, or zeros if one is infinite: such a file is refused before it is lumped."""
    return numbers if all(map(math.isfinite, numbers)) else (0.0,) * len(numbers)


def _read_place(node: RawNode | None) -> Transform:
    origin = node.first("origin") if node is not None else None
    if origin is None:
        return Transform.from_pose(None)
    x, y, z = _finite_or_zeros(_read_numbers(origin.attributes.get("xyz"), 3))
    roll, pitch, yaw = _finite_or_zeros(_read_numbers(origin.attributes.get("rpy"), 3))
    return Transform.from_pose(Pose(xyz=(x, y, z), rpy=(roll, pitch, yaw)))


def _link_solid(link: RawNode) -> Solid:
    """The solid of a link as urdfdom reads it, which gives an inertial up at the first mistake."""
    inertial = link.first("inertial")
    mass = inertial.value("mass", "value") if inertial is not None else None
    if (
        "name" not in link.attributes
        or inertial is None
        or mass is None
        or not _STREAM(mass)
        or not _is_place(inertial.first("origin"))
    ):
        return Solid(0.0, ORIGIN, _NOTHING)
    return placed(Solid(float(mass), ORIGIN, _read_inertia(inertial.first("inertia"))), _read_place(inertial))


def _read_inertia(inertia: RawNode | None) -> Symmetric:
    texts = [inertia.attributes.get(name, "") for name in _ELEMENTS] if inertia is not None else []
    if not texts or not all(map(_STREAM, texts)):
        return _NOTHING
    xx, yy, zz, xy, xz, yz = map(float, texts)
    return xx, yy, zz, xy, xz, yz


def _is_place(origin: RawNode | None) -> bool:
    return origin is None or all(
        _STREAMS(origin.attributes[name]) for name in ("xyz", "rpy") if name in origin.attributes
    )


def _is_finite(one: Solid) -> bool:
    return all(map(math.isfinite, (one.mass, *one.center, *one.inertia)))


@lru_cache(maxsize=4)
def _bodies(root: RawNode) -> tuple[_Body, ...]:
    """The bodies of a robot from the roots to the leaves, without links in a circle."""
    links = {link.name: link for link in reversed(list(root.all("link")))}
    below: dict[str, list[RawNode]] = {}
    children, staying = set[str](), preserved_joints(root)
    # urdfdom (`ModelInterface::initTree`) walks a `std::map` of joints and overwrites the parent of a
    # link: of two joints to one child, the last by name counts.
    for joint in sorted(root.all("joint"), key=lambda joint: joint.name, reverse=True):
        parent, child = joint.value("parent", "link") or "", joint.value("child", "link") or ""
        if parent in links and child in links and child not in children and parent != child:
            below.setdefault(parent, []).append(joint)
            children.add(child)
    heads: list[_BodyStart] = [(None, None, name) for name in links if name not in children]
    found = list[_Body]()
    for parent, joint, name in heads:  # grows while it is walked
        names, places, above = [name], [Transform.from_pose(None)], [0]
        body = len(found)
        for index, inside in enumerate(names):  # grows, too
            for each in below.get(inside, ()):
                child = each.value("child", "link") or ""
                if _is_lumped(each, staying) and inside != "world":
                    names.append(child)
                    above.append(index)
                    places.append(places[index].compose(_read_place(each)))
                else:
                    heads.append((body, each, child))
        at = None if parent is None else found[parent]
        found.append(_Body(at, joint, tuple(links[each] for each in names), tuple(places), tuple(above)))
    return tuple(found)


def _is_lumped(joint: RawNode, staying: frozenset[str]) -> bool:
    return joint.type == "fixed" and joint.name not in staying


@lru_cache(maxsize=4)
def _kept_bodies(root: RawNode) -> tuple[_Body, ...]:
    """The bodies that libsdformat keeps, except the world."""
    # Links are lumped first: what is dropped for its mass is a whole body with everything that
    # fixed joints hold.
    found = dict.fromkeys(body for body in _bodies(root) if body.name == "world" or not body.is_dropped)
    for body in _bodies(root):
        if body.parent is not None and body.parent not in found:
            found.pop(body, None)
    return tuple(body for body in found if body.name != "world")


def _is_physical(inertia: Symmetric) -> bool:
    return min(clearances(inertia)) >= -max(_ROUNDING, rounding_loss(inertia))


def _impossible_lumps(root: RawNode) -> Fact:
    """Bodies with an impossible inertia after lumping."""
    for body in _kept_bodies(root):
        one = body.solid()
        if one.mass < 0:
            yield body.link, f"link {body.name!r} has the mass {one.mass:g} kg with what is fixed to it"
        elif _is_finite(one) and not _is_physical(one.inertia):
            yield body.link, f"the inertia of link {body.name!r} with what is fixed to it is physically impossible"


def _uncertain_lumps(root: RawNode) -> Fact:
    """Bodies whose lumped inertia one reader finds possible and another one does not."""
    for body in _kept_bodies(root):
        if _is_finite(body.solid()) and is_doubtful(body.solid().inertia):
            yield body.link, f"whether a body has the inertia of link {body.name!r} is a matter of rounding"


def _placeless_lumps(root: RawNode) -> Fact:
    """Bodies in which parts without mass are combined: libsdformat divides their center by the mass."""
    for body in _kept_bodies(root):
        if body.is_placeless():
            yield body.link, f"links without mass are fixed to each other in what is fixed to link {body.name!r}"


def _weightless_branches(root: RawNode) -> Fact:
    for body in _bodies(root):
        if body.name != "world" and body.is_dropped:
            yield body.link, f"link {body.name!r} weighs no more than {_DROPPED:g} kg with what is fixed to it"


def _nothing_left(root: RawNode) -> Fact:
    """Models without a link: all links are dropped, or there is only the world."""
    bodies = _bodies(root)
    if bodies and not _kept_bodies(root) and not is_static(root):
        yield bodies[0].link, f"below link {bodies[0].name!r} no link is left, without the world and what has no mass"


def _foreign_ends(root: RawNode) -> Fact:
    return foreign_ends(root, frozenset(body.name for body in _kept_bodies(root)))


FACTS: FactTable = {
    "impossible-lumped-inertia": _impossible_lumps,
    "uncertain-lumped-inertia": _uncertain_lumps,
    "placeless-lump": _placeless_lumps,
    "weightless-branch": _weightless_branches,
    "nothing-left": _nothing_left,
    "foreign-end": _foreign_ends,
}
