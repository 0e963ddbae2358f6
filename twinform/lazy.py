"""What is made when it is first asked for: attributes of packages (PEP 562), and regular expressions."""

import sys
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from re import Pattern
    from typing import Any, AnyStr


def lazy_attributes(package: str, modules: "Mapping[str, str]") -> "Callable[[str], object]":
    """The `__getattr__` of a package; `modules` has the names, with blanks between them, that come from each module.

    A type checker does not see it: the package imports the same names under `TYPE_CHECKING`. A test compares the two.
    """
    # `check` must not pay for importing all passes, nor a conversion for the SDF version steps that
    # it does not take.
    homes = {name: module for module, names in modules.items() for name in names.split()}

    def get(name: str) -> object:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(homes[name]), name)
        # The next access finds the name in the package itself and does not come here again.
        setattr(sys.modules[package], name, value)
        return value

    return get


def lazy_pattern(text: "AnyStr", flags: int = 0) -> "Pattern[AnyStr]":
    """A regular expression that is compiled when it is first used: a short command uses few of those it imports."""
    return _LazyPattern(text, flags)  # pyright: ignore[reportReturnType] - it has all attributes of one


class _LazyPattern:
    def __init__(self, text: "Any", flags: int) -> None:
        self._written, self.pattern = (text, flags), text

    def __getattr__(self, name: str) -> object:
        from re import compile as compiled  # noqa: PLC0415 - `import twinform` needs none

        value = getattr(compiled(*self._written), name)
        # The next access finds the method in the object itself and does not come here again.
        setattr(self, name, value)
        return value
