"""Reverse conversion of capsules: the cylinder and the spheres that stand for one become it again."""

import math
from collections.abc import Iterator, Sequence
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import (
    Capsule,
    Collision,
    Cylinder,
    Document,
    Link,
    Model,
    Node,
    Pose,
    Sphere,
    Visual,
    replace_fields,
    rewrite,
)
from twinform.ir.defaults import sizes
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.replaced_shapes import (
    CAPSULE,
    CAPSULE_END,
    REPLACED,
    AnyPart,
    end_poses,
    map_sensors,
    map_touched,
)

_SAME = 1e-9
"""How far ends may be from where they were put, in parts of the size and the distance of a capsule."""


class FoldCapsules(Pass):
    """Make one capsule of the primitives that stand for one.

    Changes: a cylinder annotated as the middle of a capsule, with the two spheres behind it that are annotated as its
    ends, becomes a capsule, and so does a sphere that was one without a length.
    Never touches: primitives that make no capsule any more. What stands in the file counts, and they lose their
    annotations.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "fold-capsules"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with capsules."""
        return fold_capsules(document, sink)


def fold_capsules(document: Document, sink: DiagnosticSink) -> Document:
    """The document with a capsule in place of its parts, where these still make one."""
    return rewrite(document, Model, lambda model: _fold_model(model, sink), having=REPLACED)


def _fold_model(model: Model, sink: DiagnosticSink) -> Model:
    links: list[Link] = []
    gone: dict[str | None, dict[str, tuple[()]]] = {}
    for link in model.links:
        visuals, collisions = tuple(_fold_parts(link.visuals, sink)), tuple(_fold_parts(link.collisions, sink))
        if len(collisions) < len(link.collisions):
            kept = {each.name for each in collisions}
            gone[link.name] = {each.name or "": () for each in link.collisions if each.name not in kept}
        folded = replace_fields(link, visuals=visuals, collisions=collisions)
        links.append(map_sensors(folded, gone.get(link.name, {})))
    # A contact sensor names the capsule, which has the name of its middle.
    extensions = tuple(map_touched(each, gone.get(each.reference, {})) for each in model.extensions)
    return replace_fields(model, links=tuple(links), extensions=extensions)


def _fold_parts(parts: Sequence[AnyPart], sink: DiagnosticSink) -> Iterator[AnyPart]:
    """Yield parts in their order, with a capsule for each middle that has its ends behind it."""
    place = 0
    while place < len(parts):
        part = parts[place]
        ends = parts[place + 1 : place + 3] if find_annotation(part, CAPSULE) is not None else ()
        capsule = _capsule(part, ends)
        place += 1 if capsule is None or isinstance(_shape(part), Sphere) else 3
        if capsule is None and find_annotation(part, CAPSULE) is not None:
            kind = type(part).__name__.lower()
            message = f"{kind} {part.name!r} and the two behind it are no capsule any more: they are read as they stand"
            sink.account(Fate.DROPPED, rules.STALE_CARRIER, message, part.location, 1)
            sink.report(rules.STALE_CARRIER, message, part.location, found=part.name or "")
        yield without_annotation(part, CAPSULE, CAPSULE_END) if capsule is None else capsule


def _capsule(middle: AnyPart, ends: Sequence[AnyPart]) -> AnyPart | None:
    """The capsule that a part is, with its ends or alone; None where they make none."""
    shape = _shape(middle)
    bare = without_annotation(middle, CAPSULE)
    if bare is middle or middle.geometry is None or not isinstance(shape, Cylinder | Sphere):
        return None
    radius, length = sizes(shape) if isinstance(shape, Cylinder) else (*sizes(shape), 0.0)
    if length:
        poses = end_poses(middle.pose, length)
        size = abs(radius) + abs(length)
        if len(ends) != 2 or not all(_is_end(*pair, bare, radius, size) for pair in zip(ends, poses, strict=True)):
            return None
    made = Capsule.unchecked(radius=radius, length=length, source=shape.source, opaque=shape.opaque)
    return bare.copy(geometry=middle.geometry.copy(shape=made))


def _is_end(end: AnyPart, pose: Pose, middle: AnyPart, radius: float, size: float) -> bool:
    """Whether a part is the sphere at an end of a capsule, where it belongs, and like the middle in all else."""
    found, ball = find_annotation(end, CAPSULE_END), _shape(end)
    if found is None or (found.text or None) != end.name or not isinstance(ball, Sphere) or sizes(ball) != (radius,):
        return False
    if (end.pose.relative_to if end.pose else None) != pose.relative_to or _looks(end) != _looks(middle):
        return False
    here, there = Transform.from_pose(end.pose).translation, Transform.from_pose(pose).translation
    return math.dist(here, there) <= _SAME * (size + math.hypot(*there))


def _looks(part: AnyPart) -> AnyPart:
    """What a part says beside its name, place and shape, without our own elements."""
    return part.copy(name="", pose=None, geometry=None, opaque=tuple(each for each in part.opaque if not is_ours(each)))


def _shape(part: Visual | Collision) -> Node | None:
    return part.geometry.shape if part.geometry else None
