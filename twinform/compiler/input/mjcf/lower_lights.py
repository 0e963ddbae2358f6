"""Lights and cameras of MJCF as lights and camera sensors of SDF."""

import math

from twinform.compiler.input.mjcf.names import name_mark
from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.compiler.input.mjcf.pieces import Piece, placed_at, pose_of
from twinform.compiler.input.mjcf.remainders import RemainderKeeper
from twinform.ir import Color, Element, Light, Opaque, Pose, Sensor
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_mjcf.writing_context import safe_name
from twinform.schemas import format_value

_FIXED = "fixed"
_TYPES = {"spot": "spot", "point": "point", "directional": "directional"}
_DIRECTION: Numbers = (0.0, 0.0, -1.0)
_SPOT_ANGLE = 45.0
"""In degrees, from the axis of a spot light to its edge, where nothing is written."""
_DIFFUSE, _SPECULAR = (0.7, 0.7, 0.7), (0.3, 0.3, 0.3)
"""The colors of a light of MJCF that says nothing of them."""
_FOVY = 45.0
"""In degrees, the vertical field of view of a camera of MJCF that says nothing of it."""
_PIXELS = (320.0, 240.0)
"""The size of the image of a camera of SDF that says nothing of it."""
_LOOKS_ALONG = Transform.from_pose(Pose.unchecked(quat_xyzw=(-0.5, 0.5, 0.5, 0.5)))
"""The frame of SDF's camera, which looks along x with z up, in that of MJCF's, which looks along -z with y up."""


def lower_light(piece: Piece, name: str, keeper: RemainderKeeper) -> Light | None:
    """Build a light; None for one that follows something, or that SDF has no kind for."""
    kind = _type_of(piece)
    if kind not in _TYPES or (piece.peek("mode") or _FIXED) != _FIXED:
        return None
    piece.take("name")
    for attribute in ("type", "directional", "mode"):
        piece.take(attribute)
    x, y, z = piece.numbers("dir") or _DIRECTION
    at = placed_at(piece.numbers("pos"))
    given = safe_name(name)
    return Light.unchecked(
        name=given,
        type=_TYPES[kind],
        pose=pose_of(at, source=piece.source),
        cast_shadows=piece.is_true("castshadow", default=True),
        diffuse=_color(piece.numbers("diffuse") or _DIFFUSE),
        specular=_color(piece.numbers("specular") or _SPECULAR),
        direction=(x, y, z),
        opaque=(*_renamed(name, given), *_spot(piece, kind), *keeper.rest(piece)),
        source=piece.source,
    )


def _renamed(name: str, given: str) -> tuple[Opaque, ...]:
    """Return the annotation of a name that SDF cannot hold; whoever made up a name says that."""
    return name_mark(name, given) if name != given else ()


def _type_of(piece: Piece) -> str:
    if piece.peek("directional") == "true":  # as it was called before `type`
        return "directional"
    return piece.peek("type") or "spot"


def _spot(piece: Piece, kind: str) -> tuple[Opaque, ...]:
    """Return the angle of a spot light: in MJCF from its axis, in SDF from edge to edge."""
    if kind != "spot":
        return ()
    cutoff = piece.number("cutoff")
    edge = 2 * math.radians(_SPOT_ANGLE if cutoff is None else cutoff)
    angles = {"inner_angle": edge, "outer_angle": edge, "falloff": 0.0}
    inside = tuple(Element.unchecked(name=name, text=format_value(value)) for name, value in angles.items())
    return (Opaque.unchecked(element=Element.unchecked(name="spot", children=inside)),)


def _color(rgb: Numbers) -> Color:
    return (*(min(1.0, max(0.0, each)) for each in rgb[:3]), 1.0)


def lower_camera(piece: Piece, name: str, keeper: RemainderKeeper) -> Sensor | None:
    """Build a camera; None for one that follows something, or that is given by its lens."""
    if (
        (piece.peek("mode") or _FIXED) != _FIXED
        or piece.has("sensorsize")
        or piece.peek("projection") == "orthographic"
    ):
        return None
    piece.take("name")
    piece.take("mode")
    piece.take("projection")
    resolution = piece.peek_numbers("resolution")
    width, height = _PIXELS
    if any(each > 1 for each in resolution):  # the default of one pixel says nothing of the shape of an image
        width, height = piece.numbers("resolution")
    fovy = math.radians(next(iter(piece.numbers("fovy")), _FOVY))
    angle = 2 * math.atan(math.tan(fovy / 2) * width / height)
    size = (Element.unchecked(name="width", text=f"{width:g}"), Element.unchecked(name="height", text=f"{height:g}"))
    inside = (
        Element.unchecked(name="horizontal_fov", text=format_value(angle)),
        Element.unchecked(name="image", children=size),
    )
    given = safe_name(name)
    image = Opaque.unchecked(element=Element.unchecked(name="camera", children=inside))
    return Sensor.unchecked(
        name=given,
        type="camera",
        pose=pose_of(piece.transform().compose(_LOOKS_ALONG), source=piece.source),
        opaque=(*_renamed(name, given), image, *keeper.rest(piece)),
        source=piece.source,
    )
