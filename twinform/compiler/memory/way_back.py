"""Remembering a source in what was made of it, and recalling it on the way back."""

from typing import Any

from lxml import etree

from twinform.compiler.emitting import document_tree, written_version
from twinform.compiler.loading import lower_tree
from twinform.compiler.memory.additions import take_off_additions
from twinform.compiler.memory.document import Memory
from twinform.compiler.memory.edits import apply, changes
from twinform.compiler.memory.keys import digest
from twinform.diagnostics import Notes
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Document, Format
from twinform.ir.verify import verify
from twinform.passes import Assets, Pipeline
from twinform.passes.legalise import Target, legalisation
from twinform.passes.legalise.carrier import NAMESPACE
from twinform.passes.legalise.marks import MADE
from twinform.schemas import LAST_LINE, XmlElement, print_version

_MADE = "<made>"
"""Stands for the file that will be written: parts that come from it keep their order, and no others do."""
_OURS = f"{{{NAMESPACE}}}*"


def remember(source: Document, made: bytes, assets: Assets) -> Memory:
    """What has to be known of the source besides the file that was made of it, to get it back from there.

    The file is taken the whole way back, as it will be when somebody asks for that, and compared with the source.
    """
    version = print_version(written_version(source))
    document = lower_tree(etree.fromstring(made), Notes(_MADE), valid=True)
    back = way_back(document, source.format, version, Notes(_MADE), assets)
    wanted, edits, beside = document_tree(source), etree.Element("edits"), digest(document_tree(document))
    if back is None:
        edits.append(wanted)
        return Memory(source.format, version, edits, beside)
    bare = not _is_declared(source) and not any(True for _ in wanted.iter(_OURS))
    edits.extend(changes(wanted, _tree(back, bare=bare)))
    return Memory(source.format, version, edits, beside, bare)


def way_back(document: Document, format_: Format, version: str, notes: Notes, assets: Assets) -> Document | None:
    """The document in the other format, as it is without any memory; None where it cannot be."""
    urdf_version: Any = version if format_ is Format.URDF else "1.0"
    target = Target(format_, version, urdf_version)
    found = Pipeline(legalisation(document.format, document.version, target)).with_files(assets).run(document, notes)
    return None if notes.has_errors else found


def is_unedited(document: Document, memory: Memory) -> bool:
    """Whether a document, without the memory, is still what was made of the source."""
    return digest(document_tree(document)) == memory.beside


def recall_whole(memory: Memory) -> Document:
    """The source of a memory that is whole."""
    tree = memory.edits[0]
    _number(tree)
    return lower_tree(tree, Notes())


def recall(memory: Memory, back: Document, notes: Notes) -> tuple[Document, bool]:
    """What the source said, from what its way back has made, and whether all that is remembered fits.

    What was edited since stays as it is. Diagnostics: `stale-carrier` for what does not fit any more.
    """
    tree = _tree(back, bare=memory.bare)
    misfits = apply(memory.edits, tree)
    _number(tree)
    found = Notes(notes.file)
    document = lower_tree(tree, found)
    if not found.has_errors:
        verify(document, found)
    if found.has_errors:
        misfits = ["/"]
        document = back
    for path in misfits:
        message = f"what the source said of {path} does not fit what is there now"
        notes.report(rules.STALE_CARRIER, message, back.location, found=path)
    return document, not misfits


def _is_declared(document: Document) -> bool:
    return any(uri == NAMESPACE for _, uri in document.namespaces)


def _tree(document: Document, *, bare: bool) -> XmlElement:
    """The tree of a document, without elements and attributes of our own namespace if it has to be bare."""
    if bare and _is_declared(document):
        others = tuple(pair for pair in document.namespaces if pair[1] != NAMESPACE)
        document = document.model_copy(update={"namespaces": others})
    tree = document_tree(document)
    if document.format is Format.URDF:
        take_off_additions(tree)
    if not bare:
        return tree
    etree.strip_elements(tree, _OURS, with_tail=False)
    for element in list(tree.iter()):
        _strip(element)
    return tree


def _strip(element: XmlElement) -> None:
    """Take off our own attributes, and with a mark what it says that we have made."""
    made = (element.get(MADE) or "").split()
    for name in [name for name in map(str, element.keys()) if name.startswith(_OURS[:-1])]:
        del element.attrib[name]
    parent = element.getparent()
    if "." in made and parent is not None:
        parent.remove(element)
    for name in made:
        if name in element.keys():  # noqa: SIM118 - lxml takes the dot for a bad name
            del element.attrib[name]


def _number(tree: XmlElement) -> None:
    """Give the elements the order that they have in the tree: back ends write siblings by their lines."""
    for parent in tree.iter():
        for number, child in enumerate(parent, 1):
            child.sourceline = min(number, LAST_LINE)  # pyright: ignore[reportAttributeAccessIssue] - it can be set
