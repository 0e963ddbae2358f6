"""Checks the bodies of canonical MJCF: the joints that a body may have, and the mass that what moves needs."""

import math
from collections.abc import Iterator

from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.mjcf.number_lists import numbers_of
from twinform.diagnostics import rules
from twinform.ir.solids import principal_moments
from twinform.schemas import XmlElement

_FREEDOMS = {"free": 6, "ball": 3, "hinge": 1, "slide": 1}
_MOST_FREEDOMS = 6
# mjMINVAL: what MuJoCo takes for zero
_LEAST = 1e-15
_ROUNDING = 1e-12
_LEAST_AXIS = 1e-7


def check_bodies(root: XmlElement, findings: ElementFindings) -> None:
    """Report joints that cannot be where they are, and bodies that move and have no mass or an impossible inertia."""
    mass = _MassCheck(root, findings)
    for worldbody in root.iterchildren("worldbody"):
        for joint in worldbody.iterchildren("joint", "freejoint"):
            findings.report(rules.JOINTS_OF_A_BODY, joint, "the world cannot have a joint")
        for inertial in worldbody.iterchildren("inertial"):
            message = "the world cannot have an <inertial>"
            findings.report(rules.JOINTS_OF_A_BODY, inertial, message)
        bodies = [*worldbody.iterdescendants("body")]
        for body in bodies:
            _check_joints(body, findings)
        for body in reversed(bodies):
            mass.check(body)
        for plane in _moving_planes(worldbody):
            message = "a plane can only be in a body that does not move"
            findings.report(rules.MOVING_PLANE, plane, message, "@type", found="plane", refused=True)


def _moving_planes(worldbody: XmlElement) -> Iterator[XmlElement]:
    """Yield the planes in bodies that have a joint, or are in one that has."""
    waiting = [(each, False) for each in worldbody.iterchildren("body", reversed=True)]
    while waiting:
        body, moves = waiting.pop()
        moves = moves or bool(joints_of(body))
        waiting += [(each, moves) for each in body.iterchildren("body", reversed=True)]
        yield from (each for each in body.iterchildren("geom") if moves and each.get("type") == "plane")


def joints_of(body: XmlElement) -> list[tuple[XmlElement, str]]:
    """Return the joints of a body with their types, in order."""
    return [
        (each, "free" if each.tag == "freejoint" else each.get("type", "hinge"))
        for each in body.iterchildren("joint", "freejoint")
    ]


def _check_joints(body: XmlElement, findings: ElementFindings) -> None:
    joints = joints_of(body)
    parent = body.getparent()
    is_top = parent is not None and parent.tag == "worldbody"
    if body.get("mocap") == "true" and (joints or not is_top):
        message = "a mocap body has to be a child of the world without joints"
        findings.report(rules.JOINTS_OF_A_BODY, body, message, "@mocap", found="true")
    freedoms, has_ball = 0, False
    for joint, kind in joints:
        freedoms += _FREEDOMS.get(kind, 0)
        if kind == "free" and not is_top:
            message = "a free joint can only be in a child of the world, and this body is inside of another one"
            findings.report(rules.JOINTS_OF_A_BODY, joint, message)
        elif freedoms > _MOST_FREEDOMS:
            message = f"the joints of a body have {_MOST_FREEDOMS} degrees of freedom at most, and here are {freedoms}"
            findings.report(rules.JOINTS_OF_A_BODY, joint, message)
        elif has_ball and kind in {"ball", "hinge"}:
            message = "behind a ball joint its body can have no other rotation"
            findings.report(rules.JOINTS_OF_A_BODY, joint, message)
        has_ball = has_ball or kind == "ball"
        _check_joint(joint, kind, findings)


def _check_joint(joint: XmlElement, kind: str, findings: ElementFindings) -> None:
    axis = numbers_of(joint, "axis", count=3)
    if kind in {"hinge", "slide"} and axis is not None and math.hypot(*axis) <= _LEAST_AXIS:
        findings.report(rules.ZERO_AXIS, joint, "the axis of the joint has no length", "@axis", found=joint.get("axis"))
    found = numbers_of(joint, "range", count=2)
    if kind == "ball" and joint.get("limited") == "true" and found is not None and found[0] != 0:
        message = "the range of a ball joint is 0 and the largest angle"
        findings.report(rules.INVALID_VALUE, joint, message, "@range", found=joint.get("range"))
    spring = numbers_of(joint, "springdamper", count=2)
    if spring is not None and any(spring) and min(spring) <= 0:
        message = "'springdamper' has to be a time and a ratio above 0"
        findings.report(rules.INVALID_VALUE, joint, message, "@springdamper", found=joint.get("springdamper"))


