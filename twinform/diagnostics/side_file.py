"""Files that passes make to lie beside the result of a conversion, such as the configuration of a bridge."""

from typing import NamedTuple


class SideFile(NamedTuple):
    """The path of such a file below the folder of the result, and its text. Whoever writes the result writes it."""

    path: str
    text: str
