"""The principal moments of an inertia matrix, and their axes."""

import math

from twinform.ir.transform import common_exponent, times_power

Symmetric = tuple[float, float, float, float, float, float]
"""xx, yy, zz, xy, xz, yz of a symmetric 3x3 matrix."""

# The three pairs of axes: where their own two elements are in the tuple, the one off the diagonal, and the two that
# couple the pair with the third axis.
_PLANES = ((0, 1, 3, 4, 5), (0, 2, 4, 3, 5), (1, 2, 5, 3, 4))
_EPSILON = 2.0**-53
# Five or six are enough. The rest is for matrices whose elements differ by hundreds of orders of
# magnitude.
_SWEEPS = 40


Axes = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]
"""Three unit vectors at right angles."""


def principal_moments(matrix: Symmetric) -> tuple[float, float, float]:
    """Return the eigenvalues, smallest first, by Jacobi's method: small ones are as exact as large ones.

    All elements have to be finite; an eigenvalue that no double holds is infinite.
    """
    exponent = common_exponent(matrix)
    entries = [*times_each(matrix, -exponent)]
    for _ in range(_SWEEPS):
        turned = [_rotate(entries, *plane) for plane in _PLANES]
        if not any(turned):
            break
    smallest, middle, largest = sorted(times_power(element, exponent) for element in entries[:3])
    return smallest, middle, largest


def relative_moments(matrix: Symmetric) -> tuple[float, float, float]:
    """Return the eigenvalues over one power of two, each below three, so that not even their sum overflows."""
    return principal_moments(times_each(matrix, -common_exponent(matrix)))


def times_each(matrix: Symmetric, exponent: int) -> Symmetric:
    """Multiply a matrix by a power of two; elements beyond the range of doubles become infinite."""
    xx, yy, zz, xy, xz, yz = (times_power(element, exponent) for element in matrix)
    return xx, yy, zz, xy, xz, yz


def principal_axes(matrix: Symmetric) -> tuple[tuple[float, float, float], Axes]:
    """Return the eigenvalues with their eigenvectors, in no order; all elements must be finite."""
    exponent = common_exponent(matrix)
    entries = [*times_each(matrix, -exponent)]
    axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    for _ in range(_SWEEPS):
        turns = [(plane[:2], _rotate(entries, *plane)) for plane in _PLANES]
        for (first, second), turn in turns:
            if turn:
                _turn_axes(axes[first], axes[second], *turn)
        if not any(turn for _, turn in turns):
            break
    one, two, three = ((axis[0], axis[1], axis[2]) for axis in axes)
    first, second, third = (times_power(element, exponent) for element in entries[:3])
    return (first, second, third), (one, two, three)


def _turn_axes(one: list[float], other: list[float], cosine: float, sine: float) -> None:
    """Two axes turned as the matrix was."""
    for i in range(3):
        one[i], other[i] = cosine * one[i] - sine * other[i], sine * one[i] + cosine * other[i]


def _rotate(
    entries: list[float], first: int, second: int, off: int, with_first: int, with_second: int
) -> tuple[float, float] | None:
    """Turn the two axes so that the element between them becomes zero; None where it is as good as zero already.

    Gives the cosine and the sine of the angle.
    """
    coupling = entries[off]
    # Relative to both diagonal elements instead of the largest one: this is what keeps small
    # eigenvalues as exact as large ones (Demmel and Veselic, "Jacobi's method is more accurate than
    # QR").
    if abs(coupling) <= _EPSILON * math.sqrt(abs(entries[first])) * math.sqrt(abs(entries[second])):
        return None
    entries[off] = 0.0
    ratio = (entries[second] - entries[first]) / 2 / coupling
    tangent = math.copysign(1.0, ratio) / (abs(ratio) + math.hypot(ratio, 1.0))
    cosine = 1 / math.hypot(tangent, 1.0)
    sine = tangent * cosine
    entries[first] -= tangent * coupling
    entries[second] += tangent * coupling
    one, other = entries[with_first], entries[with_second]
    entries[with_first], entries[with_second] = cosine * one - sine * other, sine * one + cosine * other
    return cosine, sine
