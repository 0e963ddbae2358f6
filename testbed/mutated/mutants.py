"""Documents with mistakes: real ones, changed in a few places at random."""

import copy
from collections.abc import Callable
from random import Random

from lxml import etree

from twinform.schemas import XmlElement

_INSTANCE = "{http://www.w3.org/2001/XMLSchema-instance}"
_XML = "{http://www.w3.org/XML/1998/namespace}"
_TEXTS = (
    "", "  ", "1", " 1 ", "1 2", "1 2 3", "1 2 3 4", "0 0 0 0 0 0", "0 0 0 0 0 0 1", "inf", "-INF", "inf 0 NaN", "1e",
    "1_0", "0x1F", "-0x0", "-5", "true", "FALSE", "yes", "1,2,3", "1.5", "abc", "\u0661", "fixed", " fixed", "ENU",
    "\t1\n2\n3",
)  # fmt: skip
_ATTRIBUTES = (
    "name", "odd", "xyz", "rpy", "quat_xyzw", "type", "degrees", "relative_to", "{urn:x}a", _INSTANCE + "type",
    _INSTANCE + "nil", _INSTANCE + "schemaLocation", _XML + "space", _XML + "lang",
)  # fmt: skip

Mutate = Callable[[Random, XmlElement, XmlElement], None]
"""Changes a tree at an element: (random, element, root)"""


def mutant(source: XmlElement, random: Random) -> XmlElement:
    """A copy with one to four changes, written and read again so that its lines are true."""
    root = copy.deepcopy(source)
    for _ in range(random.randint(1, 4)):
        random.choice(_MUTATIONS)(random, random.choice(list(root.iter(etree.Element))), root)
    return etree.fromstring(etree.tostring(root))


def _delete(_: Random, element: XmlElement, root: XmlElement) -> None:
    if element is not root:
        element.getparent().remove(element)  # pyright: ignore[reportOptionalMemberAccess] - only the root has no parent


def _repeat(_: Random, element: XmlElement, root: XmlElement) -> None:
    if element is not root:
        element.addnext(copy.deepcopy(element))


def _rename(random: Random, element: XmlElement, root: XmlElement) -> None:
    if element is not root:
        element.tag = random.choice(list(root.iter(etree.Element))).tag


def _set(random: Random, element: XmlElement, _: XmlElement) -> None:
    element.set(random.choice((*_ATTRIBUTES, *element.keys())), random.choice(_TEXTS))


def _unset(random: Random, element: XmlElement, _: XmlElement) -> None:
    if element.attrib:
        del element.attrib[random.choice(element.keys())]


def _say(random: Random, element: XmlElement, _: XmlElement) -> None:
    element.text = random.choice(_TEXTS)


def _say_after(random: Random, element: XmlElement, root: XmlElement) -> None:
    if element is not root:
        element.tail = random.choice(_TEXTS)


def _insert_another(random: Random, element: XmlElement, root: XmlElement) -> None:
    other = copy.deepcopy(random.choice(list(root.iter(etree.Element))))
    element.insert(random.randint(0, len(element)), other)


def _insert_stranger(random: Random, element: XmlElement, root: XmlElement) -> None:
    stranger = etree.Element(random.choice(("{urn:y}thing", "thing", "{urn:y}robot")))
    stranger.text, stranger.tail = random.choice(_TEXTS), random.choice(_TEXTS)
    stranger.append(etree.Element(root.tag))
    element.insert(random.randint(0, len(element)), stranger)


def _shuffle(random: Random, element: XmlElement, _: XmlElement) -> None:
    children = list(element)
    random.shuffle(children)
    element[:] = children


def _declare(random: Random, _: XmlElement, root: XmlElement) -> None:
    root.set("version", random.choice(("1.0", "1.1", "1.2", "1.4", "1.6", "1.9", "1.12")))


_MUTATIONS: tuple[Mutate, ...] = (
    _delete,
    _repeat,
    _rename,
    _set,
    _set,
    _unset,
    _say,
    _say_after,
    _insert_another,
    _insert_stranger,
    _shuffle,
    _declare,
)
