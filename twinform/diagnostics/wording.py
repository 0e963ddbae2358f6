"""Words of messages: numbers of things, such as `1 file` and `2 files`, and texts that are cut where they are long."""


def plural(number: int, word: str) -> str:
    """Write a number of things, such as `1 file` or `2 files`."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def cut(text: str, most: int = 60) -> str:
    """Return a text, or its beginning with dots where it has more letters than that."""
    return text if len(text) <= most else f"{text[: most - 3]}..."
