"""The `reference` of a mimic, which URDF folds into the offset."""

import math

from twinform.ir import Axis, Joint
from twinform.ir.defaults import multiplier
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.joint_words import MIMIC


def with_reference(joint: Joint) -> Joint | None:
    """The joint whose mimic has the annotated `reference`; None where there is no mimic, or the text is no number.

    multiplier (leader - reference) + offset is what URDF writes as multiplier leader + offset.
    """
    found = find_annotation(joint, MIMIC)
    if found is None:
        return joint
    axis: Axis | None = joint.axis
    reference = _number(found.get("reference"))
    if axis is None or axis.mimic is None or reference is None:
        return None
    factor = multiplier(axis.mimic)
    offset = (axis.mimic.offset or 0.0) + factor * reference if reference else axis.mimic.offset
    mimic = axis.mimic.copy(reference=reference, offset=offset or None)
    made: Axis = axis.copy(mimic=mimic)
    return without_annotation(joint, MIMIC).copy(axis=made)


def _number(text: str | None) -> float | None:
    try:
        number = float(text or "")
    except ValueError:
        return None
    return number if math.isfinite(number) else None
