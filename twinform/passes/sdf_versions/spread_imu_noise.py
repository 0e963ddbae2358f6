"""IMU noise, which is on each axis since SDF 1.6."""

from functools import partial
from typing import ClassVar

from twinform.ir import Document, Element, Sensor
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import (
    VersionPass,
    has_element,
    map_elements_named,
    put_element,
    take_element,
)

_MEASURED = {"rate": "angular_velocity", "accel": "linear_acceleration"}
_NUMBERS = ("mean", "stddev", "bias_mean", "bias_stddev")
_ANNOTATION = f"{{{NAMESPACE}}}noise"
"""In an IMU whose noise was written once for all axes: `<tf:noise/>`."""
# The type of noise of an IMU that names none. On an axis, the default is no noise.
_DEFAULT = "gaussian"


class SpreadImuNoise(VersionPass):
    """Write the noise of an IMU on each of its axes.

    Changes: `imu/noise`, whose `rate` becomes the noise of `angular_velocity` and whose `accel` that of
    `linear_acceleration`. With `annotate`, an annotation records it for the conversion back.
    Never touches: an axis that has its noise already.
    """

    name: ClassVar[str] = "spread-imu-noise"
    annotate: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with noise on axes."""
        return map_elements_named("imu", document, Sensor, partial(_spread, self.annotate))


class GatherImuNoise(VersionPass):
    """Write the noise of an IMU once for all of its axes, as SDF did before 1.6.

    Changes: where the three axes of `angular_velocity`, and those of `linear_acceleration`, have one noise and say
    nothing else, it becomes `imu/noise`. With `annotated`, only where it was written so before.
    Never touches: axes that differ, or noises of two types.
    """

    name: ClassVar[str] = "gather-imu-noise"
    annotated: bool = False

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with noise once for each IMU."""

        def gather(imu: Element) -> Element:
            return imu if self.annotated and imu.find(_ANNOTATION) is None else _gather(imu)

        return map_elements_named("imu", document, Sensor, gather)


def _gather(element: Element) -> Element:
    """An `<imu>` with its noise written once; unchanged where its axes differ."""
    noises = {old: _common_noise(element, new) for old, new in _MEASURED.items()}
    types = {noise.get("type") for noise in noises.values() if noise is not None}
    # The old element has one type for both measurements, and one set of numbers for the three axes
    # of each.
    if None in noises.values() or len(types) != 1:
        return element
    kept = tuple(child for child in element.children if child.name not in {*_MEASURED.values(), _ANNOTATION})
    numbers = tuple(
        Element.unchecked(name=old, children=noise.children)
        for old, noise in noises.items()
        if noise and noise.children
    )
    type_ = Element.unchecked(name="type", text=types.pop())
    return element.copy(children=(*kept, Element.unchecked(name="noise", children=(type_, *numbers))))


def _common_noise(imu: Element, measured: str) -> Element | None:
    """The noise that the three axes of a measurement have in common, if they say nothing else."""
    holder = imu.find(measured)
    axes = [holder.find(axis) for axis in ("x", "y", "z")] if holder else []
    first = axes[0].find("noise") if axes and axes[0] else None
    if holder is None or first is None or len(holder.children) != len(axes):
        return None
    same = all(axis is not None and axis.children == (first,) and not axis.attributes for axis in axes)
    plain = all(child.name in _NUMBERS and not child.children for child in first.children)
    return first if same and plain and [name for name, _ in first.attributes] == ["type"] else None


def _spread(annotate: bool, element: Element) -> Element:
    """An `<imu>` with the noise that it has once on each of its axes."""
    imu, noise = take_element(element, ("noise",))
    if noise is None:
        return element
    kind = noise.find("type")
    type_ = (kind.text if kind else None) or _DEFAULT
    for old, new in _MEASURED.items():
        numbers = noise.find(old) or Element.unchecked(name=old)
        children = tuple(child for child in numbers.children if child.name in _NUMBERS)
        made = Element.unchecked(name="noise", attributes=(("type", type_),), children=children)
        for axis in ("x", "y", "z"):
            # Files with the syntax of several versions have both; the noise of an axis is the one
            # that readers of 1.6 and newer take.
            if not has_element(imu, (new, axis, "noise")):
                imu = put_element(imu, (new, axis), made)
    return imu.copy(children=(Element.unchecked(name=_ANNOTATION), *imu.children)) if annotate else imu
