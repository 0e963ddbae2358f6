"""What may go without a name in one version must have one in another."""

from collections.abc import Callable
from pathlib import PurePosixPath
from typing import ClassVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import sdf_versions as rules
from twinform.ir import Document, Light, Node, Plugin
from twinform.passes.legalise.nodes import unique_name
from twinform.passes.legalise.sdf_versions.base import VersionPass, map_nodes
from twinform.passes.legalise.sdf_versions.carriers import Keeper
from twinform.schemas import Version

_LIGHTS = (1, 6)
"""Since this version a light has a name."""
_PLUGINS = (1, 9)
"""Until this version a plugin has one."""


class NameTheNameless(VersionPass):
    """Name the lights and plugins that the version wants to have a name.

    Changes: 1. from 1.6 on a light is called `light`; 2. until 1.9 a plugin is called like its file. A number makes the
    name unlike others.
    Diagnostics: in the ledger `name-made`.
    """

    name: ClassVar[str] = "name-the-nameless"

    def change(self, document: Document, keeper: Keeper) -> Document:
        """The document with names."""
        return map_nodes(document, _namer(self.number, keeper.notes))


def _namer(version: Version, notes: Notes) -> Callable[[Node], Node]:
    taken: set[str] = set()

    def name(node: Node) -> Node:
        if isinstance(node, Light) and not node.name and version >= _LIGHTS:
            return _called("light", "light", node, taken, notes)
        if isinstance(node, Plugin) and node.name is None and version <= _PLUGINS:
            return _called("plugin", plugin_stem(node.filename), node, taken, notes)
        return node

    return name


def plugin_stem(filename: str | None) -> str:
    """What a plugin without a name is called: like its file."""
    return PurePosixPath(filename or "").stem.removeprefix("lib") or "plugin"


def _called(kind: str, wish: str, node: Node, taken: set[str], notes: Notes) -> Node:
    name = unique_name(wish, taken)
    taken.add(name)
    message = f"a {kind} without a name is called {name!r}"
    notes.account(Fate.APPROXIMATED, rules.NAME_MADE, message, node.location)
    return node.model_copy(update={"name": name})