class _MassCheck:
    """Checks bodies from the leaves to the root, since what is fixed to a body moves with it and counts for it."""

    def __init__(self, root: XmlElement, findings: ElementFindings) -> None:
        compiler = root.find("compiler")
        self._findings = findings
        self._settings = {} if compiler is None else {str(key): str(value) for key, value in compiler.items()}
        self._from_geoms = self._settings.get("inertiafromgeom", "auto")
        self._balances = self._settings.get("balanceinertia") == "true"
        first, last = (0, 5)
        if compiler is not None:
            first, last = (numbers_of(compiler, "inertiagrouprange", (0.0, 5.0), count=2) or (0.0, 5.0))[:2]
        self._groups = (first, last)
        self._is_bounded = all(self._bound(name) > 0 for name in ("boundmass", "boundinertia"))
        self._weighty: set[XmlElement] = set()

    def _bound(self, name: str) -> float:
        try:
            return float(self._settings.get(name, "0"))
        except ValueError:
            return 0.0

    def check(self, body: XmlElement) -> None:
        """Check a body after all in it."""
        has_own = self._has_mass(body)
        if has_own or any(child in self._weighty and not joints_of(child) for child in body.iterchildren("body")):
            self._weighty.add(body)
        elif joints_of(body) and not self._is_bounded:
            message = "this body moves, and has no mass and inertia, nor anything fixed to it that has"
            hint = "write an <inertial>, or give it a geom with mass"
            self._findings.report(rules.MASSLESS_LINK, body, message, help=hint, refused=True)
        if self._from_geoms != "true" and (inertial := body.find("inertial")) is not None:
            self._check_inertia(inertial)

    def _has_mass(self, body: XmlElement) -> bool:
        inertial = body.find("inertial")
        if next(body.iterchildren("flexcomp", "plugin"), None) is not None:
            return True
        if inertial is not None and self._from_geoms != "true":
            return _has_inertia(inertial)
        return self._from_geoms != "false" and any(map(self._is_weighty, body.iterchildren("geom")))

    def _is_weighty(self, geom: XmlElement) -> bool:
        if not self._groups[0] <= (numbers_of(geom, "group") or (0.0,))[0] <= self._groups[1]:
            return False
        if geom.get("type") == "plane":
            return False
        mass = numbers_of(geom, "mass")
        return (mass or numbers_of(geom, "density") or (1.0,))[0] > 0

    def _check_inertia(self, inertial: XmlElement) -> None:
        full, diagonal = numbers_of(inertial, "fullinertia", count=6), numbers_of(inertial, "diaginertia", count=3)
        if full is not None:
            xx, yy, zz, xy, xz, yz = full[:6]
            is_finite = all(map(math.isfinite, full))
            moments = principal_moments((xx, yy, zz, xy, xz, yz)) if is_finite else (0.0, 0.0, 0.0)
            if min(moments) <= 0:
                message = "the matrix of 'fullinertia' is not positive definite"
                found = inertial.get("fullinertia")
                self._findings.report(
                    rules.INDEFINITE_INERTIA, inertial, message, "@fullinertia", found=found, refused=True
                )
                return
        elif diagonal is not None:
            moments = diagonal[:3]
        else:
            return
        small, middle, large = sorted(moments)
        if not self._balances and small + middle < large * (1 - _ROUNDING):
            message = f"one of the moments of inertia, {large:g}, is larger than the two others together"
            hint = "the compiler of MuJoCo takes such numbers with balanceinertia='true', and changes them"
            self._findings.report(rules.IMPOSSIBLE_INERTIA, inertial, message, help=hint, refused=True)


def _has_inertia(inertial: XmlElement) -> bool:
    mass = numbers_of(inertial, "mass", (0.0,), count=1) or (0.0,)
    moments = numbers_of(inertial, "diaginertia", (0.0,), count=3) or (0.0,)
    has_moments = "fullinertia" in inertial.attrib or min(moments) >= _LEAST
    return mass[0] >= _LEAST and has_moments


def all_joints(root: XmlElement) -> Iterator[tuple[XmlElement, str]]:
    """Yield all joints of the model with their types."""
    for worldbody in root.iterchildren("worldbody"):
        for body in worldbody.iterdescendants("body"):
            yield from joints_of(body)
