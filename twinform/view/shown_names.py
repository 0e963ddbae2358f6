"""Names as they are shown: hostile ones do nothing, and long ones fit."""

_LONGEST = 80


def shortened(name: str) -> str:
    """A name as it fits into a line, without what would break it."""
    plain = "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in name)
    return plain if len(plain) <= _LONGEST else f"{plain[: _LONGEST - 1]}\N{HORIZONTAL ELLIPSIS}"
