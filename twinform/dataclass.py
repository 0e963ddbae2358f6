"""`dataclass` as in the standard library, with an initializer that is compiled when the first object is made.

The standard library compiles up to six methods for each class when its module is imported, 0.7 ms in all, and a short
command imports a hundred classes of which it uses some. Here all classes share every method but the initializer.
"""

import dataclasses
from collections.abc import Callable
from dataclasses import MISSING, Field, FrozenInstanceError, field, fields
from inspect import Parameter, Signature
from operator import attrgetter
from typing import Any, TypeVar, cast, dataclass_transform

Kind = TypeVar("Kind", bound=type[Any])


@dataclass_transform(field_specifiers=(field,))
def dataclass(
    *, frozen: bool = False, slots: bool = False, eq: bool = True, kw_only: bool = False
) -> Callable[[Kind], Kind]:
    """Make dataclasses with these options, which mean what they mean in the standard library."""

    def make(kind: Kind) -> Kind:
        made: type[Any] = dataclasses.dataclass(init=False, repr=False, eq=False, slots=slots, kw_only=kw_only)(kind)
        methods: dict[str, Any] = {"__init__": _first_call(made, frozen=frozen), "__repr__": _shown}
        methods["__signature__"] = LazySignature(attrgetter("init"))
        if eq:
            methods |= {"__eq__": _equal, "__hash__": _hashed if frozen else None}
        if frozen:
            methods |= {"__setattr__": _refuse_value, "__delattr__": _refuse_deletion}
        if frozen and slots:
            methods |= {"__getstate__": _state, "__setstate__": _restore}
        for name, method in methods.items():
            # Python itself writes `__hash__ = None` into a class that defines `__eq__` alone
            if vars(made).get(name) is None:
                setattr(made, name, method)
        compared = [each.name for each in fields(made) if each.compare]
        made.__compared__ = attrgetter(*compared or ("__class__",))
        return cast("Kind", made)

    return make


class LazySignature:
    """The signature of a class, which is made when somebody asks for it; `is_shown` says of which fields."""

    def __init__(self, is_shown: Callable[[Field[Any]], bool]) -> None:
        self._is_shown = is_shown

    def __get__(self, instance: object, kind: type[Any]) -> Signature:
        return Signature([_parameter(each) for each in sorted(fields(kind), key=_is_named) if self._is_shown(each)])


def _parameter(each: Field[Any]) -> Parameter:
    default = each.default if each.default_factory is MISSING else each.default_factory
    place = Parameter.KEYWORD_ONLY if each.kw_only else Parameter.POSITIONAL_OR_KEYWORD
    return Parameter(each.name, place, default=Parameter.empty if default is MISSING else default, annotation=each.type)


def _is_named(each: Field[Any]) -> bool:
    return each.kw_only is True


def _first_call(kind: type[Any], frozen: bool) -> Callable[..., None]:
    """An initializer that compiles the real one and steps aside for it."""

    def __init__(self: Any, /, *arguments: Any, **values: Any) -> None:  # noqa: N807 - what it is called in a traceback
        kind.__init__ = compiled = _initializer(kind, frozen=frozen)
        compiled(self, *arguments, **values)

    return __init__


def _initializer(kind: type[Any], *, frozen: bool) -> Callable[..., None]:
    """Compile the initializer of a class: one parameter for each field, in the order of the standard library."""
    scope: dict[str, Any] = {"store": object.__setattr__, "MISSING": MISSING}
    positional, by_keyword, lines = ["self"], list[str](), list[str]()
    for each in fields(kind):
        name, value, parameter = each.name, each.name, each.name
        if each.default_factory is not MISSING:
            scope[f"new_{name}"] = each.default_factory
            value = f"new_{name}() if {name} is MISSING else {name}" if each.init else f"new_{name}()"
            parameter = f"{name}=MISSING"
        elif each.default is not MISSING:
            scope[f"default_{name}"] = each.default
            parameter = f"{name}=default_{name}"
        if each.init:
            (by_keyword if each.kw_only else positional).append(parameter)
        elif each.default is not MISSING:
            value = f"default_{name}"
        elif value == name:
            continue  # nobody gives it a value here
        lines.append(f"store(self, {name!r}, {value})" if frozen else f"self.{name} = {value}")
    if hasattr(kind, "__post_init__"):
        lines.append("self.__post_init__()")
    head = ", ".join([*positional, *(["*", *by_keyword] if by_keyword else [])])
    exec("\n    ".join([f"def __init__({head}):", *(lines or ["pass"])]), scope)  # noqa: S102 - our field names, as in `dataclasses`
    made = scope["__init__"]
    made.__qualname__ = f"{kind.__qualname__}.__init__"
    return made


def _shown(self: Any) -> str:
    shown = ", ".join(f"{each.name}={getattr(self, each.name)!r}" for each in fields(self) if each.repr)
    return f"{type(self).__qualname__}({shown})"


def _equal(self: Any, other: object) -> bool:
    return self.__compared__(self) == self.__compared__(other) if other.__class__ is self.__class__ else NotImplemented


def _hashed(self: Any) -> int:
    return hash(self.__compared__(self))


def _refuse_value(self: object, name: str, value: object) -> None:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _refuse_deletion(self: object, name: str) -> None:
    raise FrozenInstanceError(f"cannot delete field {name!r}")


def _state(self: Any) -> list[Any]:
    return [getattr(self, each.name) for each in fields(self)]


def _restore(self: Any, values: list[Any]) -> None:
    for each, value in zip(fields(self), values, strict=True):
        object.__setattr__(self, each.name, value)
