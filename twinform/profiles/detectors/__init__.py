"""Detectors: what is fine in general, and not for some consumer. They run where a profile minds them."""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from twinform.diagnostics import DiagnosticSink, Rule
from twinform.diagnostics.rules import portability
from twinform.profiles.detectors.meshes import find_mesh_formats

if TYPE_CHECKING:
    from twinform.profiles.assessment import Subject

__all__ = ["DETECTORS", "Detector"]


class Detector(NamedTuple):
    """A function that looks for something, and the rules that it reports."""

    find: "Callable[[Subject, DiagnosticSink], None]"
    rules: tuple[Rule, ...]


DETECTORS = (Detector(find_mesh_formats, (portability.COLLADA_MESH,)),)
"""All detectors."""
