"""From the IR to text: the generated writers."""

from functools import cache
from importlib import import_module
from typing import Any

from lxml import etree

from twinform.ir.versions import Version
from twinform.schemas.facts import table
from twinform.schemas.text_output import NEW_LINE, NO_LAYOUT, Arrange, TextOutput, WrittenParts, without_marks
from twinform.schemas.xml import XmlElement

_PARSER = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=True, collect_ids=False)


def root_text(
    format: str,
    version: Version,
    root: Any,
    namespaces: dict[str | None, str],
    *,
    arrange: Arrange | None = None,
    parts: WrittenParts | None = None,
) -> str:
    """The text of a file with this root.

    `arrange` puts parts of a node in another order than the file's; `parts`, where it is given, gets those that know
    their source.

    Raises:
        ValueError: there is a name or a text that XML cannot hold.
    """
    out = TextOutput(version, namespaces, arrange, None if parts is None else [])
    text = f'<?xml version="1.0"?>{_module(format).write_root(root, out, NEW_LINE)}\n'
    if parts is not None:
        text, parts[:] = without_marks(text, out.parts or [])
    return text


def node_xml(format: str, node: Any, definition: str, namespaces: dict[str | None, str] | None = None) -> XmlElement:
    """The XML of a node by the definition of its element, as the newest version of a format has it, without layout.

    The namespaces are declared if they are in it.

    Raises:
        ValueError: there is a name or a text that XML cannot hold.
    """
    out = TextOutput(_newest(format), namespaces or {})
    text: str = _module(format).WRITERS[definition](node, out, NO_LAYOUT) or f"<{definition}/>"
    if (
        any(f"<{prefix}:" in text or f" {prefix}:" in text for prefix in namespaces or ())
        and out.declarations not in text
    ):
        tag = f"<{definition}"
        text = f"{tag}{out.declarations}{text.removeprefix(tag)}"
    return parse_written(text)


def parse_written(text: str) -> XmlElement:
    """Parse a text that was written here, with its layout; the limits for files of others do not apply."""
    return etree.fromstring(text, _PARSER)


@cache
def _newest(format: str) -> Version:
    return table(format).newest


@cache
def _module(format: str) -> Any:
    """Return the writers of a format, imported when something is first written."""
    return import_module(f"twinform.schemas.generated.{format}_text")
