"""What a sensor of SDF becomes in MJCF: what stands in the body, and the readings; its noise."""

from collections.abc import Iterable
from typing import NamedTuple

from twinform.ir import Element, Sensor
from twinform.passes.legalise.to_mjcf.elements import Value, make_element
from twinform.passes.legalise.to_mjcf.said_parts import child_number, child_text, untyped

AXES = ("x", "y", "z")
_BESIDE = ("mean", "bias_mean", "bias_stddev", "dynamic_bias_stddev", "dynamic_bias_correlation_time", "precision")
"""What SDF has of a noise beside its standard deviation."""


class SensorParts(NamedTuple):
    """What a sensor becomes: sites and cameras of its body, and elements of the section `sensor`."""

    in_body: list[Element]
    readings: list[Element]


def reading(kind: str, name: str | None, noise: float | None = None, **target: Value) -> Element:
    """An element of the section `sensor`: one quantity, of a site, a camera or another thing."""
    return make_element(kind, [("name", name), *target.items(), ("noise", noise)])


def common_noise(sensor: Sensor, *groups: str) -> float | None:
    """The standard deviation of the noise of all axes below elements such as `imu` and `linear_acceleration`.

    MJCF has one number for a whole reading, so that there is none where axes differ or a bias is written.
    """
    outer = untyped(sensor, groups[0])
    for each in groups[1:]:
        outer = outer.find(each) if outer is not None else None
    if outer is None:
        return None
    noises = [axis.find("noise") if (axis := outer.find(each)) is not None else None for each in AXES]
    return single_noise(noises)


def single_noise(noises: Iterable[Element | None]) -> float | None:
    """The standard deviation that all of these noises have; None where they differ, or are more than that."""
    found = {_deviation(each) for each in noises}
    return found.pop() if len(found) == 1 else None


def _deviation(noise: Element | None) -> float | None:
    if noise is None or (noise.get("type") or child_text(noise, "type")) != "gaussian":
        return None
    if any(child_number(noise, each, default=0.0) for each in _BESIDE):
        return None
    return child_number(noise, "stddev", default=0.0)
