"""Our dataclasses behave as those of the standard library, which made the same classes here."""

import copy
import dataclasses
import inspect
import pickle
from collections.abc import Callable
from dataclasses import field
from typing import Any, cast

import pytest

from twinform.dataclass import dataclass

_OPTIONS: list[dict[str, Any]] = [
    {},
    {"frozen": True},
    {"slots": True},
    {"frozen": True, "slots": True},
    {"slots": True, "eq": False},
    {"frozen": True, "slots": True, "eq": False},
    {"frozen": True, "slots": True, "kw_only": True},
]
_VALUES: list[dict[str, Any]] = [{"name": "a"}, {"name": "a", "size": 1, "tags": ("x",), "seen": 2}, {}, {"nam": 1}]


def _classes(make: Callable[..., Any], options: dict[str, Any]) -> tuple[Any, Any]:
    """A class and one that is derived from it, made by a decorator."""

    class Part:
        """A part."""

        name: str
        size: int = 3
        tags: tuple[str, ...] = field(default_factory=tuple[str, ...])
        seen: int = field(default=0, compare=False, repr=False)
        notes: tuple[int, ...] = field(default_factory=tuple[int, ...], init=False)
        fixed: int = field(default=7, init=False)

    part = make(**options)(Part)

    class Screw(part):
        """A part with a thread."""

        thread: float = field(default=1.0, kw_only=True)
        size: int = 5

        def __post_init__(self) -> None:
            if self.size < 0:
                raise ValueError("too small")

    return part, make(**options)(Screw)


def _answer(call: Callable[[], Any]) -> object:
    """What a call returns, or its error: the class of the exception and its message."""
    try:
        return call()
    except (TypeError, ValueError, AttributeError) as error:
        return type(error), str(error)


def _told(kind: Any, values: dict[str, Any]) -> object:
    """Everything that can be asked of an object without naming its class."""
    one: Any = _answer(lambda: kind(**values))
    if type(one) is tuple:
        return cast("object", one)  # an error
    other = kind(**values | {"seen": 9})

    def changed(**values: object) -> object:
        return dataclasses.replace(one, **values)

    return {
        "text": repr(one),
        "values": dataclasses.asdict(one),
        "replaced": repr(_answer(lambda: changed(size=8))),
        "refused": _answer(lambda: changed(size=-1)) if kind.__name__ == "Screw" else None,
        "copied": repr(copy.copy(one)),
        "equal": (one == other, one == kind(**values | {"size": 99}), one == 3),
        "hash": _answer(lambda: hash(one) == hash(other)),
        "set": _answer(lambda: setattr(one, "size", 4)),
        "deleted": _answer(lambda: delattr(one, "size")),
        "set unknown": isinstance(_answer(lambda: setattr(one, "unknown", 4)), tuple),
        "matched by": kind.__match_args__,
    }


@pytest.mark.parametrize("values", _VALUES, ids=str)
@pytest.mark.parametrize("options", _OPTIONS, ids=str)
def test_objects_behave_as_those_of_the_standard_library(options: dict[str, Any], values: dict[str, Any]) -> None:
    for ours, theirs in zip(_classes(dataclass, options), _classes(dataclasses.dataclass, options), strict=True):
        assert _told(ours, values) == _told(theirs, values)
        assert list(inspect.signature(ours).parameters) == list(inspect.signature(theirs).parameters)


def test_written_methods_stay() -> None:
    @dataclass(frozen=True, slots=True)
    class Own:
        """A class with methods of its own."""

        size: int

        def __repr__(self) -> str:
            return "own"

        def __hash__(self) -> int:
            return 7

        def __eq__(self, other: object) -> bool:
            return True

    assert (repr(Own(1)), Own(1) == 2, hash(Own(1))) == ("own", True, 7)


@dataclass(frozen=True, slots=True)
class Kept:
    """A class that pickle finds by its name."""

    size: int
    name: str = ""


def test_frozen_objects_with_slots_can_be_pickled() -> None:
    assert pickle.loads(pickle.dumps(Kept(2, "a"))) == Kept(2, "a")
