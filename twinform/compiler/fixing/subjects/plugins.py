"""Fixes of plugins of Gazebo: names of Ignition, classes that their files do not have, systems that a world lacks."""

import re
from itertools import chain

from lxml import etree

from twinform.compiler.fixing.site import FindingSite, Fixers, unsafe
from twinform.diagnostics import Fix, TextEdit, meant_name, rules
from twinform.passes.plugins.catalog import systems_of_file
from twinform.schemas import XmlElement

_WRITTEN = re.compile(r'<plugin filename="(?P<file>[^"]+)" name="(?P<name>[^"]+)"')


def _ignition(site: FindingSite) -> Fix | None:
    """The names that Gazebo has now, as the finding proposes them."""
    found = _WRITTEN.search(site.finding.help or "")
    if found is None or site.element.tag != "plugin":
        return None
    edits = _called(site, found["file"], found["name"])
    return unsafe(f"Write filename={found['file']!r} name={found['name']!r}", *edits)


def _called(site: FindingSite, file: str, name: str) -> tuple[TextEdit, ...]:
    wanted = {"filename": file, "name": name}
    return tuple(
        site.edit.set_attribute(site.element, key, value)
        for key, value in wanted.items()
        if site.element.get(key) != value
    )


def _wrong_class(site: FindingSite) -> Fix | None:
    expected, found = site.finding.expected or "", site.finding.found
    names = [str(key) for key, value in site.element.attrib.items() if value == found and key in {"name", "filename"}]
    if not expected or " or " in expected or len(names) != 1:
        return None
    return unsafe(f"Write {names[0]}={expected!r}", site.edit.set_attribute(site.element, names[0], expected))


def _not_in_release(site: FindingSite) -> Fix | None:
    meant = meant_name(site.finding.help)
    if not meant or site.element.get("filename") != site.finding.found:
        return None
    kinds = systems_of_file(meant)
    own = site.element.get("name", "")
    name = kinds[0].class_name if len(kinds) == 1 else own
    return unsafe(f"Write filename={meant!r} name={name!r}", *_called(site, meant, name))


def _lacking(site: FindingSite) -> Fix | None:
    """The systems that the finding proposes, put into the world before its other plugins."""
    world = next((each for each in (site.element, *site.element.iterancestors()) if each.tag == "world"), None)
    found = [*_WRITTEN.finditer(site.finding.help or "")]
    if world is None or not found:
        return None
    behind = _before_plugins(world)
    edits = chain.from_iterable(_inserted(site, world, each["file"], each["name"], behind) for each in found)
    return unsafe(f"Add {', '.join(each['file'] for each in found)} to the world", *edits)


def _before_plugins(world: XmlElement) -> XmlElement | None:
    """The last plugin of a world; None where it has none."""
    own = world.findall("plugin")
    return own[-1] if own else None


def _inserted(
    site: FindingSite, world: XmlElement, file: str, name: str, behind: XmlElement | None
) -> tuple[TextEdit, ...]:
    plugin = etree.Element("plugin", {"filename": file, "name": name})
    return (site.edit.insert(world, plugin, behind),)


FIXERS: Fixers = {
    rules.DEFAULT_SYSTEMS_OFF.name: _lacking,
    rules.IGNITION_PLUGIN_NAME.name: _ignition,
    rules.MISSING_WORLD_SYSTEM.name: _lacking,
    rules.PLUGIN_NOT_IN_RELEASE.name: _not_in_release,
    rules.WRONG_PLUGIN_CLASS.name: _wrong_class,
}
