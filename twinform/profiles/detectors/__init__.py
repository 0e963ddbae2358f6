"""Detectors: what is fine in general, and not for some consumer. They run where a profile minds them."""

from collections.abc import Callable
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Rule, rules
from twinform.profiles.detectors.attributes import find_empty_attributes
from twinform.profiles.detectors.engines import find_engine_faults
from twinform.profiles.detectors.mesh_formats import find_mesh_formats
from twinform.profiles.detectors.tags import find_lost_tags
from twinform.profiles.subject import ProfiledFile

__all__ = ["DETECTORS", "Detector"]


class Detector(NamedTuple):
    """A function that looks for something, and the rules that it reports."""

    find: Callable[[ProfiledFile, DiagnosticSink], None]
    rules: tuple[Rule, ...]


DETECTORS = (
    Detector(find_mesh_formats, (rules.COLLADA_MESH,)),
    Detector(find_empty_attributes, (rules.EMPTY_ATTRIBUTE,)),
    Detector(find_lost_tags, (rules.RENAMED_COLLISION, rules.UNTAGGED_SHAPE)),
    Detector(
        find_engine_faults,
        (
            rules.BARE_SCRIPT,
            rules.FLAT_COLLISION,
            rules.LATE_SENSOR,
            rules.MODEL_JOINT_END,
            rules.NARROW_VIEW,
            rules.NESTED_IN_ENGINE,
            rules.RARE_JOINT_TYPE,
            rules.THREADLESS_SCREW,
            rules.UNCERTAIN_INERTIA,
            rules.UNUSABLE_AXIS,
            rules.WEIGHTLESS_MOVER,
        ),
    ),
)
"""All detectors."""
