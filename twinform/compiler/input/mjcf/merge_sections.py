"""Merges the sections of MJCF that a file writes more than once, as included files do."""

from twinform.passes.carriers.carriers import ROOT
from twinform.passes.legalise.to_mjcf.kept_mjcf import KNOWN, SINGLE
from twinform.schemas import XmlElement

_LISTS = KNOWN - SINGLE - {"default", ROOT}
"""Sections whose elements add up."""


def merge_sections(root: XmlElement) -> None:
    """Leave one section of each name, where the first one stands, with all that the others have."""
    first: dict[str, XmlElement] = {}
    for section in list(root.iterchildren(*SINGLE, *_LISTS)):  # MuJoCo skips others
        tag = str(section.tag)
        whole = first.setdefault(tag, section)
        if whole is section:
            continue
        if tag in SINGLE:
            _merge_values(whole, section)
        else:
            for name, value in section.items():
                if name not in whole.attrib:
                    whole.set(name, value)
            whole.extend(list(section))
        root.remove(section)
    for tag in SINGLE:
        if tag in first:
            _merge_repeated_children(first[tag])


def _merge_values(whole: XmlElement, section: XmlElement) -> None:
    for name, value in section.items():
        whole.set(name, value)
    whole.extend(list(section))


def _merge_repeated_children(section: XmlElement) -> None:
    first: dict[str, XmlElement] = {}
    for child in list(section.iterchildren("*")):
        whole = first.setdefault(str(child.tag), child)
        if whole is not child:
            for name, value in child.items():
                whole.set(name, value)
            section.remove(child)
