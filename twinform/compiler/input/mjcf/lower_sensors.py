"""Sensors of MJCF, which measure one quantity each at a site, as sensors of SDF.

Accelerometer and gyro of one site are an IMU, force and torque of one are a force-torque sensor of the joint above, and
touch, rangefinder and magnetometer are a contact sensor, a lidar of one ray and a magnetometer. All of them stay in the
remainder too, since a sensor of SDF says neither their names nor their cutoff.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from twinform.compiler.input.mjcf.pieces import Piece
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, in_sections
from twinform.ir import Element, Link, Opaque, Pose, Sensor

_IMU = ("accelerometer", "gyro")
_WRENCH = ("force", "torque")
_KINDS = {
    **dict.fromkeys(_IMU, "imu"),
    **dict.fromkeys(_WRENCH, "force_torque"),
    "touch": "contact",
    "rangefinder": "gpu_lidar",
    "magnetometer": "magnetometer",
}
_FARTHEST = 100.0
"""How far in m the ray of a rangefinder without a cutoff reaches."""
_Z_TO_X = (0.0, -0.7071067811865476, 0.0, 0.7071067811865476)
"""The quaternion x y z w that turns x, along which a lidar looks, onto z, along which a rangefinder does."""


class SiteSensor(NamedTuple):
    """The elements of a sensor at a site, and the type of the sensor of SDF that they make."""

    site: str
    type: str
    pieces: tuple[Piece, ...]


def by_site(sensors: Iterable[Piece]) -> tuple[SiteSensor, ...]:
    """Gather the sensors of each site by the type that they have in SDF; those without one are left out."""
    found: dict[tuple[str, str], list[Piece]] = {}
    for piece in sensors:
        site, kind = piece.peek("site"), _KINDS.get(piece.tag)
        if site is not None and kind is not None:
            found.setdefault((site, kind), []).append(piece)
    return tuple(SiteSensor(site, kind, tuple(pieces)) for (site, kind), pieces in found.items())


def lower_sensor(found: SiteSensor, name: str, frame: str, link: Link, keeper: RemainderKeeper) -> Sensor | None:
    """Build a sensor in the frame of its site; None for one of contacts on a link that touches nothing."""
    inside = _parameters(found, link)
    if inside is None:
        return None
    why = f"SDF has a sensor of type {found.type} instead"
    elements = [keeper.whole(each, "sensor", why) for each in found.pieces]
    turn = _Z_TO_X if found.type == "gpu_lidar" else None
    pose = Pose.unchecked(
        quat_xyzw=turn, rotation_format="quat_xyzw" if turn else None, relative_to=frame, source=found.pieces[0].source
    )
    return Sensor.unchecked(
        name=name,
        type=found.type,
        pose=pose,
        opaque=(*inside, *in_sections({"sensor": elements})),
        source=found.pieces[0].source,
    )


def _parameters(found: SiteSensor, link: Link) -> tuple[Opaque, ...] | None:
    if found.type == "contact":
        names = [each.name for each in link.collisions if each.name]
        return (_element("contact", [_text("collision", name) for name in names]),) if names else None
    if found.type == "gpu_lidar":
        return (_ray(found.pieces[0]),)
    if found.type == "force_torque":
        # MuJoCo tells what the parent does to the child, in the axes of the site
        return (_element("force_torque", [_text("frame", "sensor"), _text("measure_direction", "parent_to_child")]),)
    return ()


def _ray(piece: Piece) -> Opaque:
    farthest = next(iter(piece.peek_numbers("cutoff")), 0.0) or _FARTHEST
    scan = {"samples": "1", "min_angle": "0", "max_angle": "0"}
    horizontal = Element.unchecked(name="horizontal", children=tuple(_text(*each) for each in scan.items()))
    reach = [_text("min", "0"), _text("max", f"{farthest:g}")]
    return _element(
        "lidar",
        [
            Element.unchecked(name="scan", children=(horizontal,)),
            Element.unchecked(name="range", children=tuple(reach)),
        ],
    )


def _element(name: str, inside: Sequence[Element]) -> Opaque:
    return Opaque.unchecked(element=Element.unchecked(name=name, children=tuple(inside)))


def _text(name: str, text: str) -> Element:
    return Element.unchecked(name=name, text=text)
