"""Reads the carriers of a file of MJCF: the texts of its `custom` section whose names begin with `twinform:`."""

from collections.abc import Iterable
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, Fate, Source
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Node, map_references
from twinform.ir.frames import MODEL, WORLD
from twinform.passes.carriers.absorb import CarrierError
from twinform.passes.carriers.annotations import FROM
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.carriers.mjcf_texts import DOCUMENT, KINDS, parse_data, parse_text_name, read_node, text_name
from twinform.schemas import Context, XmlElement


class CarriedText(NamedTuple):
    """A carrier: the kind of its node, the scoped name, and the partial node, which knows where the text stands."""

    kind: str
    name: str
    node: Node


def take_texts(root: XmlElement, context: Context) -> tuple[CarriedText, ...]:
    """Take the carriers out of a tree, and report those that do not hold what their names promise."""
    found: list[CarriedText] = []
    for custom in [*root.iter("custom")]:
        for text in [*custom.iterchildren("text")]:
            if parse_text_name(text.get("name") or "") is None:
                continue
            custom.remove(text)
            read = _read(text, context)
            if read is not None:
                found.append(read)
        parent = custom.getparent()
        if parent is not None and not len(custom):
            parent.remove(custom)
    return tuple(found)


def was_mixed(root: XmlElement) -> bool:
    """Whether the file was written of an SDF that has syntax of newer versions, which only its carrier says."""
    for text in root.iterfind("custom/text"):
        if text.get("name") == text_name(DOCUMENT):
            try:
                origin = parse_data(text.get("data") or text.text or "").find(f"{{{NAMESPACE}}}{FROM}")
            except CarrierError:  # which is reported where it is read
                continue
            if origin is not None and origin.get("mixed") == "true":
                return True
    return False


def _read(text: XmlElement, context: Context) -> CarriedText | None:
    # MuJoCo saves data as the content of the element.
    written = text.get("name") or ""
    name = parse_text_name(written)
    source = Source(context.file, text.sourceline or 0, None, f"mujoco/custom/text[@name='{written}']", None)
    if name is None or name.kind not in KINDS:
        report_stale(context.sink, f"{written!r} is no carrier of a kind that there is", source)
        return None
    try:
        node = read_node(text.get("data") or text.text or "", name.kind, source)
    except (CarrierError, ValueError) as error:
        report_stale(context.sink, f"{written!r} cannot be read: {error}", source)
        return None
    if name.attached and name.kind in _OF_FILES:  # what was a file is a part of one
        return None
    return _attached(CarriedText(name.kind, name.name, node), name.attached)


_OF_FILES = frozenset({DOCUMENT, "model", "world"})


def _attached(text: CarriedText, prefix: str) -> CarriedText:
    """The carrier with the prefix that `attach` has put before the names of all that it is about."""
    if not prefix:
        return text
    node = map_references(text.node, lambda _, name: name if name in {MODEL, WORLD} else prefix + name)
    own = getattr(node, "name", None)
    node = node.copy(name=prefix + own) if own else node
    return text._replace(name=prefix + text.name, node=node)


def report_stale(sink: DiagnosticSink, message: str, source: Source | None) -> None:
    """Report a carrier that fits nothing in the file."""
    where = source.location if source else None
    if where is None:
        return
    sink.account(Fate.DROPPED, STALE_CARRIER, message, where, 2)
    sink.report(STALE_CARRIER, message, where, found=message)


def are_of_sdf(texts: Iterable[CarriedText]) -> bool:
    """Whether carriers are those of a whole file of SDF or URDF, and not additions to one of MJCF."""
    return any(each.kind == DOCUMENT or (each.kind == "model" and not each.name) for each in texts)


def nodes_of(texts: Iterable[CarriedText], kind: str) -> list[Node]:
    """The partial nodes of a kind, by their scoped names."""
    return [each.node for each in texts if each.kind == kind]


def report_unmerged(sink: DiagnosticSink, partials: Iterable[Node]) -> None:
    """Report parts of carriers that hold more of an element than the file has of it."""
    for each in partials:
        what = f"{type(each).__name__.lower()} {getattr(each, 'name', None) or ''}".strip()
        report_stale(sink, f"what a carrier holds of the {what} belongs to nothing in the file", each.source)
