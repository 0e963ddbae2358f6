"""Registry of installed passes, found by entry points.

The built-in passes are registered like all others, and listed in a table besides, so that finding one does not take a
search of every installed package.
"""

from collections.abc import Iterable
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Protocol

from twinform.dataclass import dataclass
from twinform.passes.framework.built_in import BUILT_IN
from twinform.passes.framework.pass_base import Pass

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "twinform.passes"
HOME = f"{GROUP}."
"""The prefix of our modules with passes."""
OWN = "twinform"
"""The distribution of the built-in passes."""


class RegistryError(Exception):
    """The installed passes contradict each other or themselves; the message names the package to correct."""


class UnknownPassError(LookupError):
    """No installed pass has this name."""


class EntryPointLike(Protocol):
    """An entry point: `value` is the module of a class, a colon, and the name of the class."""

    @property
    def value(self) -> str:
        """The text of the entry point."""
        ...

    def load(self) -> object:
        """Import the object that it names."""
        ...


@dataclass(frozen=True, slots=True)
class _BuiltIn:
    """A row of the table of built-in passes."""

    value: str

    def load(self) -> object:
        module, _, name = self.value.partition(":")
        return getattr(import_module(module), name)


@dataclass(frozen=True, slots=True)
class Registered:
    """An installed pass, perhaps not imported yet. `owner` is its distribution."""

    name: str
    owner: str
    entry: EntryPointLike

    def load(self) -> type[Pass]:
        """Import the pass.

        Raises:
            RegistryError: it cannot be imported, is no pass, or calls itself by another name.
        """
        try:
            found: object = self.entry.load()
        except (ImportError, AttributeError) as error:
            raise RegistryError(f"{self.owner} registers {self.name} but it cannot be imported: {error}") from error
        if not (isinstance(found, type) and issubclass(found, Pass)):
            raise RegistryError(f"{self.owner} registers {self.name} but {self.entry.value} is no subclass of Pass")
        if found.name != self.name:
            raise RegistryError(f"{self.owner} registers {self.name} but {self.entry.value} calls itself {found.name}")
        return found


@cache
def registered_passes() -> dict[str, Registered]:
    """Every installed pass by name, sorted; none of them is imported.

    Raises:
        RegistryError: two passes have one name.
    """
    from importlib.metadata import entry_points  # noqa: PLC0415 - few commands look at every package

    return collect(entry_points(group=GROUP))


def collect(entries: "Iterable[EntryPoint]") -> dict[str, Registered]:
    """The passes of these entry points by name, sorted.

    Raises:
        RegistryError: two passes have one name.
    """
    found: dict[str, Registered] = {}
    for each in sorted(map(_registered, entries), key=lambda each: (each.name, each.owner)):
        if each.name in found:
            raise RegistryError(f"{found[each.name].owner} and {each.owner} both register a pass called {each.name}")
        found[each.name] = each
    return found


def _registered(entry: "EntryPoint") -> Registered:
    return Registered(entry.name, entry.dist.name if entry.dist else "an unknown distribution", entry)


def find_pass(name: str) -> type[Pass]:
    """The class of an installed pass. A built-in one is found without a search of other packages.

    Raises:
        UnknownPassError: there is none of this name.
        RegistryError: it is installed, but not as it should be.
    """
    if name in BUILT_IN:
        return Registered(name, OWN, _BuiltIn(HOME + BUILT_IN[name])).load()
    found = registered_passes().get(name)
    if found is None:
        raise UnknownPassError(name)
    return found.load()
