"""Fixes of names: unknown words with one near miss, references to what is called nearly so, names that SDF refuses."""

from twinform.compiler.fixing.site import FindingSite, FixableFile, Fixers, unsafe
from twinform.diagnostics import Fix, TextEdit, meant_name, nearest_name, rules

# How much of two words has to be the same for a tag to be taken for the other one; with less, the
# help only asks.
_SURE = 0.72
_ENDS = frozenset({"parent", "child"})
"""What names a link where a joint has its name too."""


def _unknown_element(site: FindingSite) -> Fix | None:
    meant = meant_name(site.finding.help)
    old = str(site.element.tag)
    parent = site.element.getparent()
    if not meant or parent is None or nearest_name(old, [meant], _SURE) is None:
        return None
    row = site.file.row_of(parent)
    own = next((each for each in row.children if each.name == meant), None) if row else None
    if own is not None and not own.repeats and parent.find(meant) is not None:
        return None
    return unsafe(f"Write <{meant}> instead of <{old}>", *site.edit.rename(site.element, meant))


def _unknown_attribute(site: FindingSite) -> Fix | None:
    meant, old = meant_name(site.finding.help), site.attribute
    if not meant or not old or meant in site.element.attrib or old not in site.element.attrib:
        return None
    return unsafe(f"Write {meant} instead of {old}", site.edit.rename_attribute(site.element, old, meant))


def _reference(site: FindingSite) -> Fix | None:
    """A name of something that is not there, where one that is there is near."""
    # The name is read out of the help sentence: a field of its own in `Diagnostic` would have to be
    # filled in at forty places and say what the sentence says.
    meant, found = meant_name(site.finding.help), site.finding.found
    if not meant or not found:
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
    """A name with `::` in it, where nothing else in the file says it."""
    name = site.element.get("name")
    if not name or "::" not in name or not name.replace("::", "") or _is_said_elsewhere(site, name):
        return None
    new = free_name(site.file, "_".join(filter(None, name.split("::"))))
    return unsafe(f"Call it {new!r}", site.edit.set_attribute(site.element, "name", new))


def _shared_name(site: FindingSite) -> Fix | None:
    """Two things of different kinds with one name, where nothing else in the file says the name."""
    name, tag = site.element.get("name"), str(site.element.tag)
    if not name or _is_said_elsewhere(site, name, _ENDS):
        return None
    new = free_name(site.file, f"{name}_{tag}")
    return unsafe(f"Call this <{tag}> {new!r}", site.edit.set_attribute(site.element, "name", new))


def _is_said_elsewhere(site: FindingSite, name: str, but: frozenset[str] = frozenset()) -> bool:
    """Whether a name stands in the texts of elements, or in other attributes than `name`."""
    return any(not site.file.words.get(word, set()) <= but for word in {name, *name.split("::")[-1:]})


def free_name(file: FixableFile, wanted: str) -> str:
    """A name that nothing in the file has; two findings may be given the same one, and then the second waits."""
    name, count = wanted, 1
    while name in file.names:
        count += 1
        name = f"{wanted}_{count}"
    return name


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
)
FIXERS: Fixers = {
    **{rule.name: _reference for rule in _REFERENCES},
    rules.UNKNOWN_ELEMENT.name: _unknown_element,
    rules.UNKNOWN_ATTRIBUTE.name: _unknown_attribute,
    rules.UNKNOWN_PLUGIN_PARAMETER.name: _unknown_element,
    rules.RESERVED_NAME.name: _reserved_name,
    rules.SHARED_NAME.name: _shared_name,
}
