"""Checks of values in files of parameters: limits beyond those of the robot, footprints, and repeated keys."""

import json
import math
from collections.abc import Callable, Iterable
from itertools import pairwise
from typing import cast

from twinform.compiler.companions.name_places import Leaf
from twinform.compiler.companions.robot_parts import RobotParts, range_of, velocity_of
from twinform.compiler.companions.yaml_leaves import YamlText
from twinform.diagnostics import DiagnosticSink, Location, Span, rules
from twinform.ir import Joint

_SLACK = 1e-3
"""How far a limit may be off by rounding, relative to its size."""
_CORNERS = 3


def report_limits(leaves: Iterable[Leaf[Location]], robot: RobotParts, sink: DiagnosticSink) -> None:
    """Report limits in `joint_limits` of MoveIt that let a joint go farther or faster than the robot does."""
    for leaf in leaves:
        joint = robot.joints.get(leaf.path[-2].text) if leaf.ends_in("joint_limits", "*", "*") else None
        value = _number(leaf.value.text)
        if joint is None or value is None:
            continue
        bound = _bound(leaf.path[-1].text, joint)
        if bound is not None and (value - bound) * (-1 if leaf.path[-1].text == "min_position" else 1) > _slack(bound):
            name = leaf.path[-1].text
            message = f"{name} of {joint.name!r} is {value:g}, beyond {bound:g}, which the robot has"
            sink.report(rules.LOOSENED_LIMIT, message, leaf.value.place, found=leaf.value.text, expected=f"{bound:g}")


def _slack(bound: float) -> float:
    return _SLACK * max(1.0, abs(bound))


def _bound(name: str, joint: Joint) -> float | None:
    """Return the bound of a joint that a limit must not be beyond; None if there is none."""
    lower, upper = range_of(joint)
    bound = {"max_velocity": velocity_of(joint), "max_position": upper, "min_position": lower}.get(name)
    return bound if bound is not None and math.isfinite(bound) else None


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def report_footprints(leaves: Iterable[Leaf[Location]], sink: DiagnosticSink) -> None:
    """Report footprints of Nav2 that are no polygon."""
    for leaf in leaves:
        text = leaf.value.text
        if not leaf.ends_in("footprint") or "[" not in text or "ros__parameters" not in {s.text for s in leaf.path}:
            continue
        problem = _problem_of_footprint(text)
        if problem:
            hint = "write the corners in their order around the robot, as '[[x, y], [x, y], [x, y]]' in m"
            sink.report(rules.BROKEN_FOOTPRINT, f"the footprint {problem}", leaf.value.place, found=text, help=hint)


def _problem_of_footprint(text: str) -> str:
    """Say why a text is no polygon; empty if it is one."""
    try:
        found: object = json.loads(text, parse_int=float)
    except (ValueError, RecursionError):
        return f"{text[:60]!r} is no list of points"
    points = cast("list[object]", found) if isinstance(found, list) else []
    corners = [cast("list[object]", each) for each in points if isinstance(each, list)]
    if len(corners) != len(points) or any(len(each) != 2 for each in corners):
        return "has points that are not two numbers"
    if not all(isinstance(value, float) for each in corners for value in each):
        return "has points that are not two numbers"
    if len(corners) < _CORNERS:
        return f"has {len(corners)} points; a polygon has three at least"
    pairs = [(cast("float", x), cast("float", y)) for x, y in corners]
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise([*pairs, pairs[0]]))
    return "" if abs(area) > 0 else "has its points on one line"


def report_repeated(parameters: YamlText, place: Callable[[Span], Location], sink: DiagnosticSink) -> None:
    """Report keys that their mapping has before, of which the last one counts."""
    for each in parameters.repeated:
        message = f"{each.text!r} stands twice in one mapping; the first is not read"
        related = (place(each.first)._replace(file=sink.file),)
        sink.report(rules.REPEATED_KEY, message, place(each.place), found=each.text, related=related)
