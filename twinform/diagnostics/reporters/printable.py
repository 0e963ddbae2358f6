"""Text of files that is safe to print: names come from hostile ones."""


def printable(text: str) -> str:
    """The text with an escape for all that a terminal would obey or could not show."""
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in text)
