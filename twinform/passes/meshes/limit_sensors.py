"""Lower the update rates, image sizes and numbers of rays of sensors, one by one or to a budget of all.

The costs of sensors are measured in pixels and rays per second.
"""

import math
from collections.abc import Callable, Iterator
from typing import ClassVar, NamedTuple

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, Source
from twinform.diagnostics.rules import LIMITED_SENSOR, SENSOR_OVER_BUDGET
from twinform.ir import Document, Element, GazeboExtension, Node, Opaque, Sensor, bits_of, rewrite, walk
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name

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


_KINDS = ("pixels", "rays")
_FINE = 1000
"""Rates are written to 1/1000 Hz."""
_HAVING = bits_of(Sensor) | bits_of(GazeboExtension)


class LimitSensors(Pass):
    """Lower what cameras and lidars cost: how often they work, and how many pixels and rays they have.

    Changes sensors whose name matches `sensors` and that have images or rays, also those of `<gazebo>` extensions:

    1. an update rate above `max-rate` becomes that; so does one that is not written, or zero, which means every step;
    2. an image with more than `max-pixels` becomes smaller, with the same shape as nearly as whole pixels can have it;
    3. a scan with more than `max-rays` gets fewer of them along each direction, in the same proportion;
    4. where all together make more than `pixels-per-second` or `rays-per-second`, the rates of those that do are
       lowered by the same factor, but not below `min-rate`.

    Never touches: ranges, fields of view, noise, and sensors without images or rays.
    Diagnostics: `limited-sensor` for each with what it cost and costs, and `sensor-over-budget` where `min-rate` keeps
    them above the budget.
    """

    name = "limit-sensors"
    example: ClassVar[str] = "limit-sensors{max-rate=15 max-pixels=307200 rays-per-second=200000}"

    sensors: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only sensors"))
    max_rate: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="The highest rate, in Hz.")
    min_rate: float = Field(default=1.0, gt=0, allow_inf_nan=False, description="The lowest rate for a budget, in Hz.")
    max_pixels: int | None = Field(default=None, gt=0, description="The most pixels of an image.")
    max_rays: int | None = Field(default=None, gt=0, description="The most rays of a scan.")
    pixels_per_second: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="What all cameras may render together."
    )
    rays_per_second: float | None = Field(
        default=None, gt=0, allow_inf_nan=False, description="What all lidars may cast together."
    )

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with sensors that cost less."""
        olds = sensors_in(document)

        def limit(sensor: Sensor) -> Sensor:
            return self._limit_sensor(sensor) if matches(sensor.name, self.sensors) and _has_cost(sensor) else sensor

        limited = _map_sensors(document, limit)
        factors = {name: self._rate_factor(limited, name, sink) for name in _KINDS}

        def slow(sensor: Sensor) -> Sensor:
            old = next(olds)
            made = self._lower_rate(sensor, factors) if matches(sensor.name, self.sensors) else sensor
            if sensor_cost(made) != sensor_cost(old):
                _report_limited(old, made, sink)
            return made

        return _map_sensors(limited, slow)

    def _limit_sensor(self, sensor: Sensor) -> Sensor:
        made = sensor
        if self.max_pixels is not None and any(width * height > self.max_pixels for width, height in images(sensor)):
            made = _change_elements(made, "camera", lambda element: _shrink_image(element, self.max_pixels or 1))
        if self.max_rays is not None and sensor_cost(sensor).rays > self.max_rays:
            for name in ("ray", "lidar"):
                made = _change_elements(made, name, lambda element: _reduce_rays(element, self.max_rays or 1))
        cost = sensor_cost(sensor)
        if self.max_rate is not None and cost.rate > self.max_rate:
            made = made.copy(update_rate=self.max_rate)
        return made

    def _rate_factor(self, document: Document, kind: str, sink: DiagnosticSink) -> float:
        """The factor for the rates of sensors that make pixels, or rays, so that these stay within the budget."""
        budget: float | None = getattr(self, f"{kind}_per_second")
        if budget is None:
            return 1.0
        chosen = [each for each in sensors_in(document) if matches(each.name, self.sensors)]
        costs = [cost for cost in map(sensor_cost, chosen) if getattr(cost, kind)]
        total = sum(_per_second(cost, kind) for cost in costs)
        if total <= budget:
            return 1.0
        factor = budget / total
        for _ in costs:  # those at the lowest rate leave less to the others
            low = [cost for cost in costs if cost.rate * factor < self.min_rate]
            fixed = sum(min(cost.rate, self.min_rate) * getattr(cost, kind) for cost in low)
            free = sum(_per_second(cost, kind) for cost in costs if cost not in low)
            factor = max(0.0, (budget - fixed) / free) if free else 0.0
        left = sum(_scaled_rate(cost.rate, factor, self.min_rate) * getattr(cost, kind) for cost in costs)
        if left > budget * (1 + 1e-9):
            message = f"sensors make {left:,.0f} {kind} a second at {self.min_rate:g} Hz, and are to make {budget:,.0f}"
            sink.report(SENSOR_OVER_BUDGET, message, document.location, found=f"{left:.0f}", expected=f"{budget:g}")
        return factor

    def _lower_rate(self, sensor: Sensor, factors: dict[str, float]) -> Sensor:
        cost = sensor_cost(sensor)
        factor = min((factors[kind] for kind in _KINDS if getattr(cost, kind)), default=1.0)
        rate = _scaled_rate(cost.rate, factor, self.min_rate)
        return sensor if factor >= 1 or rate >= cost.rate else sensor.copy(update_rate=rate)


def _scaled_rate(rate: float, factor: float, least: float) -> float:
    """A rate times a factor, but not below the least rate."""
    return rate if factor >= 1 else max(math.floor(rate * factor * _FINE) / _FINE, min(rate, least))


def _per_second(cost: SensorCost, kind: str) -> float:
    return cost.pixels_per_second if kind == "pixels" else cost.rays_per_second


def _has_cost(sensor: Sensor) -> bool:
    cost = sensor_cost(sensor)
    return bool(cost.pixels or cost.rays)


def _report_limited(old: Sensor, new: Sensor, sink: DiagnosticSink) -> None:
    was, now = sensor_cost(old), sensor_cost(new)
    words = [
        f"{_per_second(was, kind):,.0f} {kind} a second became {_per_second(now, kind):,.0f}"
        for kind in _KINDS
        if getattr(was, kind)
    ]
    rates = f"{was.rate:g} Hz{' (not written)' if was.assumed else ''}, now {now.rate:g} Hz"
    name = f"sensor {old.name!r}" if old.name else "a sensor"
    sink.report(LIMITED_SENSOR, f"{name}: {', '.join(words)} ({rates})", old.location)


def _change_elements(sensor: Sensor, name: str, change: Callable[[Element], Element]) -> Sensor:
    """The sensor with all of its elements of a name changed."""

    def part(one: Opaque) -> Opaque:
        element = one.element
        return one.copy(element=change(element)) if element and element.name == name else one

    return sensor.copy(opaque=tuple(map(part, sensor.opaque)))


def _shrink_image(camera: Element, most: int) -> Element:
    """The camera with an image of at most so many pixels, of about the same shape."""
    image = camera.find("image") or Element(name="image")
    width, height = image_size(image)
    if width * height <= most:
        return camera
    factor = math.sqrt(most / (width * height))
    wide, high = max(1, int(width * factor)), max(1, int(height * factor))
    wide, high = (min(wide, most), 1) if high == 1 else (wide, high)
    return _set_child(camera, _set_number(_set_number(image, "width", wide), "height", high))


def _reduce_rays(lidar: Element, most: int) -> Element:
    """The lidar with at most so many rays, in the same proportion along both directions."""
    counts = samples(lidar)
    if math.prod(counts.values()) <= most:
        return lidar
    scan = lidar.find("scan") or Element(name="scan")
    factor = math.sqrt(most / math.prod(counts.values())) if min(counts.values()) > 1 else most / max(counts.values())
    for name, count in counts.items():
        fewer = max(1, int(count * factor)) if count > 1 else count
        if fewer != count:
            scan = _set_child(scan, _set_number(scan.find(name) or Element(name=name), "samples", fewer))
    return _set_child(lidar, scan)


def _map_sensors(document: Document, change: Callable[[Sensor], Sensor]) -> Document:
    """The document with every sensor changed, also those in `<gazebo>`, in the order of `sensors_in`."""

    def changed(node: Node) -> Node:
        if isinstance(node, Sensor):
            return change(node)
        if not isinstance(node, GazeboExtension):
            return node
        content = tuple(_map_in_element(each, node, change) for each in node.content)
        same = all(new is old for new, old in zip(content, node.content, strict=True))
        return node if same else node.copy(content=content)

    return rewrite(document, Node, changed, having=_HAVING)


def _map_in_element(element: Element, around: GazeboExtension, change: Callable[[Sensor], Sensor]) -> Element:
    """The element with the sensors in it changed, itself if it is one."""
    if element.name == "sensor":
        old = sensor_of(element, around.source)
        new = change(old)
        element = element if new is old else _write_changes(element, old, new)
    children = tuple(_map_in_element(each, around, change) for each in element.children)
    same = all(new is old for new, old in zip(children, element.children, strict=True))
    return element if same else element.copy(children=children)


def _write_changes(element: Element, old: Sensor, new: Sensor) -> Element:
    """The element of a sensor, with the differences between the old and the new sensor written into it."""
    if new.update_rate != old.update_rate:
        element = _set_child(element, _child_with_text("update_rate", f"{new.update_rate:.10g}", element))
    changed = {part.element.name: part.element for part in new.opaque if part.element}
    children = tuple(changed.get(child.name, child) for child in element.children)
    return element.copy(children=children)


def _set_number(element: Element, name: str, value: int) -> Element:
    return _set_child(element, _child_with_text(name, str(value), element))


def _child_with_text(name: str, text: str, holder: Element) -> Element:
    """The first child of this name, or a new one, with this text."""
    return (holder.find(name) or Element(name=name)).copy(text=text)


def _set_child(holder: Element, child: Element) -> Element:
    """The element with a child in place of the first one of its name, or at the end."""
    at = next((index for index, each in enumerate(holder.children) if each.name == child.name), None)
    before, after = (holder.children, ()) if at is None else (holder.children[:at], holder.children[at + 1 :])
    return holder.copy(children=(*before, child, *after))
