"""Four judges of one document: the reader, libxml2, and xmlschema with both schemas; no two of them disagree."""

from functools import cache
from random import Random

import pytest
import xmlschema
from lxml import etree

from testbed.mutated.mutants import mutant
from tests.profile import DEEP
from tests.schema_documents import document, read_tree
from twinform.schemas import (
    Version,
    XmlElement,
    libxml2_errors,
    parse_version,
    table,
    xmlschema_errors,
)
from twinform.schemas.packaged import schema_text

CHUNKS = 20
EACH = 5000 if DEEP else 50


@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_all_judges_come_to_one_verdict(chunk: int) -> None:
    for seed in range(chunk * EACH, (chunk + 1) * EACH):
        root, name, version = _document(seed)
        verdicts = {
            "libxml2 and the reader": not libxml2_errors(root, name, version) and _reads(root, name, version),
            "xmlschema, XSD 1.1": not xmlschema_errors(root, name, version, names=False),
        }
        assert len(set(verdicts.values())) == 1, (seed, verdicts, etree.tostring(root))
        libxml2, other = not libxml2_errors(root, name, version), _accepted_by_1_0(root, name, version)
        assert libxml2 == other, (seed, "libxml2", libxml2, "xmlschema, XSD 1.0", other, etree.tostring(root))


def test_the_documents_are_of_both_kinds() -> None:
    taken = sum(_reads(*_document(seed)) for seed in range(200))
    assert 40 < taken < 160


def _document(seed: int) -> tuple[XmlElement, str, Version]:
    """One document in three as it was made, the others with one to four mistakes."""
    random = Random(seed)
    name = ("urdf", "sdf", "sdf", "sdf", "mjcf")[seed % 5]
    text = random.choice(table(name).versions)
    root = etree.fromstring(document(random, name, text))
    if seed % 3:
        root = mutant(root, random)
    declared = root.get("version")
    return root, name, parse_version(declared if declared in table(name).versions else text)


def _reads(root: XmlElement, name: str, version: Version) -> bool:
    return read_tree(root, name, version).structural == 0


def _accepted_by_1_0(root: XmlElement, name: str, version: Version) -> bool:
    try:
        return _schema(name, version).is_valid(root)
    except KeyError:
        return False  # an xsi:type that names no type; xmlschema raises where it should report


@cache
def _schema(name: str, version: Version) -> xmlschema.XMLSchema10:
    return xmlschema.XMLSchema10(schema_text(name, version, "1.0"), allow="none")
