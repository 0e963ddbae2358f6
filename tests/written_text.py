"""What has to hold for the text of any document: it is laid out and escaped as lxml would do it."""

import re

from lxml import etree

from twinform.compiler.output.emitting import document_text, document_tree
from twinform.ir import Document

# lxml has no empty text.
_EMPTY = re.compile(r"<([^\s/>]+)([^<>]*)></\1>")


def assert_laid_out(document: Document) -> str:
    """The text of a document, which is that of its tree but for a default namespace."""
    text = document_text(document)
    root = document_tree(document)
    etree.indent(root, "  ")
    tag, _, rest = _EMPTY.sub(r"<\1\2/>", text).partition("\n")[2].partition(">")
    assert rest == f"{etree.tostring(root, encoding='unicode').partition('>')[2]}\n"
    assert dict(etree.fromstring(f"{tag.removesuffix('/')}/>").attrib) == dict(root.attrib)
    return text
