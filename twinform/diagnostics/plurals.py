"""Numbers of things in messages, such as `1 file` and `2 files`."""


def plural(number: int, word: str) -> str:
    """Write a number of things, such as `1 file` or `2 files`."""
    return f"{number} {word}{'' if number == 1 else 's'}"
