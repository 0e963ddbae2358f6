"""What sensors see: frusta of cameras and rays of lidars, along the x axis of the sensor with z up."""

import math
from collections.abc import Iterator

from twinform.compiler.scene.scene import Frustum, Ray
from twinform.ir import Element, Pose, Sensor
from twinform.ir.sensor import RENAMED_ELEMENTS
from twinform.ir.transform import Transform
from twinform.passes.shared.sensor_costs import image_size, samples

_HORIZONTAL_FOV, _NEAR, _FAR = 1.047, 0.1, 100.0
"""SDF's defaults of a camera, in rad and m."""
_MOST_RAYS = 24
"""So many are drawn of each direction of a scan."""
_FLAT = 1e-6
_WIDEST = math.pi - 1e-3
_LIDARS = frozenset({"ray", "lidar"})


def frustums_of(sensor: Sensor) -> Iterator[Frustum]:
    """Yield the view of each camera of a sensor."""
    for part in sensor.opaque:
        if part.element and part.element.name == "camera":
            yield _make_frustum(part.element)


def rays_of(sensor: Sensor) -> Iterator[Ray]:
    """Yield some rays of a lidar, the outermost among them."""
    for part in sensor.opaque:
        if part.element and RENAMED_ELEMENTS.get(part.element.name, part.element.name) in _LIDARS:
            yield from _make_rays(part.element)


def _make_frustum(camera: Element) -> Frustum:
    width, height = image_size(camera.find("image"))
    horizontal = min(_read_number(camera, "horizontal_fov", _HORIZONTAL_FOV), _WIDEST)
    clip = camera.find("clip")
    near, far = _read_number(clip, "near", _NEAR), _read_number(clip, "far", _FAR)
    # square pixels: tan(v/2) / tan(h/2) = height / width
    vertical = 2 * math.atan(math.tan(horizontal / 2) * height / width) if width and height else horizontal
    return Frustum(horizontal, vertical, near, max(near, far), Transform.from_pose(_read_pose(camera)))


def _make_rays(lidar: Element) -> Iterator[Ray]:
    scan, range_ = lidar.find("scan"), lidar.find("range")
    near, far = _read_number(range_, "min", 0.0), _read_number(range_, "max", 0.0)
    counts = samples(lidar)
    around = [*_choose_angles(scan, "horizontal", counts["horizontal"])]
    for up in _choose_angles(scan, "vertical", counts["vertical"]):
        for aside in around:
            x, y, z = math.cos(up) * math.cos(aside), math.cos(up) * math.sin(aside), math.sin(up)
            yield Ray((near * x, near * y, near * z), (far * x, far * y, far * z))


def _choose_angles(scan: Element | None, direction: str, count: int) -> Iterator[float]:
    element = scan.find(direction) if scan else None
    least, most = _read_number(element, "min_angle", 0.0), _read_number(element, "max_angle", 0.0)
    shown = min(count, _MOST_RAYS) if most - least > _FLAT else 1
    shares = (i / (shown - 1) if shown > 1 else 0.5 for i in range(shown))
    return (least * (1 - share) + most * share for share in shares)  # a difference may be too large for a number


def _read_number(element: Element | None, name: str, usual: float) -> float:
    child = element.find(name) if element else None
    try:
        value = float((child.text or "").strip()) if child else usual
    except ValueError:
        return usual
    return value if math.isfinite(value) else usual


def _read_pose(camera: Element) -> Pose | None:
    """Return the `<pose>` of a camera in its sensor; None if it has none, or one that cannot be read."""
    child = camera.find("pose")
    words = (child.text or "").split() if child else []
    if child is None or len(words) != 6 or child.get("relative_to"):
        return None
    try:
        x, y, z, roll, pitch, yaw = map(float, words)
    except ValueError:
        return None
    return Pose(xyz=(x, y, z), rpy=(roll, pitch, yaw), degrees=child.get("degrees") == "true" or None)
