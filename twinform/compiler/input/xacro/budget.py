"""Resource budget of an expression: steps, and the sizes of numbers, texts and collections.

Steps are counted for all expressions of a file together, and what makes something large pays for its size. So nothing
that is built from small parts, such as a power of a power or a list of lists of itself, gets far.
"""

from collections.abc import Sized

MOST_STEPS = 2_000_000
"""For one file. The largest real one that we know, of 1,201 links, takes 140,000."""
LONGEST_TEXT = 1_000_000
"""In characters: of one value, and of everything inside a collection."""
MOST_ITEMS = 100_000
"""In one collection."""
# A budget of steps alone does not hold: one step can be `9**9**9`. What could be too large is
# refused before it is made.
MOST_BITS = 1024
"""Of an integer: as many as the largest floating point number has."""
LARGEST_OUTPUT = 64 * 2**20
"""Characters of all texts that have something evaluated in them."""
CHARACTERS_A_STEP = 64
ITEMS_A_STEP = 4


class ExcessError(Exception):
    """An expression asks for more than any robot needs."""


class Budget:
    """What the expressions of a file may still use."""

    def __init__(self, steps: int = MOST_STEPS, output: int = LARGEST_OUTPUT) -> None:
        self.steps = steps
        self.output = output

    def spend(self, steps: int = 1) -> None:
        """Take steps away.

        Raises:
            ExcessError: there are none left.
        """
        self.steps -= steps
        if self.steps < 0:
            raise ExcessError(f"the expressions of the file need more than {MOST_STEPS:,} steps")

    def write(self, text: str) -> str:
        """The text, taken from what may be written.

        Raises:
            ExcessError: that is all used up.
        """
        self.output -= len(text)
        if self.output < 0:
            raise ExcessError(f"the file expands to more than {LARGEST_OUTPUT:,} characters")
        return text

    def pay(self, value: object) -> None:
        """Take steps for a value that was made, by its size.

        Raises:
            ExcessError: it is too large, or too many were made.
        """
        steps = 1
        if isinstance(value, str):
            require_length(len(value))
            steps += len(value) // CHARACTERS_A_STEP
        elif isinstance(value, int):
            require_bits(value.bit_length())
        elif not isinstance(value, float) and isinstance(value, Sized):
            require_items(len(value))
            steps += len(value) // ITEMS_A_STEP
        self.spend(steps)


def require_bits(bits: float) -> None:
    """Refuse integers of more bits."""
    if bits > MOST_BITS:
        raise ExcessError("an expression makes an integer beyond the largest floating point number")


def require_length(characters: float) -> None:
    """Refuse texts of more characters."""
    if characters > LONGEST_TEXT:
        raise ExcessError(f"an expression makes a text of more than {LONGEST_TEXT:,} characters")


def require_items(items: float) -> None:
    """Refuse collections of more items."""
    if items > MOST_ITEMS:
        raise ExcessError(f"an expression makes a collection of more than {MOST_ITEMS:,} items")
