"""Random changes of XML trees, to see that texts can follow them."""

import random
from collections.abc import Callable
from copy import deepcopy

from lxml import etree

from twinform.schemas import XmlElement

PARSER = etree.XMLParser(remove_comments=True, remove_pis=True, resolve_entities=False, no_network=True)
_NAMES = ("name", "value", "xyz", "new", "{urn:foreign}x")
_VALUES = ("1 2 3", "a\"b'c", "<&>\n\t\r", "\u00e9\u2603", "", "0.1")


def changed(root: XmlElement, chance: random.Random, times: int) -> XmlElement:
    """A copy of a tree with so many changes, each at some element."""
    made = deepcopy(root)
    for _ in range(times):
        change = chance.choice(_CHANGES)
        change(chance.choice(list(made.iter("*"))), chance)
    return made


def _set(element: XmlElement, chance: random.Random) -> None:
    element.set(chance.choice(_NAMES), chance.choice(_VALUES[:2] + _VALUES[3:]))


def _set_known(element: XmlElement, chance: random.Random) -> None:
    if element.attrib:
        element.set(chance.choice(list(map(str, element.attrib))), chance.choice(_VALUES))


def _delete_attribute(element: XmlElement, chance: random.Random) -> None:
    if element.attrib:
        del element.attrib[chance.choice(list(map(str, element.attrib)))]


def _set_text(element: XmlElement, chance: random.Random) -> None:
    if not len(element):
        element.text = chance.choice(_VALUES)


def _add(element: XmlElement, chance: random.Random) -> None:
    made = etree.Element(chance.choice(_NAMES), {"name": chance.choice(_VALUES)})
    made.append(etree.Element("inner"))
    element.insert(chance.randint(0, len(element)), made)


def _remove(element: XmlElement, _: random.Random) -> None:
    parent = element.getparent()
    if parent is not None and not (element.tail or "").strip():
        parent.remove(element)


def _move(element: XmlElement, chance: random.Random) -> None:
    parent = element.getparent()
    if parent is not None and not (element.tail or "").strip():
        parent.remove(element)
        parent.insert(chance.randint(0, len(parent)), element)


def _reverse(element: XmlElement, _: random.Random) -> None:
    element[:] = list(reversed(element))


def _repeat(element: XmlElement, _: random.Random) -> None:
    parent = element.getparent()
    if parent is not None:
        copy = deepcopy(element)
        copy.tail = None
        parent.append(copy)


_CHANGES: tuple[Callable[[XmlElement, random.Random], None], ...] = (
    _set,
    _set_known,
    _delete_attribute,
    _set_text,
    _add,
    _remove,
    _move,
    _reverse,
    _repeat,
)
