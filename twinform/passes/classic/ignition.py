"""Renaming of Ignition plugins and parameters to their Gazebo names."""

import re

from twinform.ir import Element, Plugin
from twinform.passes.plugins.catalog import is_ignition_name, modern_class, modern_file
from twinform.passes.plugins.catalog_types import Release

# Fortress, in which the names of Ignition are the ones in use.
_NATIVE = 6
_ELEMENTS = {"ignition-gui": "gz-gui", "ignition_frame_id": "gz_frame_id"}
# Only where the word names a library or a message. `ignition` alone may be a topic or a model of
# the author.
_WORDS = re.compile(r"\bignition(?=\.msgs\.|-physics-|-rendering-|-gui\b)")
_CLASSES = re.compile(r"\bignition::(?:gazebo|sim)::")


def modern_plugin(plugin: Plugin, release: Release) -> Plugin:
    """The plugin in the names of now; the same one where it has them, or where the release has the old ones."""
    if release.sim <= _NATIVE:
        return plugin
    filename, name = plugin.filename or "", plugin.name
    changed = Plugin(
        filename=modern_file(filename) if is_ignition_name(filename) else plugin.filename,
        name=modern_class(name) if name and is_ignition_name(name) else name,
        text=plugin.text,
        content=tuple(map(_modern, plugin.content)),
        opaque=plugin.opaque,
        source=plugin.source,
    )
    return plugin if changed == plugin else changed


def _modern(element: Element) -> Element:
    text = _words(element.text) if element.text else element.text
    attributes = tuple((name, _words(value)) for name, value in element.attributes)
    children = tuple(map(_modern, element.children))
    update = {"name": _ELEMENTS.get(element.name, element.name), "text": text, "attributes": attributes}
    changed = element.copy(**{**update, "children": children})
    return element if changed == element else changed


def _words(text: str) -> str:
    return _CLASSES.sub("gz::sim::", _WORDS.sub("gz", text))
