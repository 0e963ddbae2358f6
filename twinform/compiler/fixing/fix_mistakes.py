"""Fixes of what readers take and nobody means: values, ranges upside down, commands, grounds, plugins of Gazebo."""

import re

from lxml import etree

from twinform.compiler.fixing.fix_numbers import numbers_of
from twinform.compiler.fixing.site import FindingSite, FixableFile, Fixers, TextFixers, safe, unsafe
from twinform.compiler.mistakes.launch_comments import breaking_comments, breaks_in
from twinform.diagnostics import Diagnostic, Fix, Span, TextEdit, meant_name, rules
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog import systems_of_file

_PAIRS = (("min", "max"), ("near", "far"), ("min_angle", "max_angle"))


def _expected(site: FindingSite) -> Fix | None:
    """Write the value that the finding has measured or knows."""
    value = site.finding.expected
    return unsafe(f"Write {value}", *site.set_value(value)) if value else None


def _inverted_range(site: FindingSite) -> Fix | None:
    """Exchange the two ends of a range."""
    element = site.element
    name, parent = str(element.tag), element.getparent()
    ends = [(element.find(low), element.find(high)) for low, high in _PAIRS]
    if name.startswith("min_") and parent is not None:
        ends.append((element, parent.find(f"max_{name[4:]}")))
    for least, most in ends:
        if least is not None and most is not None and least.text and most.text:
            edits = (*site.edit.set_text(least, most.text.strip()), *site.edit.set_text(most, least.text.strip()))
            return unsafe(f"Exchange <{least.tag}> and <{most.tag}>", *edits)
    return None


def _moving_plane(site: FindingSite) -> Fix | None:
    """Make a model with a plane static."""
    if site.element.tag == "static":
        return unsafe("Write <static>true</static>", *site.edit.set_text(site.element, "true"))
    static = etree.Element("static")
    static.text = "true"
    return unsafe("Add <static>true</static>", site.edit.insert(site.element, static))


def _decimal_comma(site: FindingSite) -> Fix | None:
    """Write a number with a point."""
    value = site.value.strip().replace(",", ".")
    is_mended = value != site.value.strip() and len(numbers_of(value)) == 1
    return unsafe(f"Write {value}", *site.set_value(value)) if is_mended else None


def _command(site: FindingSite) -> Fix | None:
    """Delete the command interface of a joint that cannot take commands."""
    if site.element.tag != "command_interface":
        return None
    return unsafe("Delete the command interface", site.edit.remove(site.element))


def _mimic_parameter(site: FindingSite) -> Fix | None:
    """Delete the parameter where the joint of the robot says the same."""
    if site.element.tag != "param" or site.finding.help != "delete the parameter":
        return None
    return unsafe("Delete the parameter", site.edit.remove(site.element))


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


_OWN_COLON = lazy_pattern(r"<!--\s*twinform\s*$", re.IGNORECASE)


def _yaml_in_comment(_: Diagnostic, file: FixableFile) -> Fix | None:
    """Write other characters for those of YAML, in all comments of the file."""
    if "yaml in comments" not in file.memo:
        edits = [
            TextEdit(Span(*found.span()), _plain_text_for(found, file.text[comment.start : found.start()]))
            for comment in breaking_comments(file.text)
            for found in breaks_in(file.text, comment)
        ]
        title = "Write no colons and number signs beside blanks in comments"
        file.memo["yaml in comments"] = safe(title, *edits) if edits else None
    return file.memo["yaml in comments"]


def _plain_text_for(found: re.Match[str], before: str) -> str:
    """Return what is written for a character of YAML; comments that allow findings need no colon."""
    if found[0] != ":":
        return "*" * len(found[0])
    if _OWN_COLON.match(before):
        return ""
    return "-" if before.endswith((" ", "\t", "\n")) else " -"


TEXT_FIXERS: TextFixers = {rules.YAML_IN_COMMENT.name: _yaml_in_comment}
FIXERS: Fixers = {
    rules.CONTROL_VALUE.name: _decimal_comma,
    rules.DEFAULT_SYSTEMS_OFF.name: _missing_system,
    rules.IGNITION_PLUGIN_NAME.name: _ignition_name,
    rules.INVERTED_RANGE.name: _inverted_range,
    rules.MIMIC_PARAMETER.name: _mimic_parameter,
    rules.MISSING_WORLD_SYSTEM.name: _missing_system,
    rules.MOVING_PLANE.name: _moving_plane,
    rules.PLUGIN_NOT_IN_RELEASE.name: _not_in_release,
    rules.UNCOMMANDABLE_JOINT.name: _command,
    rules.UPWARD_GRAVITY.name: _expected,
    rules.WRONG_PLUGIN_CLASS.name: _wrong_class,
    rules.WRONG_WHEEL_SIZE.name: _expected,
}
