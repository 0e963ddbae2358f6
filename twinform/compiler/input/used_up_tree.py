"""Trees of large files are freed while they are read, so that a tree and its document are never in memory together."""

import ctypes
import sys
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any, cast

from twinform.schemas import XmlElement

LARGE = 16 * 2**20
"""The size of a text, in bytes, from which on its tree is worth it."""
_HOLDERS = frozenset({"world", "model"})
"""Elements that may hold most of a file."""
_NAMED = frozenset({"link", "joint"})
"""Elements that are most of a file. All of them have names, so that no path counts them."""
_MANY = 4096
"""After so many parts memory is returned to the system."""


def used_up(root: XmlElement) -> XmlElement:
    """The root of a tree for one reader: links and joints are taken out of it once the reader has gone on."""
    return cast("XmlElement", _UsedUp(root))


class _UsedUp:
    """An element that loses its links and joints as they are read."""

    def __init__(self, element: XmlElement) -> None:
        self._element = element

    def __getattr__(self, name: str) -> Any:
        return getattr(self._element, name)

    def __len__(self) -> int:
        return len(self._element)

    def __iter__(self) -> Iterator[XmlElement]:
        for number, child in enumerate(self._element, 1):
            yield used_up(child) if child.tag in _HOLDERS else child
            if child.tag in _NAMED:
                # Per link of a generated robot, the tree takes 14 kB as URDF and 18 kB as SDF, and
                # the document 10 kB. Emptying links instead of removing them freed half as much,
                # since what stays of each pins its page. 100,000 links now take 2.0 GB at most to
                # become SDF, and 2.3 GB to become URDF.
                self._element.remove(child)
            if number % _MANY == 0:
                return_memory()


def return_memory() -> None:
    """Give what libxml2 has freed back to the system.

    The allocator of the C library keeps it for itself otherwise, and Python takes memory for its objects elsewhere.
    """
    trim = _trimmer()
    if trim is not None:
        trim(0)


@cache
def _trimmer() -> Callable[[int], int] | None:
    """The function of glibc; other libraries have none."""
    return getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None
