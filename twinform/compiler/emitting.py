"""From a document to validated text."""

from collections.abc import Callable

from lxml import etree

from twinform.compiler.sdf import back_end as sdf
from twinform.compiler.urdf import back_end as urdf
from twinform.diagnostics import Notes
from twinform.ir import Document, Format
from twinform.schemas import Context, Version, XmlElement, gate, libxml2_errors, parse_version, reader, table

_BACK_ENDS: dict[Format, Callable[[Document, Version, dict[str | None, str]], XmlElement]] = {
    Format.URDF: urdf.emit,
    Format.SDF: sdf.emit,
}


def emit(document: Document, notes: Notes) -> str:
    """The text of a document in its own format and version, and errors in the notes where its schema refuses it."""
    version = written_version(document)
    named = {prefix or None: uri for prefix, uri in document.namespaces}
    default = named.pop(None, None)
    root = _BACK_ENDS[document.format](document, version, named)
    _validate(root, document.format, version, notes)
    if default is not None:
        root = _in_namespace(root, default)
    etree.indent(root, "  ")
    return '<?xml version="1.0"?>\n' + etree.tostring(root, encoding="unicode") + "\n"


def written_version(document: Document) -> Version:
    """The version whose schema a document follows; the newest where it declares none that exists."""
    facts = table(document.format)
    if document.version in facts.versions:
        return parse_version(document.version)
    return (1, 0) if document.format is Format.URDF and document.version is None else facts.newest


def _validate(root: XmlElement, format_: str, version: Version, notes: Notes) -> None:
    """The gate behind the back end. The table pass looks only where the XSD refuses: at what came in as unknown."""
    if not libxml2_errors(root, format_, version):
        return
    found = Notes(file="<output>")
    context = Context(found, "<output>", format_, version)
    reader(format_, version).read(root, context)
    gate(root, context)
    notes.extend(diagnostic for diagnostic in found.diagnostics if diagnostic.is_error)


def _in_namespace(root: XmlElement, namespace: str) -> XmlElement:
    """The same tree with its plain names in a default namespace."""
    made = etree.Element(f"{{{namespace}}}{root.tag}", dict(root.attrib), {None: namespace, **root.nsmap})
    made.text = root.text
    made.extend(list(root))
    for element in made.iterdescendants():
        if str(element.tag)[0] != "{":
            element.tag = f"{{{namespace}}}{element.tag}"
    return made
