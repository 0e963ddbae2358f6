"""Readers that write XML again: what they write is what they read."""

import importlib
from pathlib import Path
from typing import Any

from testbed.engines.readers.answers import Answer


def xacro(path: Path) -> Answer:
    """The file with its macros expanded."""
    written = _module("xacro").process_file(str(path)).toxml()
    return Answer(canonical(written.encode()))


def lxml(path: Path) -> Answer:
    """The file written again."""
    etree = _module("lxml.etree")
    return Answer(canonical(etree.tostring(etree.parse(str(path)), pretty_print=True)))


def canonical(text: bytes) -> str:
    """The content of a rewritten file, without what is of our namespace."""
    etree = _module("lxml.etree")
    root = etree.fromstring(text, etree.XMLParser(remove_blank_text=True, remove_comments=True, remove_pis=True))
    for element in root.xpath("//*[namespace-uri() = 'urn:twinform:1']"):
        element.getparent().remove(element)
    for element in root.iter():
        for name in [name for name in element.attrib if name.startswith("{urn:twinform:1}")]:
            del element.attrib[name]
        element.text, element.tail = (element.text or "").strip() or None, None
    etree.cleanup_namespaces(root)
    return etree.tostring(root, method="c14n").decode()


def _module(name: str) -> Any:
    return importlib.import_module(name)
