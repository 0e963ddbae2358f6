"""Checks of statics: joints that cannot hold against gravity what they carry."""

import math
from collections.abc import Iterator, Mapping, Sequence

from twinform.compiler.mistakes.placed_tree import PlacedTree, mass_of
from twinform.compiler.mistakes.scale_checks import is_made_up
from twinform.compiler.mistakes.tipping_check import report_tipping
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Joint, Model, Vector3
from twinform.ir.defaults import GRAVITY
from twinform.ir.motion import turn
from twinform.ir.transform import Transform, cross, dot, minus

_MOST_LINKS = 200
_MARGIN = 1.5
"""How much more than the effort a joint has to need: figures of masses and efforts are rounded."""
_STEP = 0.05
"""A height that counts as one, m."""
_UPRIGHT = 0.99
"""The vertical part of a unit vector from which on gravity does not turn about it."""
_QUARTER = math.pi / 2
_UP: Vector3 = (0.0, 0.0, 1.0)


def report_statics(document: Document, sink: DiagnosticSink) -> None:
    """Report joints of URDF that are too weak, and robots that tip over."""
    for model in document.models if document.format is Format.URDF else ():
        if len(model.links) <= _MOST_LINKS and model.joints:
            tree = PlacedTree.of(model)
            if any(map(_effort, model.joints)):
                _report_weak_joints(model, tree, sink)
            report_tipping(model, tree, sink)


def _effort(joint: Joint) -> float | None:
    """Return the effort of a revolute joint; None where there is none that is meant as a figure."""
    limit = joint.axis.limit if joint.axis else None
    if joint.type != "revolute" or limit is None or not limit.effort or not 0 < limit.effort < math.inf:
        return None
    return None if is_made_up(limit) or (joint.axis and joint.axis.mimic) else limit.effort


def _report_weak_joints(model: Model, tree: PlacedTree, sink: DiagnosticSink) -> None:
    """Report revolute joints whose effort cannot hold in some position what hangs from them.

    The robot stands upright. The joints before the one in question are at zero, and those behind it within limits.
    """
    most = _moments(tree)
    for joint in model.joints:
        effort, moment = _effort(joint), most.get(joint.child or "", 0.0)
        if effort is None or GRAVITY * moment <= effort * _MARGIN or abs(tree.axis(joint)[2]) > _UPRIGHT:
            continue
        if _stands(tree, joint):
            continue
        branch = _Branch(tree, joint)
        needed = branch.needed()
        if needed > effort * _MARGIN:
            _report(joint, effort, needed, sum(branch.masses), sink)


def _stands(tree: PlacedTree, joint: Joint) -> bool:
    """Whether what hangs from a joint is as low as anything: a leg, which stands on the ground and carries the rest."""
    heights = {name: frame.translation[2] for name, frame in tree.frames.items()}  # of the root, 0
    lowest = min(heights[name] for name in tree.order_below(joint.child or ""))
    return lowest < -_STEP and lowest <= min(heights.values()) + _STEP


def _report(joint: Joint, effort: float, needed: float, mass: float, sink: DiagnosticSink) -> None:
    limit = joint.axis.limit if joint.axis else None
    message = (
        f"joint {joint.name!r} holds {effort:g} N m, and gravity needs up to {needed:.3g} N m of it: "
        f"it carries {mass:.3g} kg, {needed / GRAVITY / mass:.2g} m away"
    )
    help = "write the effort of the actuator with its gears, or correct the masses that it carries"
    where = (limit or joint).location.at("@effort")
    sink.report(rules.WEAK_JOINT, message, where, found=f"{effort:g}", expected=f"at least {needed:.3g}", help=help)


def _moments(tree: PlacedTree) -> Mapping[str, float]:
    """Return for each link the most that the mass below it can have as its moment about the joint above, kg m."""
    masses, moments = dict[str, float](), dict[str, float]()
    for name in reversed(list(tree.frames)):
        mass, center = mass_of(tree.links[name])
        moment = mass * math.hypot(*center)
        for joint in tree.below.get(name, ()):
            far = math.hypot(*Transform.from_pose(joint.pose).translation) + _reach(joint)
            carried = masses.get(joint.child or "", 0.0)
            moment += moments.get(joint.child or "", 0.0) + carried * far
            mass += carried
        masses[name], moments[name] = mass, moment
    return moments


def _range(joint: Joint) -> tuple[float, float]:
    """Return the limits of a joint, infinite where it turns without end."""
    limit = joint.axis.limit if joint.axis else None
    if limit is None or joint.type == "continuous":
        return -math.inf, math.inf
    return limit.lower or 0.0, limit.upper or 0.0


def _reach(joint: Joint) -> float:
    """Return how far a slider moves what it carries."""
    return max(map(abs, _range(joint))) if joint.type == "prismatic" else 0.0


class _Branch:
    """What hangs from a joint, which is turned so that gravity pulls as much as it can."""

    def __init__(self, tree: PlacedTree, joint: Joint) -> None:
        order = tree.order_below(joint.child or "")
        points = list(tree.mass_points(order))
        self.masses, self.centers = [mass for mass, _ in points], [center for _, center in points]
        self.axis, self.center = tree.axis(joint), tree.frames[order[0]].translation
        self.limits = _range(joint)
        first = {name: number for number, name in enumerate(order)}
        self.turning = [
            (each, tree.axis(each), tree.frames[each.child or ""].translation, first[each.child or ""])
            for name in order
            for each in tree.below.get(name, ())
            if each.type in {"revolute", "continuous"}
        ]
        self.sizes = [len(tree.order_below(name)) for name in order] if len(order) < _MOST_LINKS // 4 else None

    def needed(self) -> float:
        """Return the greatest torque of gravity about the joint that was found, N m."""
        best = self._torque()
        # The joints at the tips come first, since their axes turn with the joints that carry them.
        for joint, axis, point, first in reversed(self.turning if self.sizes else ()):
            last = first + (self.sizes or [])[first]
            chosen = at_zero = self.centers[first:last]
            for position in _positions(joint):
                motion = turn(axis, position, point)
                self.centers[first:last] = [motion.apply(each) for each in at_zero]
                found = self._torque()
                if found > best:
                    best, chosen = found, self.centers[first:last]
            self.centers[first:last] = chosen
        return best

    def _torque(self) -> float:
        """Return the greatest torque of gravity while the joint turns from one limit to the other, N m."""
        moment = [0.0, 0.0, 0.0]
        for mass, point in zip(self.masses, self.centers, strict=True):
            for n, part in enumerate(minus(point, self.center)):
                moment[n] += mass * part
        across = cross(self.axis, (moment[0], moment[1], moment[2]))
        # the torque at an angle is a sum of its cosine and its sine
        level, raised = dot(across, _UP), dot(cross(self.axis, across), _UP)
        angles = [*self.limits, *_peaks(math.atan2(raised, level), *self.limits)]
        return GRAVITY * max(abs(math.cos(each) * level + math.sin(each) * raised) for each in angles)


def _positions(joint: Joint) -> Sequence[float]:
    """Return the positions that are tried: the limits, and quarters of a turn between them."""
    lower, upper = _range(joint)
    wanted = (lower, upper, (lower + upper) / 2, *(_QUARTER * each for each in range(-2, 3)))
    return sorted({each for each in wanted if math.isfinite(each) and lower <= each <= upper})


def _peaks(angle: float, lower: float, upper: float) -> Iterator[float]:
    """Yield the angles between two limits at which a torque is greatest, one half turn from each other."""
    for half in range(-4, 5):
        if lower <= angle + half * math.pi <= upper:
            yield angle + half * math.pi
