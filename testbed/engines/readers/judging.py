"""What carriers change for a reader: a file beside the same without them."""

from enum import StrEnum
from pathlib import Path

from lxml import etree

from testbed.engines.readers.library import Reader, Reading
from twinform.passes.carriers.carriers import NAMESPACE

MENTIONS = {"drake": "Ignoring unsupported SDFormat element", "urdf_parser_py": "Unknown tag"}
"""The message of a reader that it skips what it does not know."""


class Effect(StrEnum):
    """What carriers change, from nothing to the worst."""

    NONE = "same"
    MENTIONED = "reports that it skips it"
    OTHERWISE = "reads otherwise"
    REFUSED = "**refuses**"


def effect(reader: Reader, carried: Path, before: Reading) -> Effect:
    """What a reader makes of a file, beside what it made of it without carriers."""
    now = reader.ask(carried)
    if now == before:
        return Effect.NONE
    if before.ok and not now.ok:
        return Effect.REFUSED
    return Effect.MENTIONED if _only_mentions(reader, now, before) else Effect.OTHERWISE


def _only_mentions(reader: Reader, now: Reading, before: Reading) -> bool:
    mention = MENTIONS.get(reader.name)
    kept = [line for line in now.output.splitlines() if mention is None or mention not in line]
    expected = [line for line in before.output.splitlines() if mention is None or mention not in line]
    return mention is not None and now.error == before.error and kept == expected


def without_carriers(path: Path, output: Path) -> Path:
    """The file without the elements, attributes, comments and instructions that are ours, and with nothing moved."""
    tree = etree.parse(path)
    for element in list(tree.iter()):
        ours = isinstance(element.tag, str) and element.tag.startswith(f"{{{NAMESPACE}}}")
        above = element.getparent()
        if above is not None and (ours or not isinstance(element.tag, str)):
            above.remove(element)
        elif isinstance(element.tag, str):
            for name in [name for name in element.attrib if str(name).startswith(f"{{{NAMESPACE}}}")]:
                del element.attrib[name]
    etree.cleanup_namespaces(tree)
    tree.write(output, xml_declaration=True, encoding="utf-8")
    return output
