"""Hypothesis strategies for models: valid by construction, and built so that failures shrink to a few links.

A model is drawn as a list of *segments*, each a link with the joint that holds it and a number that picks its parent
among the links before it. Names and parents follow from positions, so that a segment can be taken out without harm.
Arguments are keyword-only and describe valid values; one that no value can satisfy raises `ValueError`.
"""

from twinform.testing.strategies._bodies import geometries, inertials, links
from twinform.testing.strategies._joints import joints
from twinform.testing.strategies._models import robots, sdf_models, worlds
from twinform.testing.strategies._values import numbers, poses, vectors

__all__ = [
    "geometries",
    "inertials",
    "joints",
    "links",
    "numbers",
    "poses",
    "robots",
    "sdf_models",
    "vectors",
    "worlds",
]
