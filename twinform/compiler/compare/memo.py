"""`Memo`: what was made for one reader of a file stands for the next one, where it is made of the same things."""

from collections.abc import Callable, Hashable
from typing import Any, TypeVar

Made = TypeVar("Made")


def _always(_: object) -> bool:
    return True


class Memo:
    """The last result of each kind, with what it was made of."""

    def __init__(self) -> None:
        self._known: dict[Hashable, tuple[object, Any]] = {}

    def once(
        self, key: Hashable, given: object, make: Callable[[], Made], lasts: Callable[[Made], bool] = _always
    ) -> Made:
        """What `make` returns, or what it returned before of equal things, if that `lasts`: depends on nothing else."""
        known = self._known.get(key)
        if known is not None and known[0] == given:
            return known[1]
        made = make()
        if lasts(made):
            self._known[key] = given, made
        return made
