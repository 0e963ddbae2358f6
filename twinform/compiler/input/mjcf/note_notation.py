"""What only the notation of a file says, and the ledger: classes of defaults, and settings of how the file is read."""

from collections.abc import Iterator
from typing import cast

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.schemas import XmlElement, path_of
from twinform.schemas.xml import Places

_CLASSES = ("class", "childclass")
_SETTINGS = (
    "angle", "assetdir", "autolimits", "coordinate", "eulerseq", "meshdir", "strippath", "texturedir",
)  # fmt: skip
"""Attributes of `compiler` that decide what others mean, and nothing else."""


_MAY_HAVE_NOTATION = etree.XPath(
    "*[not(self::default)]/descendant-or-self::*[@class or @childclass or self::compiler or self::frame]"
)
_EXPANDED = {
    "default": "the values of <default> are written into each element that they are for",
    "replicate": "the copies that <replicate> makes are written",
    "attach": "what <attach> names is written in its place",
    "model": "parts of the attached model are written in their place",
}
"""Elements in whose stead others are written."""


def note_notation(root: XmlElement, sink: DiagnosticSink) -> None:
    """Enter into the ledger what is written into each element that it is about, and is not written by itself again."""
    places: Places = {}
    for tag, message in _EXPANDED.items():
        for element in root.iter(tag):
            where = Location(line=element.sourceline or 0, path=path_of(element, places))
            weight = sum(1 + len(each.keys()) for each in element.iter("*"))
            sink.account(Fate.APPROXIMATED, rules.MJCF_ONLY, message, where, weight)
    for element, name in _notation(root):
        where = Location(line=element.sourceline or 0, path=f"{path_of(element, places)}/@{name}")
        what = f"{name}={element.get(name)!r} of <{element.tag}>"
        message = f"{what} is not written by itself: each element says what it says of it"
        sink.account(Fate.APPROXIMATED, rules.MJCF_ONLY, message, where)


def _notation(root: XmlElement) -> Iterator[tuple[XmlElement, str]]:
    """Yield the attributes that are notation, each with its element."""
    for element in cast("list[XmlElement]", _MAY_HAVE_NOTATION(root)):
        names = _SETTINGS if element.tag == "compiler" else (*_CLASSES, "name") if element.tag == "frame" else _CLASSES
        yield from ((element, name) for name in names if element.get(name) is not None)
