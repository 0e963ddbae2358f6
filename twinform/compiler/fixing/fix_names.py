"""Fixes of names: misspelt tags, attributes, references and paths, names that SDF refuses, and materials."""

from pathlib import PurePosixPath

from twinform.compiler.fixing.site import FindingSite, FixableFile, Fixers, TextFixers, safe, unsafe
from twinform.diagnostics import Diagnostic, Fix, TextEdit, is_misspelt, is_typo, meant_name, rules
from twinform.schemas import XmlElement
from twinform.text import same_element

_ENDS = frozenset({"parent", "child"})
"""Elements that name a link, also where a joint has its name."""


def _unknown_element(site: FindingSite) -> Fix | None:
    meant = meant_name(site.finding.help)
    old = str(site.element.tag)
    parent = site.element.getparent()
    if not meant or parent is None or not is_typo(old, meant):
        return None
    row = site.file.row_of(parent)
    own = next((each for each in row.children if each.name == meant), None) if row else None
    if own is not None and not own.repeats and parent.find(meant) is not None:
        return None
    return unsafe(f"Write <{meant}> instead of <{old}>", *site.edit.rename(site.element, meant))


def _unknown_attribute(site: FindingSite) -> Fix | None:
    meant, old = meant_name(site.finding.help), site.attribute
    if not meant or not old or not is_typo(old, meant) or meant in site.element.attrib:
        return None
    if old not in site.element.attrib:
        return None
    return unsafe(f"Write {meant} instead of {old}", site.edit.rename_attribute(site.element, old, meant))


def _reference(site: FindingSite) -> Fix | None:
    """Write a similar name that is there in the place of one that is not."""
    # The name is read out of the help sentence: a field of its own in `Diagnostic` would have to be
    # filled in at forty places and say what the sentence says.
    meant, found = meant_name(site.finding.help), site.finding.found
    if not meant or not found or not is_misspelt(found.rpartition("::")[2], meant):
        return None
    edits = _write_name(site, found, meant)
    # A near name is a guess, however near.
    return unsafe(f"Write {meant!r} instead of {found!r}", *edits) if edits else None


def _write_name(site: FindingSite, found: str, meant: str) -> tuple[TextEdit, ...]:
    """Write a name where another one stands: in the attribute of the finding, the only one with it, or the text."""
    if site.attribute and site.attribute in site.element.attrib:
        return site.set_value(meant)
    named = [str(name) for name, value in site.element.attrib.items() if value == found]
    if len(named) == 1:
        return (site.edit.set_attribute(site.element, named[0], meant),)
    if (site.element.text or "").strip() == found and not len(site.element):
        return site.edit.set_text(site.element, meant)
    inner = [each for each in site.element if (each.text or "").strip() == found and not len(each)]
    return site.edit.set_text(inner[0], meant) if len(inner) == 1 else ()


def _reserved_name(site: FindingSite) -> Fix | None:
    """Rename a part with `::` in its name, if nothing else in the file names it."""
    name = site.element.get("name")
    if not name or "::" not in name or not name.replace("::", "") or _is_said_elsewhere(site, name):
        return None
    new = free_name(site.file, "_".join(filter(None, name.split("::"))))
    return unsafe(f"Call it {new!r}", site.edit.set_attribute(site.element, "name", new))


def _shared_name(site: FindingSite) -> Fix | None:
    """Rename one of two parts of different kinds with one name, if nothing else in the file names it."""
    name, tag = site.element.get("name"), str(site.element.tag)
    if not name or _is_said_elsewhere(site, name, _ENDS):
        return None
    new = free_name(site.file, f"{name}_{tag}")
    return unsafe(f"Call this <{tag}> {new!r}", site.edit.set_attribute(site.element, "name", new))


def _is_said_elsewhere(site: FindingSite, name: str, but: frozenset[str] = frozenset()) -> bool:
    """Whether a name stands in the texts of elements, or in other attributes than `name`."""
    return any(not site.file.words.get(word, set()) <= but for word in {name, *name.split("::")[-1:]})


def free_name(file: FixableFile, wanted: str) -> str:
    """Return a name that nothing in the file has; of two findings with one new name, the second has to wait."""
    name, count = wanted, 1
    while name in file.names:
        count += 1
        name = f"{wanted}_{count}"
    return name


def _unnamed_material(site: FindingSite) -> Fix | None:
    """Give a material of a visual an empty name, which is enough for readers."""
    parent = site.element.getparent()
    if site.element.tag != "material" or parent is None or parent.tag != "visual":
        return None
    return safe('Write name=""', site.edit.set_attribute(site.element, "name", ""))


def _bare_material(site: FindingSite) -> Fix | None:
    # a misspelt <color> is no color
    if site.element.tag != "material" or not _is_at_top(site.element) or len(site.element):
        return None
    return safe("Delete the material, which says nothing", site.edit.remove(site.element))


