"""From one format to the other, and what has to be remembered so that the way back leads home."""

from dataclasses import dataclass, replace

from twinform.compiler.emitting import serialised, valid_tree
from twinform.compiler.memory import Memory, is_unedited, recall, recall_whole, remember, take_memory
from twinform.compiler.orders import Order
from twinform.diagnostics import Entry, Fate, Notes
from twinform.diagnostics.rules.to_urdf import OUTSIDE_MODEL
from twinform.ir import Document, Format, Opaque
from twinform.ir.verify import verify_again
from twinform.passes import Watch
from twinform.passes.includes import has_includes
from twinform.passes.legalise.carrier import NAMESPACE, PREFIX, from_xml
from twinform.passes.legalise.to_urdf.select_model import SelectModel
from twinform.schemas import XmlElement


@dataclass(frozen=True, slots=True)
class Crossing:
    """The document on the other side, and its text; both are as far as they came where the notes have errors."""

    document: Document
    text: str = ""


def cross(document: Document, source: Document, order: Order, notes: Notes, watch: Watch | None = None) -> Crossing:
    """Take a document into the other format. `source` is what the file said before its includes were expanded."""
    document, memory = take_memory(document)
    entries, notes.entries = notes.entries, []
    unedited = memory is not None and is_unedited(document, memory)
    made, at_home = _legalised(document, order, memory, notes, unedited=unedited, watch=watch)
    if not notes.has_errors:
        verify_again(made, notes)
    root = None if notes.has_errors else valid_tree(made, notes, fit=not at_home)
    if root is None or notes.has_errors:
        return Crossing(made)
    text = serialised(root, made)
    new = None
    # what was not edited is made of the source again; what it includes would have to be read again
    if order.carriers and not (at_home and (unedited or has_includes(made))):
        new = remember(_without_the_rest(take_memory(source)[0], document, order), text.encode(), order.assets)
        if not (at_home and new.goes_without_saying):
            made, text = _with_memory(made, root, new, source)
    all_is_said = at_home and (new is None or new.says_nothing)
    notes.entries = [*entries, *([] if all_is_said else _fates(notes.entries, order))]
    return Crossing(made, text)


def _legalised(
    document: Document, order: Order, memory: Memory | None, notes: Notes, *, unedited: bool, watch: Watch | None
) -> tuple[Document, bool]:
    """The document in the other format, and whether it is home again: in the version, too, that is remembered."""
    if memory is None or memory.format != order.to:
        return order.legalisation(document).run(document, notes, watch=watch), False
    if memory.is_whole and unedited:
        back, fits = recall_whole(memory), True
    else:
        back = order.home(memory.version).legalisation(document).run(document, notes, watch=watch)
        if notes.has_errors:
            return back, False
        back, fits = recall(memory, back, notes)
    more = order.legalisation(back)
    return more.run(back, notes, watch=watch), fits and not len(more)


def _without_the_rest(source: Document, document: Document, order: Order) -> Document:
    """The source, or of a source with several models the one that was asked for, which goes home alone."""
    if order.model is None:
        return source
    notes = Notes()
    alone = SelectModel(model=order.model).run(source, notes)
    return SelectModel(model=order.model).run(document, Notes()) if notes.has_errors else alone


def _fates(entries: list[Entry], order: Order) -> list[Entry]:
    """What became of each part: the memory has what would be lost, and where there is none nothing is carried."""
    was, now = (Fate.DROPPED, Fate.CARRIED) if order.carriers else (Fate.CARRIED, Fate.DROPPED)
    return [
        replace(entry, fate=now)
        if entry.fate is was and not (order.carriers and order.model and entry.rule is OUTSIDE_MODEL)
        else entry
        for entry in entries
    ]


def _with_memory(made: Document, root: XmlElement, memory: Memory, source: Document) -> tuple[Document, str]:
    """The document and its text with the memory at the end of the model."""
    xml = memory.to_xml({prefix or None: uri for prefix, uri in source.namespaces if prefix})
    model = root if made.format is Format.URDF else root.find("model")
    if model is None:
        return made, serialised(root, made)
    model.append(xml)
    ours = Opaque(element=from_xml(xml))
    models = (made.models[0].model_copy(update={"opaque": (*made.models[0].opaque, ours)}), *made.models[1:])
    namespaces = made.namespaces if (PREFIX, NAMESPACE) in made.namespaces else (*made.namespaces, (PREFIX, NAMESPACE))
    return made.model_copy(update={"models": models, "namespaces": namespaces}), serialised(root, made)
