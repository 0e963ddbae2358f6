"""Fixes of the paths and URIs of files: backslashes, slips in names and schemes."""

from twinform.compiler.fixing.site import Fixers, Site, unsafe
from twinform.diagnostics import Fix, TextEdit, meant_name
from twinform.diagnostics.rules import files
from twinform.schemas import XmlElement


def _backslashes(site: Site) -> Fix | None:
    found = site.finding.found or ""
    new = found.replace("\\", "/")
    edits = _written(site, found, new)
    return unsafe(f"Write {new!r}", *edits) if edits else None


def _missing_file(site: Site) -> Fix | None:
    """Another scheme, or the part of the path that is called nearly so."""
    found, meant = site.finding.found or "", meant_name(site.finding.help)
    new = _with(found, meant) if meant else None
    edits = _written(site, found, new) if new else ()
    return unsafe(f"Write {new!r}", *edits) if edits else None


def _with(uri: str, meant: str) -> str | None:
    """A URI with what is meant in the place of what is nearest to it."""
    from difflib import SequenceMatcher  # noqa: PLC0415 - few files are missing

    scheme, separator, rest = uri.partition("://")
    if meant.endswith("://"):
        return f"{meant}{rest}" if separator else None
    parts = rest.split("/") if separator else uri.split("/")
    likeness = [SequenceMatcher(None, part.lower(), meant.lower()).ratio() for part in parts]
    at = max(range(len(parts)), key=likeness.__getitem__)
    parts[at] = meant
    return f"{scheme}{separator}{'/'.join(parts)}" if separator else "/".join(parts)


def _written(site: Site, found: str, new: str) -> tuple[TextEdit, ...]:
    """Every place below the element where the URI stands alone."""
    edits: list[TextEdit] = []
    for each in site.element.iter("*"):
        edits += _inside(site, each, found, new)
    return tuple(edits)


def _inside(site: Site, element: XmlElement, found: str, new: str) -> list[TextEdit]:
    edits = [
        site.edit.set_attribute(element, str(name), new)
        for name, value in element.attrib.items()
        if str(value).strip() == found and not str(name).startswith("{")
    ]
    if (element.text or "").strip() == found and not len(element):
        edits += site.edit.set_text(element, new)
    return edits


FIXERS: Fixers = {files.BACKSLASH_IN_PATH.name: _backslashes, files.MISSING_FILE.name: _missing_file}
