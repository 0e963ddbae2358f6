"""Lower the update rates, image sizes and numbers of rays of sensors, one by one or to a budget of all."""

import math
from collections.abc import Callable
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import LIMITED_SENSOR, SENSOR_OVER_BUDGET
from twinform.ir import Document, Element, Opaque, Sensor
from twinform.passes.analyses.sensor_costs import SensorCost, image_size, images, samples, sensor_cost, sensors_in
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.patterns import EVERY, matches, with_such_a_name
from twinform.passes.meshes.map_sensors import map_sensors, with_child, with_text

_BUDGETS = ("pixels", "rays")
_FINE = 1000
"""Rates are written to a thousandth of a Hz."""


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
            return self._limited(sensor) if matches(sensor.name, self.sensors) and _has_cost(sensor) else sensor

        limited = map_sensors(document, limit)
        factors = {name: self._factor(limited, name, sink) for name in _BUDGETS}

        def slow(sensor: Sensor) -> Sensor:
            old = next(olds)
            made = self._slowed(sensor, factors) if matches(sensor.name, self.sensors) else sensor
            if sensor_cost(made) != sensor_cost(old):
                _report(old, made, sink)
            return made

        return map_sensors(limited, slow)

    def _limited(self, sensor: Sensor) -> Sensor:
        made = sensor
        if self.max_pixels is not None and any(width * height > self.max_pixels for width, height in images(sensor)):
            made = _with_parts(made, "camera", lambda element: _smaller_image(element, self.max_pixels or 1))
        if self.max_rays is not None and sensor_cost(sensor).rays > self.max_rays:
            for name in ("ray", "lidar"):
                made = _with_parts(made, name, lambda element: _fewer_rays(element, self.max_rays or 1))
        cost = sensor_cost(sensor)
        if self.max_rate is not None and cost.rate > self.max_rate:
            made = made.copy(update_rate=self.max_rate)
        return made

    def _factor(self, document: Document, kind: str, sink: DiagnosticSink) -> float:
        """By how much the rates of what makes pixels or rays are lowered."""
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
        left = sum(_slower(cost.rate, factor, self.min_rate) * getattr(cost, kind) for cost in costs)
        if left > budget * (1 + 1e-9):
            message = f"sensors make {left:,.0f} {kind} a second at {self.min_rate:g} Hz, and are to make {budget:,.0f}"
            sink.report(SENSOR_OVER_BUDGET, message, document.location, found=f"{left:.0f}", expected=f"{budget:g}")
        return factor

    def _slowed(self, sensor: Sensor, factors: dict[str, float]) -> Sensor:
        cost = sensor_cost(sensor)
        factor = min((factors[kind] for kind in _BUDGETS if getattr(cost, kind)), default=1.0)
        rate = _slower(cost.rate, factor, self.min_rate)
        return sensor if factor >= 1 or rate >= cost.rate else sensor.copy(update_rate=rate)


def _slower(rate: float, factor: float, least: float) -> float:
    return rate if factor >= 1 else max(math.floor(rate * factor * _FINE) / _FINE, min(rate, least))


def _per_second(cost: SensorCost, kind: str) -> float:
    return cost.pixels_per_second if kind == "pixels" else cost.rays_per_second


def _has_cost(sensor: Sensor) -> bool:
    cost = sensor_cost(sensor)
    return bool(cost.pixels or cost.rays)


def _report(old: Sensor, new: Sensor, sink: DiagnosticSink) -> None:
    was, now = sensor_cost(old), sensor_cost(new)
    words = [
        f"{_per_second(was, kind):,.0f} {kind} a second became {_per_second(now, kind):,.0f}"
        for kind in _BUDGETS
        if getattr(was, kind)
    ]
    rates = f"{was.rate:g} Hz{' (not written)' if was.assumed else ''}, now {now.rate:g} Hz"
    name = f"sensor {old.name!r}" if old.name else "a sensor"
    sink.report(LIMITED_SENSOR, f"{name}: {', '.join(words)} ({rates})", old.location)


def _with_parts(sensor: Sensor, name: str, change: Callable[[Element], Element]) -> Sensor:
    """The sensor with each of its elements of a name changed."""

    def part(one: Opaque) -> Opaque:
        element = one.element
        return one.copy(element=change(element)) if element and element.name == name else one

    return sensor.copy(opaque=tuple(map(part, sensor.opaque)))


def _smaller_image(camera: Element, most: int) -> Element:
    image = camera.find("image") or Element(name="image")
    width, height = image_size(image)
    if width * height <= most:
        return camera
    factor = math.sqrt(most / (width * height))
    wide, high = max(1, int(width * factor)), max(1, int(height * factor))
    wide, high = (min(wide, most), 1) if high == 1 else (wide, high)
    return with_child(camera, _with_number(_with_number(image, "width", wide), "height", high))


def _fewer_rays(lidar: Element, most: int) -> Element:
    counts = samples(lidar)
    if math.prod(counts.values()) <= most:
        return lidar
    scan = lidar.find("scan") or Element(name="scan")
    factor = math.sqrt(most / math.prod(counts.values())) if min(counts.values()) > 1 else most / max(counts.values())
    for name, count in counts.items():
        fewer = max(1, int(count * factor)) if count > 1 else count
        if fewer != count:
            scan = with_child(scan, _with_number(scan.find(name) or Element(name=name), "samples", fewer))
    return with_child(lidar, scan)


def _with_number(element: Element, name: str, value: int) -> Element:
    return with_child(element, with_text(name, str(value), element))
