"""Elements of URDF that a model keeps unchanged: opaque parts in a URDF document, carriers in SDF."""

from collections.abc import Iterable, Iterator

from twinform.diagnostics import Location
from twinform.ir import Document, Element, Format, Model, Opaque
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, is_carrier, pack, unpack


def element_of(part: Opaque, format_: Format) -> Element | None:
    """The URDF element in an opaque part of a model; None if there is none."""
    if format_ is Format.URDF:
        return part.element
    if not is_carrier(part, "urdf"):
        return None
    # One carrier may hold several pieces, or one from further inside a node; neither is an element
    # of a robot as it stood in URDF.
    pieces = unpack(part)
    return pieces[0].element if len(pieces) == 1 and not pieces[0].at else None


def urdf_elements(model: Model, format_: Format, name: str) -> Iterator[tuple[Opaque, Element]]:
    """The URDF elements with this name, each with the part that holds it."""
    for part in model.opaque:
        found = element_of(part, format_)
        if found is not None and found.name == name:
            yield part, found


def as_parts(new: Iterable[Element], format_: Format) -> tuple[Opaque, ...]:
    """URDF elements as parts of a model."""
    parts = tuple(Opaque(element=each) for each in new)
    return parts if format_ is Format.URDF else pack(parts, "urdf")


def replace_parts(model: Model, gone: Iterable[Opaque], new: Iterable[Opaque], *, after: Opaque) -> Model:
    """The model without some parts, and with new ones after a part that it has or had."""
    gone_ids = {id(part) for part in gone}
    parts: list[Opaque] = []
    for part in model.opaque:
        if id(part) not in gone_ids:
            parts.append(part)
        # Also where the part itself is gone: the new ones take its place, so that files keep their
        # order.
        if part is after:
            parts.extend(new)
    return model.copy(opaque=tuple(parts))


def declare_carriers(document: Document) -> Document:
    """The document with the prefix of carriers declared if it is SDF."""
    pair = (PREFIX, NAMESPACE)
    if document.format is Format.URDF or pair in document.namespaces:
        return document
    return document.copy(namespaces=(*document.namespaces, pair))


def location_of(part: Opaque, model: Model) -> Location:
    """The location of a part; of its model if a pass has made the part."""
    return part.location if part.source else model.location
