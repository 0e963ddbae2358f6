"""Default namespaces inside of a document: `<param xmlns="urn:vendor">` stays one, and gets no prefix.

lxml makes up a prefix, `ns0`, for a namespace that has none. Every prefix of a source is kept, so a namespace without
one was a default somewhere. Where an element has a part without a namespace in it, the made-up prefix stays: a default
would take that part in.
"""

import re
from collections.abc import Mapping

from lxml import etree

from twinform.schemas import XmlElement

_MADE_UP = re.compile(r"ns\d+")


def has_made_up_prefixes(text: str) -> bool:
    """Whether a text may declare prefixes that nobody wrote."""
    return " xmlns:ns" in text


def restore_defaults(root: XmlElement, declared: Mapping[str, str]) -> None:
    """Give elements with a prefix that is not among the declared ones their namespace as a default."""
    for element in list(root.iterdescendants("*")):
        prefix, tag = element.prefix or "", str(element.tag)
        namespace = tag[1:].partition("}")[0]
        parent = element.getparent()
        if parent is None or not _MADE_UP.fullmatch(prefix) or declared.get(prefix) == namespace:
            continue
        within = str(parent.tag).startswith(f"{{{namespace}}}")
        if not within and all(str(below.tag).startswith("{") for below in element.iter("*")):
            parent.replace(element, _with_default(element, namespace))


def _with_default(element: XmlElement, namespace: str) -> XmlElement:
    made = etree.Element(element.tag, dict(element.attrib), {None: namespace})
    made.text, made.tail = element.text, element.tail
    made.extend(list(element))
    return made
