"""The principal moments of an inertia matrix."""

import math

Symmetric = tuple[float, float, float, float, float, float]
"""xx, yy, zz, xy, xz, yz of a symmetric 3x3 matrix."""

# The three pairs of axes: where their own two elements are in the tuple, the one off the diagonal, and the two that
# couple the pair with the third axis.
_PLANES = ((0, 1, 3, 4, 5), (0, 2, 4, 3, 5), (1, 2, 5, 3, 4))
_EPSILON = 2.0**-53
_SWEEPS = 40
"""Five or six are enough; the rest is for matrices whose elements differ by hundreds of orders of magnitude."""


def principal_moments(matrix: Symmetric) -> tuple[float, float, float]:
    """The eigenvalues, smallest first, by Jacobi's rotations: small ones are as exact as large ones.

    All elements have to be finite.
    """
    scale = max(map(abs, matrix))
    if not scale:
        return 0.0, 0.0, 0.0
    entries = [element / scale for element in matrix]  # so that no square overflows
    for _ in range(_SWEEPS):
        turned = [_rotate(entries, *plane) for plane in _PLANES]
        if not any(turned):
            break
    smallest, middle, largest = sorted(element * scale for element in entries[:3])
    return smallest, middle, largest


def _rotate(entries: list[float], first: int, second: int, off: int, with_first: int, with_second: int) -> bool:
    """Turn the two axes so that the element between them becomes zero; false where it is as good as zero already."""
    coupling = entries[off]
    if abs(coupling) <= _EPSILON * math.sqrt(abs(entries[first] * entries[second])):
        return False
    entries[off] = 0.0
    ratio = (entries[second] - entries[first]) / 2 / coupling
    tangent = math.copysign(1.0, ratio) / (abs(ratio) + math.hypot(ratio, 1.0))
    cosine = 1 / math.hypot(tangent, 1.0)
    sine = tangent * cosine
    entries[first] -= tangent * coupling
    entries[second] += tangent * coupling
    one, other = entries[with_first], entries[with_second]
    entries[with_first], entries[with_second] = cosine * one - sine * other, sine * one + cosine * other
    return True
