"""SDF back end: from the IR to an `<sdf>` tree."""

from collections.abc import Iterator

from lxml import etree

from twinform.diagnostics import Source
from twinform.ir import Document
from twinform.schemas import Version, XmlElement, writer


def emit(document: Document, version: Version, namespaces: dict[str | None, str]) -> XmlElement:
    """The `<sdf>` of a document in terms of SDF. What was read from SDF keeps its order."""
    root = etree.Element("sdf", nsmap=namespaces)
    writer("sdf", version).write(document, root)
    if any(model.source and _is_of_urdf(model.source) for model in document.models):
        for model in root.iter("model"):
            put_bases_first(model)
    return root


def _is_of_urdf(source: Source) -> bool:
    while source.above is not None:
        source = source.above
    return source.step == "robot"


_NAMED = frozenset({"link", "joint", "frame", "model"})


def put_bases_first(model: XmlElement) -> None:
    """Put each frame after what it is attached to and what its pose is in, and change the order of nothing else.

    SDF leaves the order open. Drake 1.51 does not: it puts a frame that stands before its base at the wrong place.
    """
    children = list(model)
    named = {str(child.get("name")) for child in children if child.tag in _NAMED}
    waiting: dict[str, list[XmlElement]] = {}
    done: set[str] = set()
    ordered: list[XmlElement] = []
    for child in children:
        ready = [child]
        while ready:
            one = ready.pop()
            base = next((name for name in _bases(one) if name in named and name not in done), None)
            if base is not None:
                waiting.setdefault(base, []).append(one)
                continue
            ordered.append(one)
            if one.tag in _NAMED:
                done.add(str(one.get("name")))
                ready += reversed(waiting.pop(str(one.get("name")), []))
    ordered += [one for many in waiting.values() for one in many]  # which go round in a circle
    if ordered != children:
        model[:] = ordered


def _bases(part: XmlElement) -> Iterator[str]:
    """What of the same model a frame needs to be there; nothing for other parts."""
    if part.tag != "frame":
        return
    pose = part.find("pose")
    for name in (part.get("attached_to"), pose.get("relative_to") if pose is not None else None):
        if name:
            yield name.partition("::")[0]
