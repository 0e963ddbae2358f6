"""The texts of carriers of one file of MJCF: each holds a partial node, and the ledger has what is in it."""

from twinform.diagnostics import rules
from twinform.ir import Node
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.passes.carriers.mjcf_texts import node_element, text_element, text_name, xml_data
from twinform.passes.carriers.partial_nodes import REST
from twinform.passes.carriers.repeated_parts import AGAIN
from twinform.passes.legalise.to_mjcf.spelling_notes import SpellingNotes
from twinform.passes.legalise.to_mjcf.what_is_said import WhatIsSaid
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.legalise.to_mjcf.written_file import WrittenFile
from twinform.schemas import XmlElement

_OURS = f"{{{NAMESPACE}}}"
_MARK = f"{_OURS}{REST}"
_REPEATED = f"{_OURS}{AGAIN}"
_GROUPS = frozenset({"axis", "axis2", "limit", "dynamics", "surface"})
"""Elements that only group others: what is in them counts, and not they themselves."""


class TextList:
    """Adds texts to the `custom` section of one file. All names are scoped names: the models have been flattened.

    Attributes:
        file: the elements of the file.
        said, notes: what it says of a node, and annotations on how that was written.
    """

    def __init__(self, context: MjcfContext) -> None:
        self.context = context
        self.file = WrittenFile(context)
        self.what = said = WhatIsSaid(self.file)
        self.spelling = SpellingNotes(said)
        self.said, self.notes = said.fields, self.spelling.on

    def add_text(self, kind: str, name: str, left: Node, node: Node) -> None:
        """Add the text of a node with what is left of it, and enter that into the ledger."""
        xml = node_element(left, kind)
        self._account(xml, f"{kind} {name!r}" if name else f"the {kind}", node)
        if self.context.keeper.carriers:
            self.context.add("custom", text_element(text_name(kind, name), xml_data(xml)))

    def _account(self, xml: XmlElement, what: str, node: Node) -> None:
        """Enter what a partial element holds into the ledger; what is of our own namespace is in it already."""
        for child in xml:
            tag = str(child.tag)
            if tag == _REPEATED:
                self._account(child, what, node)
                continue
            # By its child a joint is known that has no name in MJCF, which says it as well.
            if tag.startswith(_OURS) or (tag == "child" and _is_rest(xml)):
                continue
            if tag in _GROUPS or _is_rest(child):
                self._account(child, what, node)
                continue
            weight = sum(1 + len(each.attrib) for each in child.iter())
            message = f"<{tag}> of {what} has no equivalent in MJCF"
            self.context.account(rules.NOT_IN_MJCF, message, node.location.at(tag), weight)


def _is_rest(xml: XmlElement) -> bool:
    """Whether a partial element belongs to one that MJCF says."""
    return next(xml.iterchildren(_MARK), None) is not None
