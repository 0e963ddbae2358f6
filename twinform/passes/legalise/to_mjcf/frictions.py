"""Friction of geoms: SDF takes the lesser of two coefficients, and MJCF the greater, or that of the higher priority."""

from collections.abc import Iterable, Mapping

from twinform.ir import Collision

USUAL = 1.0
"""The coefficient of what has none written, in SDF and in MJCF."""


def coefficient(collision: Collision) -> float:
    """The coefficient of sliding friction of a collision."""
    mu = collision.surface.mu if collision.surface is not None else None
    return USUAL if mu is None else mu


def friction_priorities(collisions: Iterable[Collision]) -> Mapping[float, int]:
    """The priority of each coefficient: the less the friction, the higher, so that the lesser of two counts.

    That of the usual one is 0, also against what other files have.
    """
    found = sorted({USUAL, *(coefficient(each) for each in collisions)}, reverse=True)
    usual = found.index(USUAL)
    return {mu: place - usual for place, mu in enumerate(found)}
