"""Checks of pairs: what the names of a left and a right part promise, against their places, axes and sizes."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple, TypeVar

from twinform.compiler.mistakes.scale_checks import is_made_up
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Joint, Link, Mesh, Model, Vector3
from twinform.ir.bounds import bounds
from twinform.ir.defaults import direction
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.transform import Transform, dot, minus
from twinform.lazy import lazy_pattern
from twinform.passes.shared.moving_bodies import movable_models

_SIDES = {
    "left": "right", "l": "r", "lf": "rf", "fl": "fr", "lh": "rh", "hl": "hr", "rl": "rr", "lr": "rr", "bl": "br",
    "lb": "rb", "ml": "mr", "lm": "rm",
}  # fmt: skip
"""Words for the left of something, and those for the right of it."""
_WORD = lazy_pattern(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
_ENDS = lazy_pattern(r"(?i)front|rear|back|mid(?:dle)?|[fbrmh](?=[lr](?:\b|_))|(?<=[lr])[fbrmh](?=\b|_)")
_SAME = 1e-6
"""How far two places or directions may differ by rounding."""
_ASIDE = 1e-3
"""A distance from the middle that is meant, m."""
_PARALLEL = 0.999
_ALONG = 0.5
"""The cosine above which fingers open along the line between them."""
_SEVERAL = 3
"""So many pairs that differ alike are one finding."""
_RATIO = 4.0
"""How many times a part may be as large, heavy or strong as its twin."""
_WHEELS = 4
"""So many wheels show which of them is the odd one."""

Part = TypeVar("Part", Joint, Link)


class _Twins(NamedTuple):
    """A left and a right joint of one parent, and where they are in it."""

    left: Joint
    right: Joint
    left_at: Transform
    right_at: Transform


class _Wheel(NamedTuple):
    """A joint that turns freely, its place in the parent, and its direction there."""

    joint: Joint
    place: Vector3
    axis: Vector3


def report_twins(document: Document, sink: DiagnosticSink) -> None:
    """Report left and right parts that are no mirror images where nobody means it so."""
    for model in movable_models(document):
        pairs = list(_pairs(model.joints))
        if pairs:
            _report_joints(pairs, model, document.format, sink)
        links = list(_pairs(model.links))
        _report_masses(links, sink)
        for left, right in links:
            _report_links(left, right, sink)


def _pairs(parts: Sequence[Part]) -> Iterator[tuple[Part, Part]]:
    by_name = {part.name: part for part in parts}
    for part in parts:
        other = next((by_name[name] for name in _names_right(part.name) if name in by_name), None)
        if other is not None:
            yield part, other


def _names_right(name: str) -> Iterator[str]:
    """The names that the right part may have that belongs to the left one of a name."""
    for found in _WORD.finditer(name):
        word = found[0]
        right = _SIDES.get(word.lower())
        if right:
            written = right.upper() if word.isupper() else right.capitalize() if word[0].isupper() else right
            yield name[: found.start()] + written + name[found.end() :]


def _report_joints(pairs: list[tuple[Joint, Joint]], model: Model, format_: Format, sink: DiagnosticSink) -> None:
    place = _placer(model, format_)
    twins = [found for left, right in pairs if (found := _placed(left, right, place))]
    for each in twins:
        if each.left.type != each.right.type:
            continue
        if not (_report_place(each, sink) or _report_slide(each, format_, sink)):
            _report_strength(each, sink)
    wheels = defaultdict[tuple[str, str | None], list[_Wheel]](list)
    for each in twins:
        if each.left.type == each.right.type and _turns_freely(each.left):
            key = _ENDS.sub("", each.left.name), each.left.parent
            wheels[key] += [
                _Wheel(joint, at.translation, _axis(joint, at, format_))
                for joint, at in ((each.left, each.left_at), (each.right, each.right_at))
            ]
    for group in wheels.values():
        _report_odd_wheel(group, sink)
        _report_same_place(group, sink)


def _placer(model: Model, format_: Format) -> Callable[[Joint], Transform | None]:
    """How to find a joint in the frame of its parent."""
    if format_ is Format.URDF:
        return lambda joint: Transform.from_pose(joint.pose)
    graph: list[FrameGraph] = []

    def find(joint: Joint) -> Transform | None:
        graph[:] = graph or [FrameGraph(model)]
        try:
            return graph[0].pose(joint.name, joint.parent or "", kind="joint")
        except FrameError:
            return None

    return find


def _placed(left: Joint, right: Joint, place: Callable[[Joint], Transform | None]) -> _Twins | None:
    if left.parent is None or left.parent != right.parent or left.parent == "world":
        return None
    left_at, right_at = place(left), place(right)
    return _Twins(left, right, left_at, right_at) if left_at and right_at else None


def _turns_freely(joint: Joint) -> bool:
    limit = joint.axis.limit if joint.axis else None
    is_open = limit is None or (limit.lower in {None, -math.inf, -1e16} and limit.upper in {None, math.inf, 1e16})
    return joint.type == "continuous" or (joint.type == "revolute" and is_open)


def _axis(joint: Joint, at: Transform, format_: Format) -> Vector3:
    """The direction of a joint in the frame of its parent."""
    if joint.axis and (joint.axis.expressed_in or joint.axis.use_parent_model_frame):
        own = direction(joint.axis, format_)
        return own if joint.axis.expressed_in == joint.parent else (0.0, 0.0, 0.0)
    return at.rotate(direction(joint.axis, format_))


def _report_place(each: _Twins, sink: DiagnosticSink) -> bool:
    """Report twins that are at one place, and such that are mirrored but for the distance."""
    found = _place_fault(each)
    if found is None:
        return False
    message, hint = found
    odd, other = (each.left, each.right) if each.left_at.translation[1] < 0 else (each.right, each.left)
    where, related = (odd.pose or odd).location, (other.pose or other).location
    names = f"joints {each.right.name!r} and {each.left.name!r}"
    sink.report(rules.UNLIKE_TWIN, f"{names} {message}", where, help=hint, related=(related,))
    return True


def _place_fault(each: _Twins) -> tuple[str, str] | None:
    """Find what is wrong with the places of twins, as the end of a sentence, and what the mistake may be."""
    left, right = each.left_at.translation, each.right_at.translation
    differ = [at for at in range(3) if abs(left[at] - right[at]) > _SAME]
    # Two fingers may turn about one bolt in the middle; y is to the left.
    if not differ and abs(left[1]) > _ASIDE:
        side = "left" if left[1] > 0 else "right"
        return (
            f"are at the same place, {abs(left[1]):g} m to the {side}",
            "is a minus missing in one of their <origin>?",
        )
    if len(differ) == 1 and _turns_freely(each.right):
        one, other = left[differ[0]], right[differ[0]]
        near, far = sorted((abs(one), abs(other)))
        if one * other < 0 and far > _RATIO * near:
            axis = "xyz"[differ[0]]
            return f"are mirrored, but {abs(other):g} m and {abs(one):g} m off along {axis}", "is a digit missing?"
    return None


def _report_slide(each: _Twins, format_: Format, sink: DiagnosticSink) -> bool:
    """Report fingers that slide to the same side, where one follows the other or both have the limits of one."""
    if each.left.type != "prismatic":
        return False
    one, other = _axis(each.left, each.left_at, format_), _axis(each.right, each.right_at, format_)
    lengths = math.hypot(*one) * math.hypot(*other)
    if not lengths or dot(one, other) < _PARALLEL * lengths or not _opens_alike(each.left, each.right):
        return False
    apart = minus(each.left_at.translation, each.right_at.translation)
    if abs(dot(one, apart)) < _ALONG * math.hypot(*one) * math.hypot(*apart):
        return False  # both sides of a suspension go up, and of a lift
    message = (
        f"joints {each.right.name!r} and {each.left.name!r} slide to the same side: one opens where the other closes"
    )
    axis = each.right.axis
    where = axis.location if axis and axis.source else each.right.location
    sink.report(
        rules.UNLIKE_TWIN, message, where, help="turn the <axis> of one of them round", related=(each.left.location,)
    )
    return True


def _opens_alike(left: Joint, right: Joint) -> bool:
    """Whether a positive way means the same to two fingers: their limits are one-sided, and on the same side."""
    ranges = [joint.axis.limit for joint in (left, right) if joint.axis and joint.axis.limit]
    followers = [joint.axis.mimic for joint in (left, right) if joint.axis and joint.axis.mimic]
    if any((one.multiplier or 1.0) < 0 for one in followers) or len(ranges) < 2:
        return False
    pairs = [(each.lower or 0.0, each.upper or 0.0) for each in ranges]
    return all(low >= 0 and high > 0 for low, high in pairs) or all(low < 0 and high <= 0 for low, high in pairs)


def _report_strength(each: _Twins, sink: DiagnosticSink) -> None:
    limits = [joint.axis.limit if joint.axis else None for joint in (each.left, each.right)]
    left, right = limits
    if left is None or right is None or is_made_up(left) or is_made_up(right):
        return
    for name in ("effort", "velocity"):
        one, other = getattr(left, name), getattr(right, name)
        if one and other and _is_unlike(one, other):
            (most, joint, limit), (least, twin, its) = sorted(
                ((one, each.left, left), (other, each.right, right)), key=lambda pair: -pair[0]
            )
            message = f"joint {joint.name!r} has a limit of {name} of {most:g}, its twin {twin.name!r} of {least:g}"
            sink.report(rules.UNLIKE_TWIN, message, limit.location, found=f"{most:g}", related=(its.location,))


def _is_unlike(one: float, other: float) -> bool:
    low, high = sorted((abs(one), abs(other)))
    return high > _RATIO * low > 0


def _report_odd_wheel(group: list[_Wheel], sink: DiagnosticSink) -> None:
    """Report the one of many wheels that turns against all others."""
    turns = [dot(group[0].axis, each.axis) for each in group]
    if len(group) < _WHEELS or any(abs(each) < _PARALLEL for each in turns):
        return
    for sign in (1, -1):
        odd = [each.joint for each, turn in zip(group, turns, strict=True) if sign * turn < 0]
        if len(odd) == 1:
            others = [each.joint for each in group if each.joint is not odd[0]]
            message = (
                f"joint {odd[0].name!r} turns against the other wheels, {', '.join(repr(each.name) for each in others)}"
            )
            axis = odd[0].axis
            where = axis.location if axis and axis.source else odd[0].location
            sink.report(rules.UNLIKE_TWIN, message, where, help="turn its <axis> round", related=(others[0].location,))


def _report_same_place(group: list[_Wheel], sink: DiagnosticSink) -> None:
    """Report two wheels of one side that are at one place, such as a front and a rear one."""
    seen: dict[Vector3, Joint] = {}
    for each in group:
        x, y, z = (round(part, 6) for part in each.place)
        other = seen.setdefault((x, y, z), each.joint)
        if (
            other is not each.joint
            and any((x, y, z))
            and other.name not in _names_right(each.joint.name)
            and each.joint.name not in _names_right(other.name)
        ):
            message = f"joint {each.joint.name!r} is where joint {other.name!r} is"
            where = (each.joint.pose or each.joint).location
            hint = "is a minus missing in one of their <origin>?"
            sink.report(rules.UNLIKE_TWIN, message, where, help=hint, related=(other.location,))


def _report_masses(pairs: list[tuple[Link, Link]], sink: DiagnosticSink) -> None:
    """Report links that are several times as heavy as their twins; many of the same two masses once."""
    unlike = defaultdict[tuple[float, float], list[tuple[Link, Link]]](list)
    for pair in pairs:
        light, heavy = sorted(pair, key=_mass)
        if _is_unlike(_mass(light), _mass(heavy)):
            unlike[_mass(heavy), _mass(light)].append((heavy, light))
    for (most, least), found in unlike.items():
        for heavy, light in found if len(found) < _SEVERAL else found[:1]:
            message = f"link {heavy.name!r} weighs {most:g} kg, its twin {light.name!r} {least:g} kg"
            if len(found) >= _SEVERAL:
                message += f"; so do {len(found) - 1} other pairs"
            where = heavy.inertial.location.at("mass") if heavy.inertial else heavy.location
            sink.report(rules.UNLIKE_TWIN, message, where, found=f"{most:g}", related=(light.location,))


def _report_links(left: Link, right: Link, sink: DiagnosticSink) -> None:
    """Report shapes of a link that are several times as large as those of its twin."""
    for kind in ("visuals", "collisions"):
        ours, theirs = getattr(right, kind), getattr(left, kind)
        if len(ours) == len(theirs):
            for own, other in zip(ours, theirs, strict=True):
                _report_shapes(own.geometry, other.geometry, kind[:-1], (left, right), sink)


def _mass(link: Link) -> float:
    return link.inertial.mass or 0.0 if link.inertial else 0.0


def _report_shapes(own: object, its: object, kind: str, links: tuple[Link, Link], sink: DiagnosticSink) -> None:
    one, two = getattr(own, "shape", None), getattr(its, "shape", None)
    if one is None or two is None or one.kind != two.kind:
        return
    sizes = [_sizes(one), _sizes(two)]
    for mine, theirs in zip(*sizes, strict=True) if len(sizes[0]) == len(sizes[1]) else ():
        if mine and theirs and _is_unlike(mine, theirs):
            what = "scale" if isinstance(one, Mesh) else "size"
            (most, link, shape), (least, twin, other) = sorted(
                ((theirs, links[0], two), (mine, links[1], one)), key=lambda each: -each[0]
            )
            message = (
                f"the {kind} of link {link.name!r} has the {what} {most:g}, that of its twin {twin.name!r} {least:g}"
            )
            sink.report(rules.UNLIKE_TWIN, message, shape.location, found=f"{most:g}", related=(other.location,))
            return


def _sizes(shape: object) -> Sequence[float]:
    if isinstance(shape, Mesh):
        return shape.scale or (1.0, 1.0, 1.0)
    box = bounds(shape)  # pyright: ignore[reportArgumentType] - a shape
    return box.size if box else ()
