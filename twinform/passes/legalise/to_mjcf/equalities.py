"""Equalities of MJCF: joints that close a loop, which are no part of the tree (`context.closing`).

A ball is a `connect` at its origin, a fixed joint a `weld`, and a hinge two `connect`, at two points of its axis. They
hold bodies where these are drawn. Joints of other types hold nothing in MJCF, and are carried.
"""

from collections.abc import Callable

from twinform.diagnostics import Fate, rules
from twinform.ir import Element, Joint
from twinform.ir.defaults import direction
from twinform.ir.document import Format
from twinform.ir.frames import WORLD
from twinform.ir.kinematic_tree import JointBetween
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.old_names import source_name
from twinform.passes.legalise.to_mjcf.elements import Value, make_element
from twinform.passes.legalise.to_mjcf.kept_mjcf import with_kept_equality
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

_BALLS = frozenset({"ball", "spherical"})
_HINGES = frozenset({"revolute", "continuous"})
ARM = 0.1
"""How far along the axis of a hinge its second point is, in m: a loop gives way about as much there as at the first."""


def add_equalities(context: MjcfContext) -> None:
    """Add what closes loops to the `equality` section. All bodies and joints have their names by now."""
    for between in context.closing:
        if between.type != "gearbox":  # which couples two joints, and connects nothing by itself
            _close(context, between)


def _close(context: MjcfContext, between: JointBetween) -> None:
    joint = between.joint
    ends: list[tuple[str, Value]] = [
        ("body1", _body(context, between.parent)),
        ("body2", _body(context, between.child)),
    ]
    if between.parent == between.child:
        message = f"joint {joint.name!r} connects frames of one link, which holds them by itself"
        context.account(rules.NOT_IN_MJCF, message, joint.location, 0)
        return
    if joint.type == "fixed":
        _add(context, between, [_equality("weld", _name(context, between), ends, joint)])
        return
    points = _points(context, between)
    if not points:
        message = f"{joint.type} joint {joint.name!r} closes a loop, and MuJoCo holds loops together at points alone"
        context.account(rules.NOT_IN_MJCF, message, joint.location, 0)
        return
    name = _name(context, between)
    names = [name, f"{name}_axis"][: len(points)]
    pairs = zip(names, points, strict=True)
    made = [_equality("connect", name, [*ends, ("anchor", rounded(point))], joint) for name, point in pairs]
    _add(context, between, made)
    if joint.type in _HINGES and joint.axis is not None and (joint.axis.limit or joint.axis.dynamics):
        message = f"joint {joint.name!r} closes a loop, and has neither limits nor damping in MJCF"
        context.sink.account(Fate.APPROXIMATED, rules.NOT_IN_MJCF, message, joint.location, 0)


def _name(context: MjcfContext, between: JointBetween) -> str:
    return context.wish("equality", context.scope_of(between.name), source_name(between.joint))


def _add(context: MjcfContext, between: JointBetween, elements: list[Element]) -> None:
    names: list[str] = []
    for each in elements:
        name = context.name("equality", each.get("name"), between.joint.location) or between.name
        names.append(name)
        context.note_made_name(each.name, between.joint, name, f"{each.get('body1')}_{each.get('body2')}_{each.name}")
        context.add("equality", each.copy(attributes=(("name", name), *each.attributes[1:])))
    context.written_joints[between.name] = tuple(names)


def _equality(tag: str, name: str, attributes: list[tuple[str, Value]], joint: Joint) -> Element:
    return with_kept_equality(make_element(tag, [("name", name), *attributes], (), joint.source), joint)


def _points(context: MjcfContext, between: JointBetween) -> list[Vector3]:
    parent = between.parent if between.parent in context.tree.links else None
    scope = context.scope_of(between.name)

    def place(frame: str | None) -> Transform:
        name = between.name if frame is None else frame if frame == WORLD else scope + frame
        return context.place(name, parent, kind="joint")

    return held_points(between.joint, place)


def is_held_in_mjcf(joint: Joint) -> bool:
    """Whether constraints of MJCF stand for a joint that closes a loop."""
    return joint.parent != joint.child and (joint.type == "fixed" or joint.type in _BALLS | _HINGES)


def held_points(joint: Joint, place: Callable[[str | None], Transform]) -> list[Vector3]:
    """The points in the frame of the parent where both bodies have to stay together; none for other types of joints.

    `place` tells where a frame is in that of the parent, and where the joint is for None.
    """
    if joint.type not in _BALLS | _HINGES:
        return []
    at = place(None)
    if joint.type in _BALLS:
        return [at.translation]
    axis = joint.axis
    frame = place(axis.expressed_in) if axis is not None and axis.expressed_in else at
    x, y, z = frame.rotate(direction(axis, Format.SDF))
    length = (x * x + y * y + z * z) ** 0.5 or 1.0
    along = (at.translation[0] + ARM * x / length, at.translation[1] + ARM * y / length)
    return [at.translation, (*along, at.translation[2] + ARM * z / length)]


def _body(context: MjcfContext, link: str) -> str:
    """The name of the body of a link; that of the world is `world`."""
    return context.written_bodies.get(link, link)
