"""Fixes of plugins of Gazebo: names of Ignition, classes that their files do not have, systems that a world lacks."""

from lxml import etree

from twinform.compiler.fixing.site import FindingSite, Fixers, unsafe
from twinform.diagnostics import Fix, TextEdit, meant_name, rules
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog import systems_of_file

_WRITTEN = lazy_pattern(r'<plugin filename="(?P<file>[^"]+)" name="(?P<name>[^"]+)"')


def _ignition_name(site: FindingSite) -> Fix | None:
    """Write the present names of a plugin of Ignition, as the finding proposes them."""
    found = _WRITTEN.search(site.finding.help or "")
    if found is None or site.element.tag != "plugin":
        return None
    edits = _set_names(site, found["file"], found["name"])
    return unsafe(f"Write filename={found['file']!r} name={found['name']!r}", *edits)


def _set_names(site: FindingSite, file: str, name: str) -> tuple[TextEdit, ...]:
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
    return unsafe(f"Write filename={meant!r} name={name!r}", *_set_names(site, meant, name))


def _missing_system(site: FindingSite) -> Fix | None:
    """Add the systems that the finding proposes to the world, behind its other plugins."""
    world = next((each for each in (site.element, *site.element.iterancestors()) if each.tag == "world"), None)
    found = [*_WRITTEN.finditer(site.finding.help or "")]
    if world is None or not found:
        return None
    last = next(iter(reversed(world.findall("plugin"))), None)
    plugins = (etree.Element("plugin", {"filename": each["file"], "name": each["name"]}) for each in found)
    edits = (site.edit.insert(world, plugin, last) for plugin in plugins)
    return unsafe(f"Add {', '.join(each['file'] for each in found)} to the world", *edits)


FIXERS: Fixers = {
    rules.DEFAULT_SYSTEMS_OFF.name: _missing_system,
    rules.IGNITION_PLUGIN_NAME.name: _ignition_name,
    rules.MISSING_WORLD_SYSTEM.name: _missing_system,
    rules.PLUGIN_NOT_IN_RELEASE.name: _not_in_release,
    rules.WRONG_PLUGIN_CLASS.name: _wrong_class,
}
