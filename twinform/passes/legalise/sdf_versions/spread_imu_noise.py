"""Since 1.6 an IMU has its noise on each axis."""

from typing import ClassVar

from twinform.ir import Document, Element, Node, Sensor
from twinform.passes.legalise.sdf_versions.base import VersionPass, map_nodes, map_own_elements
from twinform.passes.legalise.sdf_versions.carriers import Keeper
from twinform.passes.legalise.sdf_versions.element_paths import has, put, take

_MEASURED = {"rate": "angular_velocity", "accel": "linear_acceleration"}
_NUMBERS = ("mean", "stddev", "bias_mean", "bias_stddev")
_DEFAULT = "gaussian"
"""The noise of an IMU that does not say of what type it is; on an axis the default is none."""


class SpreadImuNoise(VersionPass):
    """Write the noise of an IMU on each of its axes.

    Changes: `imu/noise`, whose `rate` becomes the noise of `angular_velocity` and whose `accel` that of
    `linear_acceleration`.
    Never touches: an axis that says its noise already.
    """

    name: ClassVar[str] = "spread-imu-noise"

    def change(self, document: Document, keeper: Keeper) -> Document:
        """The document with noise on axes."""
        return map_nodes(document, _sensor)


def _sensor(node: Node) -> Node:
    return map_own_elements(node, _imu) if isinstance(node, Sensor) else node


def _imu(element: Element) -> Element:
    if element.name != "imu":
        return element
    imu, noise = take(element, ("noise",))
    if noise is None:
        return element
    kind = noise.find("type")
    type_ = (kind.text if kind else None) or _DEFAULT
    for old, new in _MEASURED.items():
        numbers = noise.find(old) or Element(name=old)
        children = tuple(child for child in numbers.children if child.name in _NUMBERS)
        made = Element(name="noise", attributes=(("type", type_),), children=children)
        for axis in ("x", "y", "z"):
            if not has(imu, (new, axis, "noise")):
                imu = put(imu, (new, axis), made)
    return imu
