"""Size limits for input: far more than any robot needs, and far less than fills the memory.

Most are checked on the bytes, before there is a tree, because the tree is what fills the memory.
"""

import re
import sys
from typing import NamedTuple, cast

from lxml import etree

from twinform.dataclass import dataclass
from twinform.diagnostics import Location
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement, declared_namespaces, path_of

LARGEST = 64 * 2**20
"""The largest file, in bytes, where nobody says otherwise. The largest real one has 2 MB; 10,000 links have 10."""
# 16 million elements fit into 64 MB of text and fill 3 GB once they are parsed. Counting `<` costs
# a third of a millisecond per MB.
MOST_TAGS = 1_000_000
"""The most tags where nobody says otherwise. A chain of 10,000 links has 280,000, the largest real file 40,000."""
# 50,000 take two seconds. --max-tags above a million lifts this limit too: 100,000 links are all in
# one element.
MOST_CHILDREN = 50_000
"""The most elements in one, unless more tags are allowed: each is read as a part of the model. A chain of 10,000 links
has 20,000."""
# Files of 400 kB with 80,000 of them took `diff` ten seconds.
MOST_STRAY_TEXTS = 10_000
"""The most texts between elements, unless more tags are allowed: each is a part that no format has, and is carried."""
MOST_COLONS = 10_000
"""The most names with two colons behind their prefix. Other faults need no limit: libxml2 lists a hundred of them."""
# Attributes, namespaces, depth and lengths are no options, unlike size and tags: no robot comes
# near, and what they bound grows faster than the file.
MOST_ATTRIBUTES = 256
"""The most attributes of one element, since libxml2 looks each of them up among all. The most in a real file is 12."""
MOST_LOOKUPS = 250_000_000
"""The most namespaces times names in them, since libxml2 looks each of these names up among all that is declared.

That takes five seconds at most, and is reached by 11,000 of both. The most namespaces of a real file are 16.
"""
LONGEST_NAME = 1024
"""The longest name, in characters: the path of each finding repeats the names around it."""

# 250 of them ended in a traceback. 64 are converted, written as JSON and read again within the
# limits of Python and Pydantic.
DEEPEST_MODELS = 64
"""The most models in each other, since a part in them is reached through all. The most in a real file are four."""

_SHORTEST_ATTRIBUTE = len(' a=""')
_LONG_TAG = lazy_pattern(rb"<[^<]{%d}" % min(MOST_ATTRIBUTES * _SHORTEST_ATTRIBUTE, LONGEST_NAME))
"""A tag that might hold too much, or one that long text follows; few files have any."""
_CROWDED = etree.XPath(f"/descendant::*[@*[{MOST_ATTRIBUTES + 1}]]")
_POPULOUS = etree.XPath(f"(/descendant::*[*[{MOST_CHILDREN + 1}]])[1]")
_STRAY_TEXTS = etree.XPath("count(/descendant::*[*]/text()[normalize-space()])")
_LONG_NAMED = etree.XPath(f"/descendant::*[string-length(@name) > {LONGEST_NAME}]")
_DEEP_MODEL = etree.XPath(
    f"(/descendant::*[local-name() = 'model'][count(ancestor::*[local-name() = 'model']) >= {DEEPEST_MODELS}])[1]"
)
_QUALIFIED = etree.XPath("count(/descendant::*[namespace-uri()]) + count(/descendant::*/@*[namespace-uri()])")
_FEW = 64
"""Namespaces that nobody needs to count: with these, a file has too many tags first."""
_DECLARED = lazy_pattern(rb"""^[^<]{0,16}<\?xml[^>]{0,200}?encoding\s*=\s*["']([A-Za-z0-9._:-]*)""")
_COUNTABLE = lazy_pattern(rb"utf-?8|utf-?16.*|utf-?32.*|ucs-?[24].*|us-ascii|ascii|iso[-_]?8859.*|latin.*|"
                        rb"windows-125\d|cp125\d|koi8.*|gb.*|big5.*|euc.*|shift_jis", re.IGNORECASE)  # fmt: skip
"""Encodings in which `<` has the byte of ASCII. UTF-7, for one, can hide it."""


_SIZE = lazy_pattern(r"(?P<number>\d{1,15}(?:\.\d{1,15})?)\s*(?P<unit>(?:[kmg]i?)?)b?", re.IGNORECASE | re.ASCII)
_LONGEST_SIZE = 40
_UNITS = {"": 1, "k": 10**3, "m": 10**6, "g": 10**9, "ki": 2**10, "mi": 2**20, "gi": 2**30}

