"""Fixes of materials: without a name, without a color, there twice, or of another color under the same name."""

from twinform.compiler.fixing.site import FindingSite, Fixers, safe, unsafe
from twinform.compiler.fixing.subjects.fix_names import free_name
from twinform.diagnostics import Fix, rules
from twinform.schemas import XmlElement
from twinform.text import same_element


def _unnamed(site: FindingSite) -> Fix | None:
    """A material of a visual; readers want a name, and an empty one will do."""
    parent = site.element.getparent()
    if site.element.tag != "material" or parent is None or parent.tag != "visual":
        return None
    return safe('Write name=""', site.edit.set_attribute(site.element, "name", ""))


def _bare(site: FindingSite) -> Fix | None:
    if site.element.tag != "material" or not _is_at_top(site.element):
        return None
    return safe("Delete the material, which says nothing", site.edit.remove(site.element))


def _twice(site: FindingSite) -> Fix | None:
    """What is defined again, and says the same."""
    if site.element.tag != "material" or not site.finding.related:
        return None
    first = site.part(site.finding.related[0])
    if first is None or first is site.element or not same_element(first, site.element):
        return None
    return safe("Delete the second definition, which says the same", site.edit.remove(site.element))


def _conflict(site: FindingSite) -> Fix | None:
    name = site.element.get("name")
    if site.element.tag != "material" or not name or _is_at_top(site.element):
        return None
    new = free_name(site.file, f"{name}_2")
    return unsafe(f"Call this one {new!r}", site.edit.set_attribute(site.element, "name", new))


def _is_at_top(element: XmlElement) -> bool:
    parent = element.getparent()
    return parent is not None and parent.tag == "robot"


FIXERS: Fixers = {
    rules.BARE_MATERIAL.name: _bare,
    rules.CONFLICTING_MATERIAL.name: _conflict,
    rules.UNNAMED_MATERIAL.name: _unnamed,
    rules.DUPLICATE_NAME.name: _twice,
}
