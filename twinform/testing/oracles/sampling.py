"""Where the joints stand when two models are compared: the same for a name in every engine and every file."""

import zlib

import numpy as np


def position(joint: str, number: int) -> float:
    """The position in rad or m of a joint in the sample of a number; in the first, all are at zero.

    By name only: a limit that differs is one finding, not another position of the whole robot.
    """
    return 0.0 if number == 0 else spread(f"{joint}/{number}")


def spread(name: str) -> float:
    """A number from -1 to 1 that belongs to a name."""
    return 2 * float(np.random.default_rng(zlib.crc32(name.encode())).uniform()) - 1
