"""The costs of sensors in a simulator: pixels and rays per second."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from twinform.diagnostics import Source
from twinform.ir import Element, GazeboExtension, Node, Opaque, Sensor, walk

ALWAYS = 1000.0
"""The rate in Hz of a sensor without one: it runs with every step of the physics, by default 1 ms."""
_IMAGE = (320, 240)
_PARTS = frozenset({"camera", "ray", "lidar"})
_SAMPLES = {"horizontal": 640, "vertical": 1}


class SensorCost(NamedTuple):
    """The update rate of a sensor in Hz, which may be `assumed`, and the pixels and rays of each update."""

    rate: float
    pixels: int
    rays: int
    assumed: bool

    @property
    def pixels_per_second(self) -> float:
        """The pixels per second of all cameras of the sensor."""
        return self.rate * self.pixels

    @property
    def rays_per_second(self) -> float:
        """The rays per second in all layers."""
        return self.rate * self.rays


def sensors_in(node: Node) -> Iterator[Sensor]:
    """All sensors of a document or model in order, with those in `<gazebo>` extensions of URDF."""
    for each in walk(node):
        if isinstance(each, Sensor):
            yield each
        elif isinstance(each, GazeboExtension):
            found = (inner for element in each.content for inner in element.walk() if inner.name == "sensor")
            yield from (sensor_of(element, each.source) for element in found)


def sensor_of(element: Element, around: Source | None) -> Sensor:
    """A sensor that is kept as an element, with the parts that its cost depends on."""
    rate = element.find("update_rate")
    try:
        update_rate = float((rate.text or "").strip()) if rate else None
    except ValueError:
        update_rate = None
    return Sensor.unchecked(
        name=element.get("name"),
        type=element.get("type"),
        update_rate=update_rate,
        opaque=tuple(Opaque.unchecked(element=child) for child in element.children if child.name in _PARTS),
        source=element.source or around,
    )


def sensor_cost(sensor: Sensor) -> SensorCost:
    """The cost of a sensor."""
    rate = sensor.update_rate
    # `not rate > 0` and not `rate <= 0`: it is true for NaN as well.
    assumed = rate is None or not rate > 0 or not math.isfinite(rate)
    pixels = sum(width * height for width, height in images(sensor))
    return SensorCost(ALWAYS if assumed or rate is None else rate, pixels, _rays(sensor), assumed)


def images(sensor: Sensor) -> Iterator[tuple[int, int]]:
    """Width and height of each image that a sensor renders, in pixels."""
    for part in sensor.opaque:
        if part.element and part.element.name == "camera":
            yield image_size(part.element.find("image"))


def image_size(image: Element | None) -> tuple[int, int]:
    """Width and height of an `<image>`, in pixels."""
    return _count(image, "width", _IMAGE[0]), _count(image, "height", _IMAGE[1])


def _rays(sensor: Sensor) -> int:
    total = 0
    for part in sensor.opaque:
        if part.element and part.element.name in {"ray", "lidar"}:
            total += math.prod(samples(part.element).values())
    return total


def samples(element: Element) -> dict[str, int]:
    """The number of rays of a lidar along each direction of its scan."""
    scan = element.find("scan")
    found = {name: scan.find(name) if scan else None for name in _SAMPLES}
    return {
        name: _count(found[name], "samples", usual if name == "horizontal" else 1) for name, usual in _SAMPLES.items()
    }


def _count(element: Element | None, name: str, usual: int) -> int:
    child = element.find(name) if element else None
    try:
        return max(0, int(float((child.text or "").strip()))) if child else usual
    except (ValueError, OverflowError):
        return usual
