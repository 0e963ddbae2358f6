"""On documents with mistakes the engines and the reader come to one verdict as well."""

from functools import cache
from pathlib import Path
from random import Random

import pytest
from lxml import etree

from testbed.mutated.mutants import mutant
from tests.schema_documents import read_tree, version_of
from twinform.diagnostics import DiagnosticSink
from twinform.schemas import (
    Context,
    Engine,
    Version,
    XmlElement,
    has_prefixed_attributes,
    libxml2_errors,
    reader,
    validate,
    xmlschema_errors,
)

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[3] / "examples"
EACH = 15


@cache
def _sources() -> tuple[XmlElement, ...]:
    parser = etree.XMLParser(remove_comments=True, remove_pis=True)
    files = sorted([*EXAMPLES.rglob("*.urdf"), *EXAMPLES.rglob("*.sdf")])
    return tuple(etree.parse(file, parser).getroot() for file in files)


@pytest.mark.parametrize("seed", range(20))
def test_a_mutant_gets_one_verdict(seed: int):
    random = Random(seed)
    for _ in range(EACH):
        root = mutant(random.choice(_sources()), random)
        name, version = _version(root)
        table_reading = read_tree(root, name, version)
        default = table_reading.structural == 0 and not libxml2_errors(root, name, version)
        normative = not xmlschema_errors(root, name, version, names=False)
        assert default is normative, etree.tostring(root).decode()
        engines: tuple[Engine, ...] = ("libxml2", "xmlschema")
        for engine in engines:
            context = read_tree(root, name, version)
            validate(root, context, engine)
            messages = [found.message for found in context.sink.diagnostics]
            assert messages == [found.message for found in table_reading.sink.diagnostics], etree.tostring(
                root
            ).decode()


def test_a_reader_that_trusts_the_schema_reports_the_same():
    random = Random(1)
    for root in [*_sources(), *(mutant(random.choice(_sources()), random) for _ in range(300))]:
        name, version = _version(root)
        if not libxml2_errors(root, name, version) and not has_prefixed_attributes(root):
            trusting = Context(DiagnosticSink(), "", name, version, simple=True)
            data = reader(name, version).read(root, trusting)
            doubting = Context(DiagnosticSink(), "", name, version)
            assert reader(name, version).read(root, doubting) == data, etree.tostring(root).decode()
            trusting.simple = False
            assert trusting == doubting, etree.tostring(root).decode()


def test_mutants_are_of_both_kinds():
    random = Random(0)
    mutants = [mutant(random.choice(_sources()), random) for _ in range(100)]
    taken = [root for root in mutants if read_tree(root, *_version(root)).structural == 0]
    assert 5 < len(taken) < 95


def _version(root: XmlElement) -> tuple[str, Version]:
    name = "urdf" if root.tag == "robot" else "sdf"
    return name, version_of(root, name)
