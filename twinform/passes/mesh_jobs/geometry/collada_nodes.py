"""Counting the parts that the nodes of a COLLADA file place, before any of them is made.

A node may stand for another one several times, which may do the same: 18 nodes in 2 kB place a triangle
131,072 times.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

from lxml import etree

from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError
from twinform.schemas import XmlElement

_MOST_PARTS = 5_000
_LEAST_BYTES, _MOST_TIMES = 2**24, 8
"""All that is placed may have as many bytes as the whole file so many times, or so many in any case."""
_DEEPEST = 200
_INSTANCES = ("instance_geometry", "instance_controller")


def require_few_parts(content: bytes) -> None:
    """Raise where the nodes of a file place too much.

    Raises:
        RefusedMeshError: they do, or one of them is a part of itself.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True)
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError:
        return  # the reader says what is wrong, or repairs it
    nodes = _Nodes({str(each.get("id")): each for each in root.iter("{*}node", "{*}geometry") if each.get("id")})
    placed = [nodes.load(node) for scene in root.iter("{*}visual_scene") for node in scene.iterchildren("{*}node")]
    # A limit of time alone would say that it took too long, and not what to change.
    parts, size = sum(each.parts for each in placed), sum(each.size for each in placed)
    if parts > _MOST_PARTS:
        raise RefusedMeshError(f"its nodes place {parts:,} parts, of which {_MOST_PARTS:,} are read at most")
    if size > max(_LEAST_BYTES, _MOST_TIMES * len(content)):
        raise RefusedMeshError(f"its nodes place {size:,} bytes of parts, in a file that has {len(content):,}")


class _Load(NamedTuple):
    """What a node places: how many parts, and how many bytes they have in the file."""

    parts: int = 0
    size: int = 0


@dataclass(slots=True)
class _Nodes:
    """The nodes and geometries of a file by their names; what each places is added up once."""

    named: dict[str, XmlElement]
    _known: dict[XmlElement, _Load | None] = field(default_factory=dict[XmlElement, _Load | None])

    def load(self, node: XmlElement, depth: int = 0) -> _Load:
        """What a node places with all nodes in it, and all that it stands for."""
        if depth > _DEEPEST:
            raise RefusedMeshError(f"its nodes are nested more than {_DEEPEST} deep")
        if node in self._known:
            known = self._known[node]
            if known is None:
                raise RefusedMeshError(f"its node {node.get('id')!r} is a part of itself")
            return known
        self._known[node] = None
        parts = [self._child(child, depth) for child in node.iterchildren("*")]
        self._known[node] = found = _Load(sum(each.parts for each in parts), sum(each.size for each in parts))
        return found

    def _child(self, child: XmlElement, depth: int) -> _Load:
        name = etree.QName(child).localname
        target = self.named.get(str(child.get("url", "")).removeprefix("#"))
        if name == "node":
            return self.load(child, depth + 1)
        if name == "instance_node" and target is not None:
            return self.load(target, depth + 1)
        if name in _INSTANCES:
            return _Load(1, 0 if target is None else sum(len(text) for text in target.itertext()))
        return _Load()