def _second_material(site: FindingSite) -> Fix | None:
    """Delete an equal second definition of a material."""
    if site.element.tag != "material" or not site.finding.related:
        return None
    first = site.part(site.finding.related[0])
    if first is None or first is site.element or not same_element(first, site.element):
        return None
    return safe("Delete the second definition, which says the same", site.edit.remove(site.element))


def _conflicting_material(site: FindingSite) -> Fix | None:
    name = site.element.get("name")
    if site.element.tag != "material" or not name or _is_at_top(site.element):
        return None
    new = free_name(site.file, f"{name}_2")
    return unsafe(f"Call this one {new!r}", site.edit.set_attribute(site.element, "name", new))


def _is_at_top(element: XmlElement) -> bool:
    parent = element.getparent()
    return parent is not None and parent.tag == "robot"


def _backslashes(finding: Diagnostic, file: FixableFile) -> Fix | None:
    found = finding.found or ""
    new = found.replace("\\", "/")
    edits = _write_uri(file, found, new)
    return unsafe(f"Write {new!r}", *edits) if edits else None


def _missing_file(finding: Diagnostic, file: FixableFile) -> Fix | None:
    """Write another scheme, or a similar name for a part of the path."""
    found, meant = finding.found or "", meant_name(finding.help)
    new = _replace_part(found, meant) if meant else None
    edits = _write_uri(file, found, new) if new and not _are_of_two_kinds(file, found, new) else ()
    return unsafe(f"Write {new!r}", *edits) if edits else None


_SHAPES = frozenset({"collision", "visual"})


def _are_of_two_kinds(file: FixableFile, found: str, new: str) -> bool:
    """Whether one file is that of visuals only, and the other one that of collisions only."""
    kinds = [
        {str(holder.tag) for element, _ in file.values.get(uri, ()) for holder in element.iterancestors(*_SHAPES)}
        for uri in (found, new)
    ]
    return all(kinds) and kinds[0].isdisjoint(kinds[1])


def _replace_part(uri: str, meant: str) -> str | None:
    """Replace the part of a URI that is most similar to what is meant."""
    scheme, separator, rest = uri.partition("://")
    if meant.endswith("://"):
        return f"{meant}{rest if separator else uri.partition(':')[2].lstrip('/')}"
    parts = rest.split("/") if separator else uri.split("/")
    stem = PurePosixPath(meant).stem
    at = next((number for number, part in enumerate(parts) if is_misspelt(PurePosixPath(part).stem, stem)), None)
    if at is None:
        return None
    parts[at] = meant
    return f"{scheme}{separator}{'/'.join(parts)}" if separator else "/".join(parts)


def _write_uri(file: FixableFile, found: str, new: str) -> tuple[TextEdit, ...]:
    """Write a URI in every place where it stands alone: it is only reported where it stands first."""
    if file.parts is None:
        return ()
    edits: list[TextEdit] = []
    for element, name in file.values.get(found, ()):
        if name is None:
            edits += file.edit.set_text(element, new)
        elif not name.startswith("{"):
            edits.append(file.edit.set_attribute(element, name, new))
    return tuple(edits)


_REFERENCES = (
    rules.UNKNOWN_COLLISION,
    rules.UNKNOWN_GRIPPER_LINK,
    rules.UNKNOWN_DRIVEN_JOINT,
    rules.DANGLING_FRAME,
    rules.UNKNOWN_CANONICAL_LINK,
    rules.DANGLING_LINK,
    rules.UNKNOWN_LEADER,
    rules.UNKNOWN_MATERIAL,
    rules.UNKNOWN_REFERENCE,
    rules.PLUGIN_REFERENCE,
    rules.MISSPELLED_INTERFACE,
    rules.UNKNOWN_SENSOR_FRAME,
)
FIXERS: Fixers = {
    **{rule.name: _reference for rule in _REFERENCES},
    rules.UNKNOWN_ELEMENT.name: _unknown_element,
    rules.UNKNOWN_ATTRIBUTE.name: _unknown_attribute,
    rules.UNKNOWN_PLUGIN_PARAMETER.name: _unknown_element,
    rules.RESERVED_NAME.name: _reserved_name,
    rules.SHARED_NAME.name: _shared_name,
    rules.BARE_MATERIAL.name: _bare_material,
    rules.CONFLICTING_MATERIAL.name: _conflicting_material,
    rules.UNNAMED_MATERIAL.name: _unnamed_material,
    rules.DUPLICATE_NAME.name: _second_material,
}
TEXT_FIXERS: TextFixers = {rules.BACKSLASH_IN_PATH.name: _backslashes, rules.MISSING_FILE.name: _missing_file}
