"""Detectors: what is fine in general, and not for some consumer. They run where a profile minds them."""

from collections.abc import Callable
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Rule
from twinform.diagnostics.rules import portability, portability_engines
from twinform.profiles.detectors.attributes import find_empty_attributes
from twinform.profiles.detectors.engines import find_engine_faults
from twinform.profiles.detectors.meshes import find_mesh_formats
from twinform.profiles.detectors.tags import find_lost_tags
from twinform.profiles.subject import Subject

__all__ = ["DETECTORS", "Detector"]


class Detector(NamedTuple):
    """A function that looks for something, and the rules that it reports."""

    find: Callable[[Subject, DiagnosticSink], None]
    rules: tuple[Rule, ...]


DETECTORS = (
    Detector(find_mesh_formats, (portability.COLLADA_MESH,)),
    Detector(find_empty_attributes, (portability_engines.EMPTY_ATTRIBUTE,)),
    Detector(find_lost_tags, (portability.RENAMED_COLLISION, portability.UNTAGGED_SHAPE)),
    Detector(
        find_engine_faults,
        (
            portability_engines.BARE_SCRIPT,
            portability_engines.FLAT_COLLISION,
            portability_engines.LATE_SENSOR,
            portability_engines.MODEL_JOINT_END,
            portability_engines.NARROW_VIEW,
            portability_engines.NESTED_IN_ENGINE,
            portability_engines.RARE_JOINT_TYPE,
            portability_engines.THREADLESS_SCREW,
            portability_engines.UNCERTAIN_INERTIA,
            portability_engines.UNUSABLE_AXIS,
            portability_engines.WEIGHTLESS_MOVER,
        ),
    ),
)
"""All detectors."""