LIFTED_BY_SIZE = "if the file is to be trusted, give a larger --max-size, or in Python max_size"
LIFTED_BY_TAGS = "if the file is to be trusted, give a larger --max-tags, or in Python max_tags"


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits that a caller may lift: bytes of a file, and tags of one, or parts of a JSON document.

    Raises:
        ValueError: one is no positive whole number.
    """

    size: int = LARGEST
    tags: int = MOST_TAGS

    def __post_init__(self) -> None:
        for name, value in (("max_size", self.size), ("max_tags", self.tags)):
            if type(value) is not int or value <= 0:
                raise ValueError(f"{name} has to be a positive whole number, not {value!r}")


USUAL_LIMITS = Limits()
LIFTED_LIMITS = Limits(sys.maxsize, sys.maxsize)


class Excess(NamedTuple):
    """A limit that was exceeded, as a message, where, and what can be done about it."""

    message: str
    location: Location = Location()
    help: str | None = None


def parse_size(text: str) -> int:
    """Parse a size such as `64MB` or `1.5 GiB` into bytes: units are powers of 1000, or with an `i` of 1024.

    Raises:
        ValueError: the text is not a positive size.
    """
    found = _SIZE.fullmatch(text.strip())
    size = int(float(found["number"]) * _UNITS[found["unit"].lower()]) if found else 0
    if size <= 0:
        said = text if len(text) <= _LONGEST_SIZE else f"{text[:_LONGEST_SIZE]}..."
        raise ValueError(f"{said!r} is no size; write a number of bytes, or a number and a unit such as 200MB or 1GiB")
    return size


def excess_of_bytes(text: bytes, limits: Limits = USUAL_LIMITS) -> Excess | None:
    """Return how a text exceeds the limits on bytes and tags, or None."""
    if len(text) > limits.size:
        return Excess(f"the file has more than {limits.size:,} bytes", help=LIFTED_BY_SIZE)
    tags = text.count(b"<")
    if tags > limits.tags:
        return Excess(f"the file has {tags:,} tags; the limit is {limits.tags:,}", help=LIFTED_BY_TAGS)
    return None


def uncountable_encoding(text: bytes) -> str | None:
    """Return the encoding that a file declares, if tags cannot be counted in it."""
    declared = _DECLARED.match(text)
    return declared[1].decode() if declared and not _COUNTABLE.fullmatch(declared[1]) else None


def excess_of_tree(root: XmlElement, text: bytes, limits: Limits = USUAL_LIMITS) -> Excess | None:
    """Return how a tree, which was parsed from a text, exceeds the limits on its parts, or None."""
    if text.count(b"<model") > DEEPEST_MODELS:
        deep = cast("list[XmlElement]", _DEEP_MODEL(root))
        if deep:
            where = Location(line=deep[0].sourceline or 0, path=f"/{root.tag}")
            return Excess(f"models are in each other more than {DEEPEST_MODELS} deep", where)
    # a robot that needs more tags than usual has more links, all of which are in one element
    if limits.tags <= MOST_TAGS and (tags := text.count(b"<")) > MOST_STRAY_TEXTS:
        excess = _excess_of_children(root) if tags > MOST_CHILDREN else None
        excess = excess or _excess_of_texts(root)
        if excess is not None:
            return excess
    if not _LONG_TAG.search(text):
        return None
    for find, what in ((_CROWDED, f"attributes; the limit is {MOST_ATTRIBUTES}"), (_LONG_NAMED, "")):
        found: list[XmlElement] = find(root)
        if found:
            element = found[0]
            count = len(element.attrib) if what else len(element.get("name", ""))
            words = what or f"characters in its name; the limit is {LONGEST_NAME:,}"
            parent = element.getparent()
            path = f"{'' if parent is None else path_of(parent)}/{element.tag}"  # its own name may have 10 MB
            where = Location(line=element.sourceline or 0, path=path)
            return Excess(f"<{element.tag}> has {count:,} {words}", where)
    return None


def _excess_of_children(root: XmlElement) -> Excess | None:
    """Return how a tree exceeds the limit on elements in one, or None."""
    populous = cast("list[XmlElement]", _POPULOUS(root))
    if not populous:
        return None
    element = populous[0]
    count = sum(1 for _ in element.iterchildren("*"))
    message = f"<{element.tag}> has {count:,} elements in it; the limit is {MOST_CHILDREN:,}"
    return Excess(message, Location(line=element.sourceline or 0, path=path_of(element)), LIFTED_BY_TAGS)


def _excess_of_texts(root: XmlElement) -> Excess | None:
    """Return how a tree exceeds the limit on texts between elements, or None."""
    texts = int(cast("float", _STRAY_TEXTS(root)))
    if texts <= MOST_STRAY_TEXTS:
        return None
    message = f"the file has {texts:,} texts between its elements; the limit is {MOST_STRAY_TEXTS:,}"
    return Excess(message, Location(line=root.sourceline or 0, path=f"/{root.tag}"), LIFTED_BY_TAGS)


def excess_of_colons(count: int) -> Excess | None:
    """Return that too many names have two colons to be repaired, or None."""
    if count <= MOST_COLONS:
        return None
    return Excess(f"{count:,} names of the file have two colons behind their prefix; the limit is {MOST_COLONS:,}")


def excess_of_namespaces(root: XmlElement, text: bytes, *, repaired: bool) -> Excess | None:
    """Return that a tree has too many namespaces, or None; if `repaired`, the text does not declare all of them."""
    if not repaired and text.count(b"xmlns") <= _FEW and b"\0" not in text:
        return None
    count = len(declared_namespaces(root))
    return excess_of_names(count, int(cast("float", _QUALIFIED(root)))) if count > _FEW else None


def excess_of_names(count: int, names: int) -> Excess | None:
    """Return that there are too many names in too many namespaces, or None."""
    if count * (count + names) <= MOST_LOOKUPS:
        return None
    return Excess(f"there are {count:,} namespaces, and {names:,} names may be in one of them; that is too much")


def excess_of_json(text: bytes, limits: Limits = USUAL_LIMITS) -> Excess | None:
    """Return how a JSON document exceeds the limits, or None: each object and each array counts as a part."""
    if len(text) > limits.size:
        return Excess(f"the file has more than {limits.size:,} bytes", help=LIFTED_BY_SIZE)
    parts = text.count(b"{") + text.count(b"[")
    if parts > limits.tags:
        return Excess(f"the document has {parts:,} parts; the limit is {limits.tags:,}", help=LIFTED_BY_TAGS)
    return None
