"""Lazy attributes of packages (PEP 562): a name is imported from its module when it is first asked for."""

import sys
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


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
