"""Names for elements that must have one in another version of SDF."""

from pathlib import PurePosixPath
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Document, Light, Plugin, rewrite
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.nodes import reserve_name

_LIGHTS = (1, 6)
"""Since this version a light has a name."""
_PLUGINS = (1, 9)
"""Until this version a plugin has one."""
Named = TypeVar("Named", Light, Plugin)


class NameTheNameless(VersionPass):
    """Name the lights and plugins that the version wants to have a name.

    Changes: 1. from 1.6 on a light is called `light`; 2. until 1.9 a plugin is called like its file. A number makes the
    name unlike others.
    Diagnostics: in the ledger `name-made`.
    """

    name: ClassVar[str] = "name-the-nameless"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with names."""
        taken: set[str] = set()
        if self.number >= _LIGHTS:
            document = rewrite(document, Light, lambda light: _name_light(light, taken, keeper.sink))
        if self.number <= _PLUGINS:
            document = rewrite(document, Plugin, lambda plugin: _name_plugin(plugin, taken, keeper.sink))
        return document


def _name_light(light: Light, taken: set[str], sink: DiagnosticSink) -> Light:
    return light if light.name else _give_name("light", "light", light, taken, sink)


def _name_plugin(plugin: Plugin, taken: set[str], sink: DiagnosticSink) -> Plugin:
    return (
        plugin if plugin.name is not None else _give_name("plugin", plugin_stem(plugin.filename), plugin, taken, sink)
    )


def plugin_stem(filename: str | None) -> str:
    """What a plugin without a name is called: like its file."""
    return PurePosixPath(filename or "").stem.removeprefix("lib") or "plugin"


def _give_name(kind: str, wish: str, node: Named, taken: set[str], sink: DiagnosticSink) -> Named:
    name = reserve_name(wish, taken)
    message = f"a {kind} without a name is called {name!r}"
    sink.account(Fate.APPROXIMATED, rules.NAME_MADE, message, node.location)
    return node.copy(name=name)
