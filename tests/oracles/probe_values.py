"""The names and values of a file, so that two files can be asked what is in one and nowhere in the other."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from lxml import etree

from twinform.schemas import XmlElement

Value = tuple[str, ...]
"""The parts of a text between blanks, its numbers in one spelling."""

_LUMP = re.compile(r"^.*_fixed_joint_lump__")
_NUMBERED = re.compile(r"(_visual|_collision)(_\d+)?$")
_MOVED = frozenset({"pose", "xyz", "mass", "ixx", "ixy", "ixz", "iyy", "iyz", "izz"})
"""What lumping and re-basing compute anew; whether the robot is the same is a question for an engine."""


@dataclass(frozen=True, slots=True)
class Part:
    """A value, and what it is the value of: the path of an element, or of an attribute."""

    where: str
    value: Value

    @property
    def key(self) -> tuple[str, Value]:
        """What is searched for: the name of the element or attribute, and the value."""
        return self.where.rpartition("/")[2], self.value

    def __str__(self) -> str:
        return f"{self.where} {' '.join(self.value)}"


def parsed(text: bytes) -> XmlElement | None:
    """A file as far as libxml2 can repair it; nothing where there is no element in it."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, recover=True, remove_comments=True)
    return etree.fromstring(text, parser) if text.strip() else None


def parts(root: XmlElement) -> Iterator[Part]:
    """Every attribute, and the text of every element that has no other in it."""
    for element in root.iter(etree.Element):
        where = "/".join(_local(one) for one in [*reversed(list(element.iterancestors())), element][-2:])
        yield from (Part(f"{where}/@{name}", _value(str(text))) for name, text in element.attrib.items())
        if len(element) == 0 and (element.text or "").strip():
            yield Part(where, _value(element.text or ""))


def lost(theirs: XmlElement, ours: XmlElement) -> list[Part]:
    """What is in their file and not in ours: no element or attribute of the name, wherever it is, has the value.

    A name may be the one that libsdformat makes of it when it lumps links and numbers shapes.
    """
    known = frozenset(part.key for part in parts(ours))
    every = (part for part in parts(theirs) if part.key[0] not in _MOVED)
    return [part for part in dict.fromkeys(every) if not any(key in known for key in _spellings(part))]


def _spellings(part: Part) -> Iterator[tuple[str, Value]]:
    name, value = part.key
    yield name, value
    if name == "@name":
        plain = _LUMP.sub("", " ".join(value))
        yield from ((name, (spelling,)) for spelling in (plain, _NUMBERED.sub("", plain), _NUMBERED.sub(r"\1", plain)))


def _value(text: str) -> Value:
    return tuple(_normalized(part) for part in text.split())


def _normalized(part: str) -> str:
    if part in {"true", "false"}:
        return str(int(part == "true"))
    try:
        return f"{float(part):.5g}"
    except ValueError:
        return part


def _local(element: XmlElement) -> str:
    # not QName, which refuses the names that files have
    return str(element.tag).rpartition("}")[2]
