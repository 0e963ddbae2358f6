"""Arithmetic of vectors."""

from twinform.ir.node import Vector3


def dot(a: Vector3, b: Vector3) -> float:
    """The inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector3, b: Vector3) -> Vector3:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a: Vector3, b: Vector3) -> Vector3:
    """From b to a."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def across(axis: Vector3, arm: Vector3) -> Vector3:
    """The part of a vector that is square to a unit vector."""
    along = dot(axis, arm)
    return minus(arm, (axis[0] * along, axis[1] * along, axis[2] * along))
