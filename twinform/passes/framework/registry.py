"""Registry of installed passes, found by entry points, the built-in ones too."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from twinform.passes.framework.base import Pass

GROUP = "twinform.passes"
OWN = "twinform"
"""The distribution that brings the built-in passes."""


class RegistryError(Exception):
    """The installed passes contradict each other or themselves; the message names the package to correct."""


class UnknownPassError(LookupError):
    """No installed pass has this name."""


@dataclass(frozen=True, slots=True)
class Registered:
    """A pass that is installed, perhaps not imported yet. `owner` is the distribution that brings it."""

    name: str
    owner: str
    entry: EntryPoint

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
    return collect(entry_points(group=GROUP))


def collect(entries: Iterable[EntryPoint]) -> dict[str, Registered]:
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


def _registered(entry: EntryPoint) -> Registered:
    return Registered(entry.name, entry.dist.name if entry.dist else "an unknown distribution", entry)


def find_pass(name: str) -> type[Pass]:
    """The class of an installed pass.

    Raises:
        UnknownPassError: there is none of this name.
        RegistryError: it is installed, but not as it should be.
    """
    found = registered_passes().get(name)
    if found is None:
        raise UnknownPassError(name)
    return found.load()
